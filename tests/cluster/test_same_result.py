"""A sweep on a scheduler: as on one machine, and whatever happens to its jobs on the way."""

from one_machine_slurm import until


def test_a_sweep_is_the_same_bytes_though_a_job_is_cancelled_and_the_scheduler_goes_away(tiles, slurm):
    tree, gathered = tiles.tree, tiles.gathered
    before = {path.name for path in tree.path.iterdir()}
    expected = (tree / gathered).read_bytes()
    tiles.without(*tiles.all)
    (tree / gathered).unlink()
    tiles.tell("hold", 2)
    build = tiles.start("--verbose", targets=[gathered])
    tiles.until_heard(7, build)

    [job] = slurm.running()
    slurm("scancel", job)
    tiles.until_begun(2, build, times=2)

    slurm.stop_controller()
    try:
        away = tiles.log().count("could not check status")
        tiles.until(lambda: tiles.log().count("could not check status") >= away + 2, "no answer, twice", build)
        tiles.release(2)
        until((tree / "results/benchmarks/sweeps/plane/2-of-8.tsv").exists, "the job to end")
    finally:
        slurm.start_controller()
    tiles.end(build)

    assert tiles.tables() == tiles.here
    assert (tree / gathered).read_bytes() == expected
    assert tiles.begun(*tiles.all) == [1, 2, 1, 1, 1, 1, 1, 1]
    assert tiles.log().count("has been submitted with SLURM") == 9, "what takes a second goes to no scheduler"
    assert {path.name for path in tree.path.iterdir()} == before, "nothing is written anywhere else"
