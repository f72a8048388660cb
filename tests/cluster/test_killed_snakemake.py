"""Snakemake is killed, its jobs are not."""

import os
import signal


def test_what_was_made_is_not_made_again(tiles, slurm):
    tiles.hold("2-of-4")
    build = tiles.start()
    tiles.until_begun("2-of-4", build)
    tiles.until_heard(build, 3)
    os.killpg(build.pid, signal.SIGKILL)
    tiles.end(build)
    [left] = slurm.running()
    again = tiles.start()
    tiles.until_begun("2-of-4", again, times=2)
    assert left not in slurm.running()  # two jobs at once would write the same file
    tiles.release("2-of-4")
    said = tiles.end(again)
    assert again.returncode == 0, said
    assert {tile: tiles.begun(tile) for tile in tiles.tables()} == dict(
        zip(("1-of-4", "2-of-4", "3-of-4", "4-of-4"), (1, 2, 1, 1), strict=True)
    )
