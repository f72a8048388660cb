"""A bad config stops the build before any rule runs, in lines that a user can act on."""

import pytest

SHOULD_BE_SILENT = ("Traceback", "rule ", "Job stats")


def refused(tree, *arguments):
    """The lines that Snakemake prints about a bad config, after those on its profile and config."""
    output = tree.dry_run(*arguments)
    assert tree.returncode != 0
    assert not [word for word in SHOULD_BE_SILENT if word in output], output
    return [line for line in output.splitlines() if line.startswith(("config/config.yaml: ", "--config: "))]


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("  kappa: 0.65", "  kappa: 1.2", "config/config.yaml: system.kappa: 1.2 is not below 1"),
        ("  kappa: 0.65", "  kapa: 0.65", "config/config.yaml: system.kapa: unknown key, did you mean 'kappa'?"),
        (
            "  kappa: 0.65",
            "  kappa: 0.65\n  kappa: 0.7",
            "config/config.yaml: line 9, column 3: key 'kappa' given twice",
        ),
        ("  kappa: 0.65", "  kappa: [0.65", "config/config.yaml: line 9, column 14: expected ',' or ']', but got ':'"),
        (
            "sigma20_hat: 0.5",
            "sigma20_hat: -20",
            "config/config.yaml: system.sigma20_hat: 1 + epsilon sigma20_hat = -1.0 is not above 0",
        ),
    ],
)
def test_a_bad_file_is_refused(tree, old, new, line):
    tree.edit("config/config.yaml", old, new)
    assert refused(tree) == [line]


def test_a_missing_config_is_refused(tree):
    (tree / "config/config.yaml").unlink()
    [line] = refused(tree)
    assert "No such file" in line


@pytest.mark.parametrize(
    ("override", "line"),
    [
        ("cases={weak", "--config: cases: '{weak' is not a mapping"),
        ("cases=", "--config: cases: nothing is not a mapping"),
        ("cases=3", "--config: cases: 3 is not a mapping"),
        ("cases={weak: [1]}", "--config: cases.weak: ['1'] is not a mapping"),
        ("system={kappa: 0100}", "--config: system.kappa: 0100 is not below 1"),
        ("figures={all: {notebook: drawings}}", "--config: figures.all.notebook: 'drawings' is not 'fixed_points' or"),
        ("nonsense=1", "--config: nonsense: unknown key"),
    ],
)
def test_a_bad_override_is_refused_in_a_line(tree, override, line):
    [first] = refused(tree, "--config", override)
    assert first.startswith(line)


def test_a_directory_in_place_of_the_config_is_refused(tree):
    (tree / "config/config.yaml").unlink()
    (tree / "config/config.yaml").mkdir()
    assert refused(tree) == ["config/config.yaml: Is a directory"]


def test_overrides_are_checked_as_well(tree):
    lines = refused(tree, "--config", "system={kappa: 1.2}", "cases={weak: {simulation: {initial_state: [2]}}}")
    assert lines == [
        "--config: cases.weak.simulation.initial_state: has length 1, below 8",
        "--config: system.kappa: 1.2 is not below 1",
    ]
