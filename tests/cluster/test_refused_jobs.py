"""Jobs that fail whatever is done: each is named, the others are kept."""

import pytest


@pytest.mark.thorough
def test_a_tile_that_always_fails_is_named_and_the_others_are_kept(tiles):
    tiles.without(2, 3)
    tiles.tell("broken", 3)
    said = tiles.end(tiles.start("--retries", "1"), succeeds=False)
    assert "Failed: tile of sweep plane 3 8" in said
    assert "this tile always fails" in said
    assert "1 of 2 done. Failed: tile_of_sweep" in said
    assert tiles.begun(2, 3) == [1, 2]
    assert tiles.tables() == {tile: rows for tile, rows in tiles.here.items() if tile != 3}


def test_a_partition_that_is_not_there_is_named_in_the_words_of_slurm(tiles):
    tiles.without(2)
    elsewhere = ("--set-resources", "tile_of_sweep:slurm_partition=nowhere")
    said = tiles.end(tiles.start("--retries", "0", *elsewhere), succeeds=False)
    assert "invalid partition specified: nowhere" in said
    assert "account" not in said, "the profile says that there are none"
    assert tiles.begun(2) == [0]
