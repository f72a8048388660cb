"""Tiles of a small sweep on a Slurm that is really there."""

import os
import signal
import subprocess
from importlib.util import find_spec

import pytest

import swept
from one_machine_slurm import PATIENCE, Slurm, missing, until
from pipeline_trees import Tree

SWEEP = "results/sweeps/plane"
TILES = range(1, 9)
RUNNING = "with running(snakemake), at_most(snakemake.threads):"
WATCHED = """
        import pathlib, time

        watch = pathlib.Path("watch")
        with open(watch / f"began-{snakemake.wildcards.tile}", "a") as began:
            began.write("once\\n")
        while (watch / f"hold-{snakemake.wildcards.tile}").exists():
            time.sleep(0.1)
        if (watch / f"broken-{snakemake.wildcards.tile}").exists():
            raise SystemExit("this tile always fails")
"""
"""Put before the code of a tile: it notes that it began, waits where it is told to, fails where it is told to."""
IMPATIENT = """
if workflow.is_main_process and not workflow.local_exec:
    from snakemake_executor_plugin_slurm import Executor

    Executor.next_seconds_between_status_checks = property(lambda self: 1, lambda self, seconds: None)
"""
"""Put behind the rules: the plugin takes 10 s more from one question to the next, which no option changes."""
QUICK = (
    *("--slurm-init-seconds-before-status-checks", "1", "--max-status-checks-per-second", "1", "--latency-wait", "5"),
    *("--rerun-triggers", "mtime"),  # the watched code of tiles is no reason to make those that are there anew
)


@pytest.fixture(scope="session")
def slurm(tmp_path_factory):
    """A Slurm of one machine, for all tests of a process."""
    if lacking := missing():
        pytest.skip(f"no Slurm of one machine here: without {', '.join(lacking)} (.ci/run installs it)")
    if not find_spec("snakemake_executor_plugin_slurm"):
        pytest.skip("Snakemake has no Slurm plugin here: make cluster-tools")
    slurm = Slurm(tmp_path_factory.mktemp("slurm"))
    try:
        try:
            slurm.start()
        except (AssertionError, subprocess.SubprocessError) as error:
            pytest.skip(f"Slurm is installed and does not start here: {error}")
        yield slurm
    finally:
        slurm.stop()


class Tiles:
    """A sweep that was made on this machine, whose tiles are watched, and builds of it on Slurm."""

    all = TILES
    gathered = f"{SWEEP}.csv"

    def __init__(self, tree: Tree, slurm: Slurm):
        self.tree, self.slurm, self.builds = tree, slurm, []
        self.here = self.tables()
        (tree / "watch").mkdir()
        tree.edit("workflow/scripts/sweep_tile.py", RUNNING, f"{RUNNING}{WATCHED}")
        with open(tree / "workflow/Snakefile", "a", encoding="utf-8") as rules:
            rules.write(IMPATIENT)

    def without(self, *tiles):
        """Take tiles away, for the next build to make."""
        for tile in tiles:
            (self.tree / table(tile)).unlink()

    def start(self, *options, targets=()) -> subprocess.Popen:
        """A build in the background, of all tiles unless something else is asked for."""
        build = self.tree.start(
            *("--workflow-profile", "profiles/slurm", *QUICK, *options, "--", *(targets or map(table, TILES))),
            PATH=self.slurm.path,
        )
        self.builds.append(build)
        return build

    def end(self, build, succeeds=True) -> str:
        """What a build says; it ends within minutes."""
        said = build.communicate(timeout=PATIENCE)[0]
        assert (build.returncode == 0) == succeeds, said
        return said

    def tell(self, what, tile):
        """A tile to `hold`, or to be `broken`."""
        (self.tree / f"watch/{what}-{tile}").touch()

    def release(self, tile):
        (self.tree / f"watch/hold-{tile}").unlink()

    def begun(self, *tiles) -> list[int]:
        """How many times each of some tiles was begun."""
        noted = [self.tree / f"watch/began-{tile}" for tile in tiles]
        return [len(began.read_text().splitlines()) if began.exists() else 0 for began in noted]

    def until(self, true, what, build):
        """Until something is true of a build that goes on."""
        try:
            until(lambda: build.poll() is not None or true(), what)
        except AssertionError as error:
            error.add_note(f"Snakemake's log ends with\n{self.log()[-5000:]}")
            raise
        assert build.poll() is None, build.communicate()[0]

    def until_begun(self, tile, build, times=1):
        self.until(lambda: self.begun(tile) >= [times], f"tile {tile} to begin", build)

    def until_heard(self, count, build):
        """Until Snakemake knows that so many tiles are made."""
        self.until(lambda: self.log().count("(Rule: tile_of_sweep)") >= count, f"{count} tiles", build)

    def log(self) -> str:
        """What Snakemake itself has written down."""
        return "".join(path.read_text() for path in self.tree.path.glob(".snakemake/log/*.log"))

    def tables(self) -> dict[int, bytes]:
        """The content of all tiles that are there."""
        paths = {tile: self.tree / table(tile) for tile in TILES}
        return {tile: path.read_bytes() for tile, path in paths.items() if path.exists()}


def table(tile):
    return f"{SWEEP}/tiles/{tile}-of-{len(TILES)}.csv"


@pytest.fixture
def tiles(slurm, tmp_path_factory, tmp_path) -> Tiles:
    """A sweep of 8 tiles, all of them made on this machine."""
    tree = swept.again(tmp_path_factory, tmp_path / "tree")
    for log in tree.path.glob(".snakemake/log/*"):
        log.unlink()
    tiles = Tiles(tree, slurm)
    assert len(tiles.here) == len(TILES)
    yield tiles
    for build in tiles.builds:
        if build.poll() is None:
            os.killpg(build.pid, signal.SIGKILL)
            build.communicate()
    for held in tree.path.glob("watch/hold-*"):
        held.unlink()
    slurm("scancel", "--full", "--signal=KILL", "--user=root")
    until(lambda: not slurm("squeue", "--noheader"), "an empty queue")
