"""A config that cannot be built: lines that name the key, no traceback, nothing run, however the config is given."""

import pytest

from configs import LAUGHS
from pipeline_trees import ROOT, Tree, copied, run_module

SNAKEMAKES = ("Using workflow specific profile", "Config file ")
"""What Snakemake says before it reads a config, by its beginnings."""
FILES = [LAUGHS, "- 1\n", b"system: \xff\n", "__use_yte__: true\nsystem:\n  kappa: ?open('ran', 'w').write('')\n"]
"""The last would be a program in the YAML of Snakemake."""
OVERRIDES = {
    "system={kappa:0.7}": "system.kappa:0.7: unknown key, did you mean 'kappa'?",
    "system={kappa: yes}": "system.kappa: 'yes' should be a valid number",
    "accuracy={problems: {transient: {7: 1}}}": "accuracy.problems.transient.7: unknown key",
}


@pytest.fixture(scope="module")
def tree(tmp_path_factory) -> Tree:
    """The project before a build, which no refusal changes."""
    return copied(ROOT, tmp_path_factory.mktemp("hostile") / "tree")


def said(tree, *arguments):
    """What is said of a build that is refused, but for what Snakemake says of its own."""
    status, output = run_module(tree.path, "snakemake", "--cores", "1", "fig10_03", *arguments)
    assert status == 1, output
    assert not (tree / "results").exists()
    return [line for line in output.splitlines() if not line.startswith(SNAKEMAKES)]


@pytest.mark.parametrize("content", FILES)
def test_the_config_of_a_directory_is_refused_in_lines(tree, content, tmp_path):
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_bytes(content.encode() if isinstance(content, str) else content)
    for line in said(tree, "--directory", str(tmp_path)):
        assert line.startswith("config/config.yaml: ")
        assert len(line) < 250
    assert not (tmp_path / "ran").exists()


def test_a_file_on_the_command_line_is_named(tree, tmp_path):
    (tmp_path / "try.yaml").write_text("system: {kappa: 1.2}\n", encoding="utf-8")
    assert said(tree, "--configfile", str(tmp_path / "try.yaml")) == [
        f"{tmp_path}/try.yaml: system.kappa: 1.2 should be less than 1"
    ]


@pytest.mark.parametrize("override", OVERRIDES)
def test_an_override_is_refused_in_a_line(tree, override):
    (only,) = said(tree, "--config", override)
    assert only.startswith(f"--config: {OVERRIDES[override]}")
