"""On a scheduler as on one machine: the same bytes, and nothing anywhere else."""

import shutil

QUICK = "results/fixed_points/equal.csv"


def test_tiles_are_the_same_bytes_on_slurm(tiles):
    tiles.build(profile="profiles/default")
    here = tiles.tables()
    shutil.rmtree(tiles.tree / "results")
    before = {path.name for path in tiles.tree.path.iterdir()}
    tiles.build(also=[QUICK])
    assert tiles.tables() == here
    assert len(here) == 4
    assert {path.name for path in tiles.tree.path.iterdir()} - before <= {"results"}
    assert (tiles.tree / QUICK).exists()
    assert tiles.log().count("has been submitted with SLURM") == 4, "what takes a second goes to no scheduler"
