"""Tiles of a small map of regimes on a Slurm that is really there."""

import os
import signal
import subprocess
from importlib.util import find_spec
from pathlib import Path

import pytest

from one_machine_slurm import PATIENCE, Slurm, missing, until
from pipeline_trees import ROOT, Tree, copied

SMALL = """
regimes:
  observation: {cycles: 20, rounds: 1, window: 8, blocks: 2, block: 5, retest: 50}
  map: {points: 4, tiles: 4, starts: 2}
"""
TILES = [f"{number}-of-4" for number in range(1, 5)]
WATCHED = """
if "snakemake" in globals():
    import pathlib, time

    tile = snakemake.wildcards.scatteritem
    with open(f"began-{tile}", "a") as began:
        began.write("once\\n")
    while pathlib.Path(f"hold-{tile}").exists():
        time.sleep(0.1)
    if pathlib.Path(f"broken-{tile}").exists():
        raise SystemExit("this tile always fails")
"""
"""Put before the code of a tile: it notes that it began, waits where it is told to, fails where it is told to."""


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
    """A project whose tiles are watched, and builds of it."""

    def __init__(self, tree: Tree, slurm: Slurm):
        self.tree, self.slurm = tree, slurm
        self.builds = []
        (tree / "small.yaml").write_text(SMALL)
        tree.edit("workflow/scripts/regime_tile.py", "from job import", f"{WATCHED}\nfrom job import")

    def start(self, *options, profile="profiles/slurm", also=()) -> subprocess.Popen:
        """A build in the background; Slurm is asked for news as often as it can be."""
        polled = ["--slurm-init-seconds-before-status-checks", "1", "--max-status-checks-per-second", "1"]
        build = self.tree.start(
            *("--workflow-profile", profile, "--configfile", "small.yaml", *options),
            *(polled if profile == "profiles/slurm" else []),
            *("--", *map(table, TILES), *also),
            PATH=self.slurm.path,
        )
        self.builds.append(build)
        return build

    def end(self, build) -> str:
        """What a build says; it ends within minutes."""
        return build.communicate(timeout=PATIENCE)[0]

    def build(self, *options, **settings) -> str:
        """What a build says that succeeds."""
        build = self.start(*options, **settings)
        said = self.end(build)
        assert build.returncode == 0, said
        return said

    def hold(self, tile):
        (self.tree / f"hold-{tile}").touch()

    def release(self, tile):
        (self.tree / f"hold-{tile}").unlink()

    def begun(self, tile) -> int:
        """How many times a tile was begun."""
        noted = self.tree / f"began-{tile}"
        return len(noted.read_text().splitlines()) if noted.exists() else 0

    def until_begun(self, tile, build, times=1):
        until(lambda: self.begun(tile) >= times or build.poll() is not None, f"tile {tile} to begin")
        assert build.poll() is None, self.end(build)

    def log(self) -> str:
        """What Snakemake itself has written down."""
        return "".join(path.read_text() for path in self.tree.path.glob(".snakemake/log/*.log"))

    def until_heard(self, build, count):
        """Until Snakemake knows that so many tiles are made."""
        text = f"{count} of 4 steps"
        until(lambda: build.poll() is not None or text in self.log(), text)
        assert build.poll() is None, self.end(build)

    def tables(self) -> dict[str, bytes]:
        """The content of all tiles that are there."""
        paths = {tile: self.tree / table(tile) for tile in TILES}
        return {tile: path.read_bytes() for tile, path in paths.items() if path.exists()}


def table(tile):
    return f"results/regimes/map/{tile}.csv"


@pytest.fixture
def tiles(slurm, tmp_path) -> Tiles:
    """The project before a build, with a map of 4 tiles of 4 cells."""
    tiles = Tiles(copied(ROOT, tmp_path / "tree"), slurm)
    yield tiles
    for build in tiles.builds:
        if build.poll() is None:
            os.killpg(build.pid, signal.SIGKILL)
            build.communicate()
    for held in Path(tiles.tree.path).glob("hold-*"):
        held.unlink()
    slurm("scancel", "--full", "--signal=KILL", "--user=root")
    until(lambda: not slurm("squeue", "--noheader"), "an empty queue")
