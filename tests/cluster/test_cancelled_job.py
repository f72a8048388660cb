"""A job that is cancelled in mid-flight, by somebody or with its node."""


def test_a_cancelled_job_is_tried_again(tiles, slurm):
    tiles.hold("2-of-4")
    build = tiles.start()
    tiles.until_begun("2-of-4", build)
    tiles.until_heard(build, 3)
    [job] = slurm.running()
    slurm("scancel", job)
    tiles.until_begun("2-of-4", build, times=2)
    tiles.release("2-of-4")
    said = tiles.end(build)
    assert build.returncode == 0, said
    assert len(tiles.tables()) == 4
    assert [tiles.begun(tile) for tile in ("1-of-4", "3-of-4", "4-of-4")] == [1, 1, 1]
