"""Verdicts of the figure check as JUnit XML, which continuous integration shows test by test."""

from xml.etree import ElementTree

from vibroimpact.figures.kit.markdown import one_line
from vibroimpact_pipeline.figure_check.verdicts import FAILED, NOT_COMPARABLE, OTHER_VERSIONS

NAME = "figure check"


def junit(verdicts: list[dict]) -> str:
    """A test case per figure: passed, failed with its reasons, or skipped where pixels could not be compared."""
    counts = {
        "tests": len(verdicts),
        "failures": sum(verdict["status"] == FAILED for verdict in verdicts),
        "errors": 0,
        "skipped": sum(verdict["status"] == NOT_COMPARABLE for verdict in verdicts),
    }
    attributes = {name: str(count) for name, count in counts.items()}
    suite = ElementTree.Element("testsuite", name=NAME, **attributes)
    for verdict in verdicts:
        case = ElementTree.SubElement(suite, "testcase", classname=NAME, name=verdict["figure"])
        if verdict["status"] == FAILED:
            reasons = [one_line(reason) for reason in verdict["reasons"]]
            failure = ElementTree.SubElement(case, "failure", message=reasons[0], type="difference")
            failure.text = "\n".join(reasons)
        elif verdict["status"] == NOT_COMPARABLE:
            ElementTree.SubElement(case, "skipped", message=OTHER_VERSIONS)
    ElementTree.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(suite, encoding="unicode") + "\n"
