"""A sweep on a scheduler: as on one machine, and whatever happens to its jobs on the way."""

import pytest

from one_machine_slurm import until


def test_a_sweep_is_the_same_bytes_though_a_job_is_cancelled(tiles, slurm):
    tree, gathered = tiles.tree, tiles.gathered
    before = {path.name for path in tree.path.iterdir()}
    expected = (tree / gathered).read_bytes()
    tiles.without(*tiles.all)
    (tree / gathered).unlink()
    tiles.tell("hold", 2)
    build = tiles.start(targets=[gathered])
    tiles.until_begun(2, build)
    tiles.until_heard(7, build)

    [job] = slurm.running()
    slurm("scancel", job)
    tiles.until_begun(2, build, times=2)
    tiles.release(2)
    tiles.end(build)

    assert tiles.tables() == tiles.here
    assert (tree / gathered).read_bytes() == expected
    assert tiles.begun(*tiles.all) == [1, 2, 1, 1, 1, 1, 1, 1]
    assert tiles.log().count("has been submitted with SLURM") == 9, "what takes a second goes to no scheduler"
    assert {path.name for path in tree.path.iterdir()} == before, "nothing is written anywhere else"


@pytest.mark.thorough
def test_a_scheduler_that_goes_away_and_comes_back_is_waited_for(tiles, slurm):
    tiles.without(1, 2)
    tiles.tell("hold", 2)
    build = tiles.start("--verbose")
    tiles.until_begun(2, build)
    tiles.until_heard(1, build)

    slurm.stop_controller()
    try:
        tiles.until(lambda: tiles.log().count("could not check status") >= 2, "no answer, twice", build)
        tiles.release(2)
        until((tiles.tree / "results/benchmarks/sweeps/plane/2-of-8.tsv").exists, "the job to end")
    finally:
        slurm.start_controller()
    tiles.end(build)

    assert tiles.tables() == tiles.here
    assert tiles.begun(1, 2, 3) == [1, 1, 0]
