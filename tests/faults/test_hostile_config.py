"""A config made to break what reads it: one line, nothing run, nothing built, however the config is given."""

import pytest
from snakemake_logger_plugin_brief.given import refusals

from pipeline_trees import ROOT, Tree, copied, run_module

SNAKEMAKES = ("Using workflow specific profile", "Config file ")
"""What Snakemake says before it reads a config, by its beginnings."""
NINES = 9 * "9"
LAUGHS = "a0: &a0 [ha, ha]\n" + "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12))
PROGRAM = "__use_yte__: true\n__definitions__:\n  - \"open('run', 'w')\"\nsystem: {kappa: 0.7}\n"
TEXTS = {
    "a tab": ("system:\n\tkappa: 0.7\n", "line 2, column 1: found character '\\t' that cannot start any token"),
    "a number as key": ("cases: {7: {}}\n", "line 1, column 9: 7 is not text, as a key has to be"),
    "a list as key": ("cases: {[a, b]: {}}\n", "line 1, column 9: a sequence is not text, as a key has to be"),
    "an endless number": (f"system: {{kappa: {'9' * 5000}}}\n", f"line 1, column 17: '{NINES}"),
    "an endless number in base 16": (f"system: {{kappa: 0x{'f' * 5000}}}\n", "line 1, column 17: '0xffffffff"),
    "a number beyond floats": (f"system: {{kappa: 1{':01' * 900}.5}}\n", "line 1, column 17: '1:01:01:01"),
    "itself": ("system: &all {kappa: *all}\n", "line 1, column 22: alias *all stands inside a value that has a name"),
    "deep nesting": (f"system: {'[' * 9000}\n", "line 1, column 28: nested deeper than 20 levels"),
    "a billion laughs": (LAUGHS, "line 2, column 10: alias *a0 stands inside a value that has a name itself"),
    "a thousand copies": (
        f"a: &a [{'1, ' * 20_000}]\nb: [{'*a, ' * 1000}]\n",
        "line 2, column 9: aliases repeat more than 100000 characters",
    ),
    "a program": (PROGRAM, "__use_yte__: unknown key; a config is data, no part of it is run"),
    "no text": ("system: \udcff\n", "line 1: byte 0xff is not UTF-8"),
    "a list": ("- 1\n", "[1] is not a mapping of system, cases and figures"),
    "nothing": ("", "nothing is not a mapping of system, cases and figures"),
    "a text without end": ('system: "\n', "line 2, column 1: found unexpected end of stream"),
    "too much": ("# \n" * 40_000, "has more than 100000 bytes"),
}
OVERRIDES = {
    "system.kappa=0.7": "'system.kappa=0.7' is no override: write 'system={kappa: 0.7}'",
    "cases.weak.f20_hat=0.4": "'cases.weak.f20_hat=0.4' is no override: write 'cases={weak: {f20_hat: 0.4}}'",
    "system": "'system' is no override: write 'system=VALUE'; targets come after --",
    "=3": "'=3' is no override: write 'system={kappa: 3}'",
    'system={kappa: "[1"}': "system.kappa: expected ',' or ']', but got '<stream end>'",
    "system={kappa:0.7}": "system.'kappa:0.7': unknown key, did you mean 'kappa'?; a space belongs after a colon",
    "cases={[a, b]: {}}": "cases: a sequence is not text, as a key has to be",
    "report={animations: {7: {case: weak, cycles: 1}}}": "report.animations.7: '7' is not a name: a small letter, ",
    'report={animations: {"weak\\n": {case: weak, cycles: 1}}}': "report.animations.'weak\\n': 'weak\\n' is not a name",
    "system=&a [*a]": "system: alias *a stands inside a value that has a name itself",
    f"system={{kappa: {'9' * 400}}}": f"system.kappa: {NINES}",
    f"system={{kappa: {'9' * 5000}}}": f"system.kappa: '{NINES}",
    f"cases={'[' * 5000}": "cases: nested deeper than 20 levels",
    "system={" + LAUGHS.replace("\n", ", ") + "}": "system: alias *a0 stands inside a value that has a name itself",
    "__use_yte__=true": "__use_yte__: unknown key",
}


@pytest.fixture(scope="module")
def tree(tmp_path_factory) -> Tree:
    """The project before a build, which no refusal changes."""
    return copied(ROOT, tmp_path_factory.mktemp("hostile") / "tree")


def said(tree, *arguments):
    """What is said of a build that is refused, but for what Snakemake says of its own."""
    status, output = run_module(tree.path, "snakemake", "--cores", "1", "fig10_03", *arguments)
    assert status == 1, output
    assert not (tree / "run").exists()
    assert not (tree / "results").exists()
    return [line for line in output.splitlines() if not line.startswith(SNAKEMAKES)]


@pytest.mark.parametrize("what", TEXTS)
def test_a_file_on_the_command_line_is_refused_in_a_line(tree, what, tmp_path):
    content, line = TEXTS[what]
    (tmp_path / "try.yaml").write_text(content, encoding="utf-8", errors="surrogateescape")
    [only] = said(tree, "--configfile", str(tmp_path / "try.yaml"))
    assert only.startswith(f"{tmp_path}/try.yaml: {line}")
    assert len(only.removeprefix(str(tmp_path))) < 250


@pytest.mark.parametrize("what", ["a tab", "a billion laughs", "a thousand copies", "a program", "no text"])
def test_the_config_of_a_directory_is_refused_in_a_line_that_says_where_it_is(tree, what, tmp_path):
    """The path is that from where the command was given."""
    content, line = TEXTS[what]
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_text(content, encoding="utf-8", errors="surrogateescape")
    [only] = said(tree, "--directory", str(tmp_path))
    place, _, why = only.partition(": ")
    assert (tree.path / place).resolve() == tmp_path / "config/config.yaml"
    assert why.startswith(line)
    assert sorted(path.name for path in tmp_path.iterdir() if not path.name.startswith(".")) == ["config"]


@pytest.mark.parametrize("override", OVERRIDES, ids=[override[:40] for override in OVERRIDES])
def test_an_override_is_refused_in_a_line(tree, override):
    only, *more = said(tree, "--config", override)
    assert only.startswith(f"--config: {OVERRIDES[override]}")
    assert len(only) < 250
    assert not more


@pytest.mark.parametrize(("name", "line"), [("none.yaml", "No such file or directory"), ("config", "Is a directory")])
def test_a_file_that_cannot_be_opened_is_refused_in_a_line(tree, name, line):
    assert said(tree, "--configfile", name) == [f"{name}: {line}"]


def test_all_that_is_wrong_with_a_command_line_is_said_at_once(tree):
    lines = said(tree, "--config", "system.kappa=1", "cases", "--configfile", "none.yaml")
    assert len(lines) == 3


def test_a_job_of_a_build_is_not_asked_again():
    """It is given what was read, in Snakemake's own words."""
    given = ["fig10_03", "--configfile", "none.yaml", "--config", "system.kappa=0.7"]
    assert len(list(refusals(given))) == 2
    assert list(refusals([*given, "--mode", "subprocess"])) == []
