"""Sweeps from the config to the page: numbers, cuts, what is made again and what is refused."""

import json

import pandas as pd
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT, Tree
from swept import POINT_EACH, TARGETS, made
from swept import again as swept_again
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact_pipeline.data_dictionary import files, read

MAKING = {"probe_of_sweep", "plan_of_sweep", "table_of_sweep", "picture_of_sweep", "page_of_sweep"}


@pytest.fixture(scope="module")
def swept(tmp_path_factory) -> Tree:
    return made(tmp_path_factory)


@pytest.fixture
def again(tmp_path_factory, tmp_path) -> Tree:
    return swept_again(tmp_path_factory, tmp_path / "tree")


def planned(tree, *arguments):
    return {rule for rule in tree.planned(*arguments) if not rule.startswith("sweep_")}


def test_the_table_is_what_the_library_says_of_each_point(swept):
    table = pd.read_csv(swept / "results/sweeps/plane.csv")
    assert table["point"].tolist() == list(range(8))
    assert table["epsilon"].tolist() == pytest.approx([0.025, 0.025, 0.05, 0.05, 0.1, 0.1, 0.2, 0.2])
    assert table["f10_hat"].tolist() == table["f20_hat"].tolist() == [0.5, 0.8] * 4
    for row in table.iloc[[0, 3]].to_dict("records"):
        moved = {name: row[name] for name in ("epsilon", "f10_hat", "f20_hat")}
        system = vi.System(**{**PARAMETERS, **moved})
        runs = vi.ensemble(system, spread_starts(2, 1), 30, settle=20)
        assert row["largest_X2"] == runs["largest"][:, 1].max()
        assert row["ball_speed_1"] == runs["ball_speed"][:, 0].mean()
        assert row["fixed_points"] == len(vi.fixed_points(system))
    line = pd.read_csv(swept / "results/sweeps/line.csv")
    kept = dict(zip(("f10_hat", "f20_hat"), FORCES["equal"], strict=True))
    counts = [len(vi.fixed_points(vi.System(**{**PARAMETERS, **kept, "kappa": kappa}))) for kappa in (0.5, 0.7)]
    assert line["fixed_points"].tolist() == counts


def test_a_sweep_has_a_plan_pictures_and_a_page(swept):
    plan = json.loads((swept / "results/sweeps/plane/plan.json").read_text())
    assert (plan["tiles"], plan["points"], plan["runs"]) == (8, 8, 16)
    assert len(list((swept / "results/sweeps/plane/tiles").iterdir())) == 8
    asked = {
        "plane": "epsilon: 4 values from 0.025 to 0.2, logarithmic",
        "line": "kappa: 2 values from 0.5 to 0.7, linear",
    }
    for sweep, words in asked.items():
        for kind in ("png", "pdf", "svg", "csv", "provenance.json"):
            assert (swept / f"results/sweeps/{sweep}/figure.{kind}").stat().st_size > 100
        page = (swept / f"results/sweeps/{sweep}.html").read_text(encoding="utf-8")
        assert words in page
        assert "could not be observed" not in page
        assert "Content-Security-Policy" in page
        assert "http://" not in page.replace("http://www.w3.org", "")


def test_every_file_and_column_of_a_sweep_is_in_the_data_dictionary(swept):
    known = files(*read(ROOT))
    for path in (swept / "results/sweeps").rglob("*.csv"):
        (file,) = (file for file in known if file.has(str(path.relative_to(swept.path))))
        moved = {"epsilon", "kappa", "f10_hat", "f20_hat"} if path.stem == "figure" else set()
        assert set(pd.read_csv(path).columns) <= set(file.columns) | moved


def test_a_sweep_of_more_than_a_million_points_is_planned_with_a_table_that_computers_read(swept):
    axes = "[{along: [kappa], range: [0.1, 0.9], values: 600000}, {along: [epsilon], listed: [0.1, 0.2]}]"
    big = f"sweeps={{big: {{case: equal, axes: {axes}, observe: [fixed_points]}}}}"
    assert "output: results/sweeps/big.parquet\n" in swept.dry_run("--config", big, "--", "sweep_big")


def test_what_is_made_stays_whatever_a_tile_should_take(swept):
    assert planned(swept, *TARGETS) == set()


@pytest.mark.thorough
def test_the_resolution_of_an_axis_makes_its_own_sweep_anew_and_no_other(again):
    again.edit("config/config.yaml", "values: 4", "values: 2")
    assert planned(again, "sweep_line") == set()
    assert planned(again, "sweep_plane") == MAKING
    again.snakemake(*POINT_EACH, "--", *TARGETS)
    table = pd.read_csv(again / "results/sweeps/plane.csv")
    assert table["epsilon"].tolist() == pytest.approx([0.025, 0.025, 0.2, 0.2])
    assert planned(again, *TARGETS) == set()


def test_a_missing_tile_is_made_again_alone(again):
    (again / "results/sweeps/plane/tiles/2-of-8.csv").unlink()
    (again / "results/sweeps/plane.csv").unlink()
    printed = again.snakemake("sweep_plane", V="1")
    assert printed.count("rule tile_of_sweep:") == 1
    assert len(pd.read_csv(again / "results/sweeps/plane.csv")) == 8


def test_a_tile_of_another_question_ends_in_no_table(again):
    """Even without a record by which it would be found out."""
    tile, stranger = (again / "results/sweeps" / name for name in ("plane/tiles/2-of-8.csv", "line/tiles/1-of-2.csv"))
    tile.write_bytes(stranger.read_bytes())
    (again / "results/checksums/results/sweeps/plane/tiles/2-of-8.csv.sha256").unlink()
    (again / "results/sweeps/plane.csv").unlink()
    printed = again.snakemake("sweep_plane", check=False)
    assert again.returncode != 0
    assert "plane/tiles/2-of-8.csv is of a sweep that asked for something else. Delete it" in printed
    tile.unlink()
    assert again.snakemake("sweep_plane").endswith("Open first: results/sweeps/plane.html\n")


@pytest.mark.thorough
def test_a_sweep_above_its_limit_is_not_begun_and_says_what_lets_it_run(again):
    limit = ("--config", "sweeps={plane: {limit_hours: 1.0e-9}}", "--")
    again.snakemake(*POINT_EACH, *limit, "sweep_plane")  # all of it is there
    (again / "results/sweeps/plane/tiles/2-of-8.csv").unlink()
    printed = again.snakemake(*POINT_EACH, "--forcerun", "plan_of_sweep", *limit, "sweep_plane", check=False)
    assert again.returncode != 0
    assert "sweeps.plane: 8 points with 16 simulated starts would take about" in printed
    assert "To run it all the same: snakemake --cores 2 --config 'sweeps={plane: {limit_hours: " in printed
    assert not (again / "results/sweeps/plane/tiles/2-of-8.csv").exists()
    assert (again / "results/sweeps/plane/tiles/1-of-8.csv").exists()
