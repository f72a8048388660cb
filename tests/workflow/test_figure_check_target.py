"""The target figure_check and the command for provenance, on a real build."""

import os
import subprocess
import sys

FIGURES = [f"fig10_{number:02d}" for number in range(1, 12)]


def reset_reference(tree, figures=FIGURES):
    """Take the figures of the build as the reference set."""
    for figure in figures:
        for path in (tree / "results/figures").glob(f"{figure}*"):
            if path.suffix in (".png", ".csv") or path.name.endswith(".artists.json"):
                (tree / "figures" / path.name).write_bytes(path.read_bytes())


def test_the_figures_agree_with_the_published_reference(rebuilt):
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 0, output
    assert f"{len(FIGURES)} figures: " in output


def test_a_changed_figure_fails_with_its_reason_and_a_page_to_read(rebuilt):
    reset_reference(rebuilt)
    rebuilt.edit("figures/fig10_04.artists.json", '"unstable"', '"instable"')
    (rebuilt / "figures/fig10_05.csv").unlink()
    before = {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()}
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 1
    assert "\nfig10_04: failed: figure, axes 1, " in output
    assert ": unstable instead of instable" in output
    assert "\nfig10_05: failed: no reference: fig10_05.csv\n" in output
    assert "\n11 figures: 9 passed, 2 failed; " in output
    assert "fig10_05" in (rebuilt / "results/figure_check/index.html").read_text()
    assert {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()} == before


def test_every_figure_tells_where_it_comes_from_and_matches_its_tree(built):
    for file in ("fig10_01.png", "fig10_06.pdf", "fig10_08.svg", "fig10_10.csv"):
        run = subprocess.run(
            [sys.executable, "-m", "vibroimpact.checks.provenance", f"results/figures/{file}"],
            cwd=built.path,
            env={**os.environ, "PYTHONPATH": str(built / "src")},
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stdout + run.stderr
        assert "The file matches the tree." in run.stdout
