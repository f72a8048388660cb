"""What continuous integration is given: JUnit XML and Markdown, whatever the reasons say."""

import re
from xml.etree import ElementTree

import pytest

from vibroimpact_pipeline.figure_check.junit import junit
from vibroimpact_pipeline.figure_check.markdown import markdown
from vibroimpact_pipeline.figure_check.verdicts import by_distance

NOTHING = {"reasons": [], "tables": [], "artists": {}, "picture": {}}
AWKWARD = 'a | b <c> & "d" \x00\x1b[31m $\\tau$ ]]>'


def verdict(figure, status, *reasons, distance=0.0):
    artists = {"distance": distance, "limit": 1.0}
    return NOTHING | {"figure": figure, "status": status, "reasons": [*reasons], "artists": artists}


VERDICTS = [
    verdict("fig_a", "passed", distance=0.2),
    verdict("fig_b", "failed", AWKWARD, "another", distance=None),
    verdict("fig_c", "not comparable"),
    verdict("fig_d", "passed", distance=0.7),
    verdict("fig_e", "failed", "far", distance=3.0),
]
# The schema that Jenkins publishes for JUnit, as far as it concerns one suite: attributes, those that must be there
# first, and children of each element.
SCHEMA = {
    "testsuite": ({"name", "tests", "failures", "errors"}, {"skipped"}, {"testcase"}),
    "testcase": ({"name", "classname"}, {"time"}, {"failure", "skipped"}),
    "failure": ({"message"}, {"type"}, set()),
    "skipped": (set(), {"message"}, set()),
}


def test_junit_is_of_its_schema_and_counts_what_it_holds():
    suite = ElementTree.fromstring(junit(VERDICTS).encode())
    for element in suite.iter():
        needed, allowed, children = SCHEMA[element.tag]
        assert needed <= set(element.attrib) <= needed | allowed
        assert {child.tag for child in element} <= children
    assert suite.tag == "testsuite"
    counts = {name: int(suite.get(name)) for name in ("tests", "failures", "errors", "skipped")}
    assert counts == {"tests": 5, "failures": 2, "errors": 0, "skipped": 1}
    assert [len(suite.findall(f".//{tag}")) for tag in ("testcase", "failure", "skipped")] == [5, 2, 1]
    assert [case.get("name") for case in suite.findall("testcase[failure]")] == ["fig_b", "fig_e"]
    assert "another" in suite.find("testcase[@name='fig_b']/failure").text


def test_the_summary_has_a_row_and_a_command_for_each_figure_that_has_not_passed():
    heading, _, summed, _, *rows = markdown(VERDICTS).splitlines()
    assert heading == "### Figure check"
    assert summed.startswith("5 figures: 2 passed, 2 failed, 1 not comparable")
    assert len(rows) == 2 + 3
    assert all(len(re.findall(r"(?<!\\)\|", row)) == 5 for row in rows)
    assert '`make accept REASON="why" FIGURES="fig_b"`' in rows[2]
    assert r"\<c\>" in rows[2]
    assert "(and 1 more)" in rows[2]


def test_with_nothing_but_passes_the_summary_has_no_table():
    assert "|" not in markdown(VERDICTS[:1])


@pytest.mark.parametrize("turn", [1, -1])
def test_what_is_farthest_off_comes_first(turn):
    assert [found["figure"][-1] for found in by_distance(VERDICTS[::turn])] == ["b", "e", "c", "d", "a"]
