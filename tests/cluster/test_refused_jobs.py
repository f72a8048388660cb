"""Jobs that fail whatever is done: each is named, the others are kept."""

import re


def test_a_tile_that_always_fails_is_named_and_the_others_are_kept(tiles):
    (tiles.tree / "broken-3-of-4").touch()
    build = tiles.start("--retries", "1")
    said = tiles.end(build)
    assert build.returncode != 0
    assert re.search("Failed: regime tile 3-of-4", said)
    assert "3 of 4 done. Failed: regime_tile" in said
    assert sorted(tiles.tables()) == ["1-of-4", "2-of-4", "4-of-4"]
    assert tiles.begun("3-of-4") == 2


def test_a_partition_that_is_not_there_is_named_in_the_words_of_slurm(tiles):
    build = tiles.start("--retries", "0", "--set-resources", "regime_tile:slurm_partition=nowhere")
    said = tiles.end(build)
    assert build.returncode != 0
    assert "invalid partition specified: nowhere" in said
    assert tiles.tables() == {}
