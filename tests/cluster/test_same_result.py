"""On a scheduler as on one machine: the same bytes, and nothing anywhere else."""

import shutil


def test_tiles_are_the_same_bytes_on_slurm(tiles):
    tiles.build(profile="profiles/default")
    here = tiles.tables()
    shutil.rmtree(tiles.tree / "results")
    before = {path.name for path in tiles.tree.path.iterdir()}
    tiles.build()
    assert tiles.tables() == here
    assert len(here) == 4
    assert {path.name for path in tiles.tree.path.iterdir()} - before <= {"results"}
