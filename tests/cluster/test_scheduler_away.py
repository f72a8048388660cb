"""The scheduler goes away while jobs run, and comes back."""

import time


def test_a_build_outlives_its_scheduler(tiles, slurm):
    tiles.hold("2-of-4")
    build = tiles.start()
    tiles.until_begun("2-of-4", build)
    slurm.stop_controller()
    time.sleep(15)  # in which it is asked for news, several times, and does not answer
    tiles.release("2-of-4")
    tiles.until_made("2-of-4")
    slurm.start_controller()
    said = tiles.end(build)
    assert build.returncode == 0, said
    assert len(tiles.tables()) == 4
