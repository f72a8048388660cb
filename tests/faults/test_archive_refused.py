"""What cannot be archived is refused in a line, before anything is built."""

import json

import pytest

from archives import commit
from pipeline_trees import ROOT, copied
from vibroimpact_pipeline.archive.figures import RECORD, check_environment, figures
from vibroimpact_pipeline.integrity.checksums import digest_of


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A checkout in which nothing is built. Read it."""
    tree = copied(ROOT, tmp_path_factory.mktemp("refused") / "tree")
    commit(tree.path)
    return tree


def refused(tree, *arguments) -> str:
    """The last line of what a dry run of the archive says that does not get as far as to plan anything."""
    said = tree.dry_run(*arguments)
    assert tree.returncode == 1, said
    assert "Traceback" not in said
    assert "rule " not in said
    return said.splitlines()[-1]


def test_in_a_checkout_it_would_be_built(checkout):
    assert {"archive", "fig10_04", "simulation"} <= checkout.planned("archive")


def test_a_config_that_would_not_be_in_it(checkout, tmp_path):
    line = refused(checkout, "archive", "--config", "system={kappa: 0.7}")
    assert line.startswith(
        "archive: --config overrides config/config.yaml, which goes into the archive: write it there"
    )
    (tmp_path / "other.yaml").write_text("system: {kappa: 0.7}\n")
    line = refused(checkout, "archive", "--configfile", str(tmp_path / "other.yaml"))
    assert "other.yaml overrides config/config.yaml" in line


def test_results_of_another_directory(checkout, tmp_path):
    line = refused(checkout, "archive", "--directory", str(tmp_path))
    assert line == (
        f"archive: {tmp_path} is not the checkout, {checkout.path}: build the archive there, without --directory"
    )


def test_a_copy_without_git(tmp_path):
    tree = copied(ROOT, tmp_path / "tree")
    assert refused(tree, "archive").startswith(f"archive: {tree.path} is no git checkout with a commit")


def test_files_that_cite_it_differently(tmp_path):
    tree = copied(ROOT, tmp_path / "tree")
    commit(tree.path)
    tree.edit("CITATION.cff", "version: 0.1.0", "version: 0.2.0")
    assert refused(tree, "archive") == (
        "archive: version: CITATION.cff says '0.2.0', pyproject.toml '0.1.0'. Make them agree."
    )
    assert "fig10_04" in tree.planned("fig10_04")  # what is not archived need not be cited


def test_figures_made_with_other_packages(tmp_path):
    (tmp_path / "environment.lock").write_text("numpy==2\n")
    paths = [tmp_path / f"{name}{RECORD}" for name in ("fig10_04", "fig10_05")]
    locks = [digest_of(tmp_path / "environment.lock"), "another"]
    for path, lock in zip(paths, locks, strict=True):
        path.write_text(json.dumps({"lock": lock, "outputs": {}}))
    check_environment(figures(paths[:1]), tmp_path)
    with pytest.raises(
        ValueError, match=r"^environment\.lock has changed .* snakemake --forcerun fig10_05 -- archive$"
    ):
        check_environment(figures(paths), tmp_path)
