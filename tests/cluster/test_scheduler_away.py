"""The scheduler goes away while jobs run, and comes back."""

from one_machine_slurm import until


def test_a_build_outlives_its_scheduler(tiles, slurm):
    tiles.hold("2-of-4")
    build = tiles.start("--verbose")
    tiles.until_heard(build, 3)
    tiles.until_begun("2-of-4", build)
    slurm.stop_controller()
    try:
        until(lambda: tiles.log().count("could not check status") >= 2, "two questions without an answer")
        tiles.release("2-of-4")
    finally:
        slurm.start_controller()
    said = tiles.end(build)
    assert build.returncode == 0, said
    assert [tiles.begun(tile) for tile in tiles.tables()] == [1, 1, 1, 1]
