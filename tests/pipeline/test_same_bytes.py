"""Two builds are compared byte by byte, but for what contains a timing."""

import pytest

from vibroimpact_pipeline.same_bytes import digests, main

FILES = {
    "figures/a.csv": "x,y\n1,2\n",
    "figures/a.png": "picture",
    "figures/a.provenance.json": "seconds: 1",
    "sweeps/map/tiles/1-of-3.csv": "x,y\n1,2\n",
    "chart.csv": "method,seconds_per_cycle\nours,1e-6\n",
    "chart.svg": "drawn from that",
    "models.csv": "figure,cost_s,note\n",
}


@pytest.fixture
def builds(tmp_path):
    for build in ("first", "second"):
        for name, content in FILES.items():
            path = tmp_path / build / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)
    return tmp_path


def test_tables_of_times_are_left_out_with_their_pictures_and_parts_that_times_have_cut(builds):
    assert set(digests(builds / "first")) == {"figures/a.csv", "figures/a.png"}


def compare(builds, capsys):
    status = main([str(builds / "first"), str(builds / "second")])
    return status, capsys.readouterr().out.splitlines()


def test_the_same_bytes_pass_and_other_times_do_not_count(builds, capsys):
    (builds / "second/chart.csv").write_text("method,seconds_per_cycle\nours,2e-6\n")
    assert compare(builds, capsys) == (0, ["2 files without timing; 0 differ."])


def test_other_bytes_and_lost_files_are_named(builds, capsys):
    (builds / "second/figures/a.csv").write_text("x,y\n1,3\n")
    (builds / "second/figures/a.png").unlink()
    status, said = compare(builds, capsys)
    assert status == 1
    assert said[:2] == ["figures/a.png: in one build only", "figures/a.csv: other bytes"]


def test_two_builds_of_nothing_are_no_proof(tmp_path, capsys):
    assert main([str(tmp_path), str(tmp_path)]) == 1
