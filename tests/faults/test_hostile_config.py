"""Test that a build with an invalid config runs no job and prints only errors, one line each, that name the key."""

import pytest

from configs import LAUGHS
from pipeline_trees import ROOT, Tree, copied, run_module

SNAKEMAKE_MESSAGES = ("Using workflow specific profile", "Config file ")
"""Beginnings of lines that Snakemake prints before it reads a config."""
YTE = "__use_yte__: true\nsystem:\n  kappa: ?open('ran', 'w').write('')\n"
"""Content of a config file; if Snakemake rendered it as a YTE template, it would run Python code."""
INVALID_OVERRIDES = {
    "system={kappa:0.7}": "system.kappa:0.7: unknown key, did you mean 'kappa'?",
    "system={kappa: yes}": "system.kappa: 'yes' should be a valid number",
    "accuracy={problems: {transient: {7: 1}}}": "accuracy.problems.transient.7: unknown key",
}


@pytest.fixture(scope="module")
def tree(tmp_path_factory) -> Tree:
    """Return the project without results; a refused build does not change it."""
    return copied(ROOT, tmp_path_factory.mktemp("hostile") / "tree")


def errors(tree, *arguments):
    """Start a build that must be refused; return its output without the messages of Snakemake."""
    status, output = run_module(tree.path, "snakemake", "--cores", "1", "fig10_03", *arguments)
    assert status == 1, output
    assert not (tree / "results").exists()
    return [line for line in output.splitlines() if not line.startswith(SNAKEMAKE_MESSAGES)]


@pytest.mark.parametrize("content", [LAUGHS, "- 1\n", b"system: \xff\n", YTE])
def test_errors_of_a_config_file_in_the_working_directory_name_the_file(tree, content, tmp_path):
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_bytes(content.encode() if isinstance(content, str) else content)
    for line in errors(tree, "--directory", str(tmp_path)):
        assert line.startswith("config/config.yaml: ")
        assert len(line) < 250
    assert not (tmp_path / "ran").exists()


def test_an_error_of_a_config_file_on_the_command_line_names_file_and_key(tree, tmp_path):
    (tmp_path / "try.yaml").write_text("system: {kappa: 1.2}\n", encoding="utf-8")
    (only,) = errors(tree, "--configfile", str(tmp_path / "try.yaml"))
    assert only == f"{tmp_path}/try.yaml: system.kappa: 1.2 should be less than 1"


@pytest.mark.parametrize("override", INVALID_OVERRIDES)
def test_an_invalid_override_is_one_error_that_names_the_key(tree, override):
    (only,) = errors(tree, "--config", override)
    assert only.startswith(f"--config: {INVALID_OVERRIDES[override]}")
