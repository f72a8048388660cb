"""Snakemake is killed, its jobs are not."""

import os
import signal

import pytest


@pytest.mark.thorough
def test_what_was_made_is_not_made_again(tiles, slurm):
    tiles.without(1, 2)
    tiles.tell("hold", 2)
    build = tiles.start()
    tiles.until_begun(2, build)
    tiles.until_heard(1, build)
    os.killpg(build.pid, signal.SIGKILL)
    tiles.end(build, succeeds=False)
    [left] = slurm.running()
    again = tiles.start()
    tiles.until_begun(2, again, times=2)
    assert left not in slurm.running(), "two jobs at once would write the same file"
    tiles.release(2)
    tiles.end(again)
    assert tiles.begun(1, 2, 3) == [1, 2, 0]
    assert tiles.tables() == tiles.here
