"""Nothing malformed gets through, and whatever is refused is refused in lines that a user can act on."""

from pathlib import Path

import pytest

from configs import TEXT, edited
from vibroimpact_pipeline.config import parse, problems, read

TABLE = [
    line.split(" -> ")
    for line in Path(__file__).with_name("malformed_configs.txt").read_text(encoding="utf-8").splitlines()
    if not line.startswith("#")
]


def said(make, given) -> list[str]:
    """The lines that a user reads of a config."""
    try:
        return [f"{path}: {what}" for path, what in problems(make(given))]
    except ValueError as refusal:
        return [str(refusal)]


def test_the_table_is_long_and_has_no_row_twice():
    assert len(TABLE) == len({edits for edits, _ in TABLE}) > 250


@pytest.mark.parametrize(("edits", "lines"), TABLE, ids=[edits[:60] for edits, _ in TABLE])
def test_a_malformed_config_is_refused(edits, lines):
    assert " | ".join(said(edited, edits)) == lines


LINES = TEXT.count("\n")
MOVING = "    periodic: {case: equal, cycles: 1}\n"
SYSTEM, CASES, EPSILON, KAPPA = "system:\n", "cases:\n", "epsilon: 0.1\n", "kappa: 0.65\n"


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (KAPPA, KAPPA + "  kappa: 0.7\n", "line 8, column 3: key 'kappa' given twice"),
        (KAPPA, "kappa: [0.65\n", "line 8, column 14: expected ',' or ']', but got ':'"),
        (KAPPA, "\tkappa: 0.65\n", "line 7, column 3: found character '\\t' that cannot start any token"),
        (KAPPA, "kappa: 0.65\0\n", "unacceptable character #x0000: special characters are not allowed"),
        (KAPPA, 'kappa: "0.65\n', f"line {LINES + 1}, column 1: found unexpected end of stream"),
        (KAPPA, "kappa: *name\n", "line 7, column 10: found undefined alias 'name'"),
        (KAPPA, "kappa: &name [*name]\n", "line 7, column 17: alias *name stands inside a value that has a name"),
        (KAPPA, "kappa: &name {a: *name}\n", "line 7, column 20: alias *name stands inside a value that has a name"),
        (KAPPA, "kappa: &name 1\nb: &name 2\n", "line 8, column 4: name &name given twice"),
        (KAPPA, "<<: {kappa: 0.65}\n", "line 7, column 3: '<<' is not text, as a key has to be"),
        (KAPPA, f"kappa: {'[' * 5000}\n", "line 7, column 28: nested deeper than 20 levels"),
        (KAPPA, f"kappa: {'{a: ' * 5000}\n", "line 7, column 79: nested deeper than 20 levels"),
        (KAPPA, f"kappa: {'9' * 5000}\n", "line 7, column 10: '999999999999999999999999999...999"),
        (KAPPA, f"kappa: 0x{'f' * 5000}\n", "line 7, column 10: '0xfffffffffffffffffffffffff...fff"),
        (KAPPA, f"kappa: 1{':01' * 5000}.5\n", "line 7, column 10: '1:01:01:01:01:01:01:01:01:0...01:"),
        (KAPPA, f"kappa: !{'x' * 5000} 1\n", "line 7, column 10: 1 is of the kind '!xxxxx"),
        (
            KAPPA,
            f"kappa: &name [{'1,' * 40_000}1]\n  a: *name\n  b: *name\n",
            "line 9, column 6: aliases repeat more than",
        ),
        (TEXT, TEXT + "__use_yte__: true\n", "__use_yte__: unknown key; a config is data, no part of it is run"),
        (KAPPA, "kappa: yes\n", "line 7, column 10: yes means True in YAML: write that, or 'yes' for the text"),
        (KAPPA, "kappa: !!map 3\n", "line 7, column 10: 3 cannot be read as map"),
        (KAPPA, "kappa: !!int [3]\n", "line 7, column 10: a sequence cannot be read as int"),
        (KAPPA, "kappa: !!bool maybe\n", "line 7, column 10: maybe cannot be read as bool"),
        (KAPPA, "kappa: !!int ''\n", "line 7, column 10: '' cannot be read as int"),
        (KAPPA, "kappa: !mine 3\n", "line 7, column 10: 3 is of the kind !mine; a config holds numbers, text"),
        (CASES, CASES + "  12: {}\n", "line 18, column 3: 12 is not text, as a key has to be"),
        (CASES, CASES + "  1.5: {}\n", "line 18, column 3: 1.5 is not text, as a key has to be"),
        (CASES, CASES + "  null: {}\n", "line 18, column 3: null is not text, as a key has to be"),
        (CASES, CASES + "  yes: {}\n", "line 18, column 3: yes is not text, as a key has to be"),
        (CASES, CASES + "  [a, b]: {}\n", "line 18, column 3: a sequence is not text, as a key has to be"),
        (CASES, CASES + "  {a: b}: {}\n", "line 18, column 3: a mapping is not text, as a key has to be"),
        (CASES, CASES + "  ? [a, b]\n  : {}\n", "line 18, column 5: a sequence is not text, as a key has to be"),
        (CASES, CASES + "  : {}\n", "line 18, column 3: expected <block end>, but found ':'"),
        (
            MOVING,
            MOVING + '    "weak\\n": {case: weak, cycles: 1}\n',
            "report.animations.'weak\\n': 'weak\\n' is not a name",
        ),
        (
            MOVING,
            MOVING + "    <b>: {case: weak, cycles: 1}\n",
            "report.animations.'<b>': '<b>' is not a name: a small",
        ),
        (MOVING, MOVING + "    '`x`': {case: weak, cycles: 1}\n", "report.animations.'`x`': '`x`' is not a name: a sm"),
        (SYSTEM, SYSTEM + '  "a\\nb": 1\n', "system.'a\\nb': unknown key"),
        (SYSTEM, SYSTEM + '  "\\e[31m": 1\n', "system.'\\x1b[31m': unknown key"),
        (SYSTEM, SYSTEM + f"  ? {'k' * 80_000}\n  : 1\n", "system.'kkkkkkkkkkkkkkkkkkkkkkkkkkk...kkk"),
        (TEXT, TEXT + "---\n" + TEXT, f"line {LINES + 1}, column 1: but found another document"),
        (TEXT, "%YAML 9.9\n---\n" + TEXT, "line 1, column 1: found incompatible YAML document"),
        (TEXT, "", "nothing is not a mapping of system, cases and figures"),
        (TEXT, "# a comment\n", "nothing is not a mapping of system, cases and figures"),
        (TEXT, "- 1\n", "[1] is not a mapping of system, cases and figures"),
        (TEXT, "text\n", "'text' is not a mapping of system, cases and figures"),
        (TEXT, "0100\n", "line 1, column 1: 0100 means 64 in YAML: write that, or '0100' for the text"),
    ],
)
def test_a_malformed_text_is_refused(old, new, line):
    assert old in TEXT
    first, *more = said(parse, TEXT.replace(old, new, 1))
    assert first.startswith(line)
    assert not more
    assert "\n" not in first
    assert len(first) < 240


def test_many_problems_are_found_in_time():
    """Thousands of unknown keys, and as many cases."""
    keys = "".join(f"  k{number}: 1\n" for number in range(5000))
    assert len(said(parse, TEXT.replace(SYSTEM, SYSTEM + keys))) == 5000
    assert len(said(parse, TEXT.replace(CASES, CASES + keys))) == 5000


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"", "nothing is not a mapping of system, cases and figures"),
        (b"system:\n  kappa: \xff\n", "line 2: byte 0xff is not UTF-8"),
        (TEXT.encode("utf-16"), "line 1: byte 0xff is not UTF-8"),
        (b"a: 1\n" * 30_000, "has more than 100000 bytes"),
        (None, "No such file or directory"),
    ],
)
def test_a_file_that_holds_no_config_is_refused(content, line, tmp_path):
    path = tmp_path / "config.yaml"
    if content is not None:
        path.write_bytes(content)
    assert said(read, path) == [line]


def test_a_directory_is_no_config(tmp_path):
    assert said(read, tmp_path) == ["Is a directory"]


@pytest.mark.parametrize("change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")])
def test_a_byte_order_mark_and_line_ends_of_other_systems_do_no_harm(change):
    assert parse(change(TEXT)) == parse(TEXT)


UNNAMED = " & figures.fig10_07 = ... & figures.fig10_10 = ... & regimes.epsilon.mixed = ..."
"""No fixed point is asked for by its label."""
UNUSUAL = [
    "system.epsilon = 0.000001",
    "system.epsilon = 3 & sweeps.frequency_response = ... & sweeps.clearance = ... & sweeps.design = ...",
    "system.kappa = 0.001" + UNNAMED,
    "system.kappa = 0.999",
    "system.alpha12_hat = 0 & system.gamma12_hat = 0" + UNNAMED,
    "system.gamma1_hat = 0 & system.gamma2_hat = 0 & system.gamma12_hat = 0",
    "system.sigma20_hat = -9.9 & stability.verdict_grid.epsilon = [0.1] & regimes.epsilon.fit_below = 0.05" + UNNAMED,
    "system.sigma_e_hat = 1000" + UNNAMED,
    "cases.weak.f10_hat = 0 & cases.weak.f20_hat = 0 & figures.fig10_10 = ...",
    "cases.unequal.f20_hat = -0.89",
    "cases.all = {f10_hat: 1, f20_hat: 1, simulation: {initial_state: [1, 0, -1, 0, 0, 0, 0, 0], transient_cycles: 0, "
    "window_cycles: 1, samples_per_cycle: 8}}",
    "cases.weak.simulation.digits = ...",
    "cases.weak.simulation.samples_per_cycle = 1000",
    "figures = {fig10_01: {notebook: drawings}}",
    "figures = {mine: {notebook: simulation, model: simulation, case: equal}}",
    "figures.other = {notebook: theoretical_response, model: slow_flow, case: unequal, fixed_point: b, periods: 2}",
    "figures.fig10_10.C_max = ...",
    "figures.fig10_04 = ... & figures.fig10_11 = ...",
    "stability.verdict_grid.points = 2",
    "stability.verdict_grid.epsilon = [0.1]",
    "regimes.branches.paths = [{along: [kappa, epsilon], range: [0.1, 0.5]}]",
    "regimes.branches.paths = [{along: [sigma_e_hat], range: [-5, 5]}]",
    "regimes.coexistence.lifetimes.values = [0.9]",
    "regimes.confusion.f10_range = [-1.6, 1.6]",
    "sweeps.regime_map = ...",
    "sweeps.design = ... & sweeps.frequency_response.axes[1].tuples = [[0.5, 0.5], [1.0, -1.0], [2.0, 0.1]]",
    "sweeps.regime_map.axes = [{along: [f10_hat], range: [0, 1], values: 3}, "
    "{along: [f20_hat], range: [0, 1], cells: 2}]",
    "regimes.modulation.windows = [1]",
    "regimes.epsilon.epsilon = [0.0001, 0.1]",
    "regimes.epsilon.mixed = {case: weak, label: a}",
    "accuracy.problems = {one: {case: weak, initial_state: [0, 1, 0, 1, 0, 0, 0, 0], cycles: 1}}",
    "report.animations = {fast: {case: weak, cycles: 120}}",
    "report.force_sweep.values = 2",
]


@pytest.mark.parametrize("edits", UNUSUAL)
def test_an_unusual_config_is_accepted(edits):
    assert problems(edited(edits)) == []


def test_an_alias_of_a_plain_value_is_accepted():
    rest = "initial_state: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"
    text = TEXT.replace(rest, rest.replace("[", "&rest ["), 1).replace(rest, "initial_state: *rest")
    assert text.count("*rest") > 1
    assert parse(text) == parse(TEXT)
