"""Test that builds give the same bytes in any checkout path and working directory, for any user and caller."""

import json
import os
import subprocess
import sys

import pytest

from namespaces import unshared
from pipeline_trees import ROOT, Tree, run_module

FIGURE = "fig10_04"
"""A figure with a table, built in a second."""
KINDS = "csv", "png", "pdf", "svg"


def files_of(figure, results):
    return {kind: (results / f"figures/{figure}.{kind}").read_bytes() for kind in KINDS}


def record_of(figure, results):
    """Return the provenance of a figure without run time and git data, since not every copy has a history."""
    record = json.loads((results / f"figures/{figure}.provenance.json").read_text())
    return {name: value for name, value in record.items() if name not in ("seconds", "commit", "tree")}


def assert_same(figure, results, built):
    assert files_of(figure, results) == files_of(figure, built / "results")
    assert record_of(figure, results) == record_of(figure, built / "results")


def snakefile(tree):
    return "--snakefile", str(tree / "Snakefile")


def test_a_build_in_another_directory_writes_nothing_to_the_home_folder(tree, built, tmp_path):
    home, elsewhere = tmp_path / "home", tmp_path / "elsewhere"
    home.mkdir()
    tree.snakemake("--directory", str(elsewhere), "fig10_03", HOME=str(home))
    assert_same("fig10_03", elsewhere / "results", built)
    assert list(home.iterdir()) == []
    assert not (tree / "results").exists()


def test_no_record_contains_a_path_of_this_machine(built):
    records = [path.read_text() for path in (built / "results").rglob("*.provenance.json")]
    assert [record for record in records if str(built.path) in record or str(ROOT) in record] == []
    assert records


def test_a_build_from_a_read_only_tree_without_a_home(tree, built, tmp_path):
    elsewhere = Tree(tmp_path / "elsewhere")
    elsewhere.path.mkdir()
    with_tree_read_only(elsewhere, tree, *snakefile(tree), FIGURE, HOME=os.devnull)
    assert_same(FIGURE, elsewhere / "results", built)
    assert not (tree / ".snakemake").exists()


def with_tree_read_only(elsewhere, tree, *arguments, **environment):
    """Run Snakemake elsewhere while nobody can write to the tree; for root, this requires a read-only mount."""
    if os.geteuid():
        subprocess.run(["chmod", "--recursive", "a-w", tree.path], check=True)
        elsewhere.snakemake(*arguments, **environment)
        subprocess.run(["chmod", "--recursive", "u+w", tree.path], check=True)
        return
    if subprocess.run(["unshare", "--mount", "true"], stderr=subprocess.DEVNULL, check=False).returncode:
        pytest.skip("root may write everywhere, and may not mount here")
    mounted = 'mount --bind "$0" "$0" && mount -o remount,bind,ro "$0" && exec "$@"'
    elsewhere.snakemake(*arguments, prefix=["unshare", "--mount", "sh", "-c", mounted, tree.path], **environment)


@pytest.mark.thorough
def test_a_build_in_a_long_path_with_a_space_and_letters_that_the_locale_lacks(tree, built, tmp_path):
    """Names of sockets have at most 107 characters, and the first line of a script 127 or 255."""
    there = Tree(tree.path.rename(long(tmp_path, 150) / "zwei Kästen"))
    temporary = long(tmp_path, 200)
    there.snakemake("fig10_03", prefix=[interpreter_in(there)], TMPDIR=str(temporary), LC_ALL="C")
    assert_same("fig10_03", there / "results", built)
    assert list(temporary.iterdir()) == []


def long(folder, length):
    """Create a folder below another folder, with a path of `length` characters."""
    path = folder / (max(1, length - len(str(folder)) - 1) * "x")
    path.mkdir()
    return path


def interpreter_in(tree):
    """Return a path inside a tree that leads to the Python interpreter."""
    (tree / ".venv").symlink_to(sys.prefix)
    return tree / ".venv/bin/python"


def test_a_config_file_on_the_command_line_overrides_single_values(rebuilt, tmp_path):
    path = tmp_path / "try.yaml"
    path.write_text("cases: {weak: {f20_hat: 0.7}}\n")
    planned = rebuilt.planned("figures", "--configfile", str(path))
    assert planned >= {"fig10_10", "fig10_11"}
    assert "fig10_06" not in planned


def test_a_whole_config_file_on_the_command_line_can_replace_the_config(rebuilt, tmp_path):
    text = "".join(path.read_text() for path in sorted((rebuilt / "config").glob("*.yaml")))
    path = tmp_path / "whole.yaml"
    path.write_text(text.replace("fixed_point: c, periods: 2", "fixed_point: c, periods: 3"))
    rebuilt.edit("config/config.yaml", "kappa: 0.65", "kappa: 0.5")
    planned = rebuilt.planned("figures", "--configfile", str(path), "--replace-workflow-config")
    assert planned == {"fig10_07", "pages_theoretical_response"}


def test_a_working_directory_with_its_own_config_uses_it(tree, tmp_path):
    own = Tree(tmp_path / "own")
    (own / "config").mkdir(parents=True)
    (own / "config/config.yaml").write_text("system: {kapa: 0.6}\n")
    output = tree.dry_run("--directory", str(own.path))
    assert "config/config.yaml: system.kapa: unknown key, did you mean 'kappa'?" in output.splitlines()


def test_the_report_of_snakemake_needs_no_number_of_cores(built, tmp_path):
    page = tmp_path / "report.html"
    status, output = run_module(
        built.path, "snakemake", "--workflow-profile", "none", "--report", str(page), "fig10_04"
    )
    assert status == 0, output
    assert "fig10_04" in page.read_text(encoding="utf-8")


def test_the_linter_finds_only_two_expected_messages(tree):
    """The linter does not detect the environment of all jobs, environment.lock, and their logs (`jobs.log_of`)."""
    _, output = run_module(tree.path, "snakemake", "--lint")
    found = {line for line in output.splitlines() if line.startswith("    * ")}
    excepted = "Specify a conda environment or container for each rule.:", "No log directive defined:"
    assert found == {f"    * {line}" for line in excepted}, output


@pytest.mark.thorough
def test_a_build_of_a_user_without_a_name_or_a_home(tree):
    names = dict.fromkeys(("LOGNAME", "USER", "LNAME", "USERNAME", "XDG_CACHE_HOME"))
    tree.snakemake(FIGURE, prefix=unshared("--user", "--map-user=12345"), HOME="/proc/none", **names)
    assert (tree / f"results/figures/{FIGURE}.png").exists()


def test_jobs_use_the_library_beside_the_rules_and_the_interpreter_of_snakemake(tree, tmp_path):
    """They do not use the installed library, which is that of this checkout, or kernels and backends of the user."""
    module = "src/vibroimpact/figures/fig10_04.py"
    tree.edit(module, "def compute(", "import sys\n\nprint('by', sys.executable, __file__)\n\n\ndef compute(")
    kernel = tmp_path / "data/kernels/python3/kernel.json"
    kernel.parent.mkdir(parents=True)
    kernel.write_text(json.dumps({"argv": ["false"], "display_name": "Python 3", "language": "python"}))
    startup = tmp_path / "startup.py"
    startup.write_text("raise SystemExit('run at the start')")
    jupyter = {"JUPYTER_PATH": str(tmp_path / "data"), "JUPYTER_DATA_DIR": str(tmp_path / "data")}
    of_user = jupyter | {"MPLBACKEND": "none", "PYTHONSTARTUP": str(startup), "PYTHONPATH": "/nowhere"}
    tree.snakemake(f"results/notebooks/{FIGURE}.html", **of_user)
    executed = (tree / f"results/logs/notebooks/{FIGURE}.ipynb").read_text()
    assert f"by {sys.executable} {tree / module}" in executed
    assert "run at the start" not in executed
