"""A sweep has the same bytes on two cores, in any number of tiles, and on a Slurm cluster of one machine."""

import subprocess
from importlib.util import find_spec

import pytest

from one_machine_slurm import PATIENCE, Slurm, missing
from pipeline_trees import ROOT, copied

SWEEP = """\
sweeps:
  plane:
    case: unequal
    axes:
      - {along: [epsilon], range: [0.025, 0.2], values: 4, scale: logarithmic}
      - {along: [f10_hat, f20_hat], listed: [0.5, 0.8]}
    observe: [amplitudes, fixed_points]
    starts: 2
    seed: 1
    cycles: 30
    settle: 20
"""
TABLE = "results/sweeps/plane.csv"
QUICK = ("--slurm-init-seconds-before-status-checks", "1", "--max-status-checks-per-second", "1", "--latency-wait", "5")


@pytest.fixture
def slurm(tmp_path):
    """Return a running Slurm cluster of this machine."""
    if lacking := missing():
        pytest.skip(f"Slurm needs {', '.join(lacking)} (.ci/run installs it)")
    if not find_spec("snakemake_executor_plugin_slurm"):
        pytest.skip("Snakemake has no Slurm plugin (make cluster-tools installs it)")
    slurm = Slurm(tmp_path / "slurm")
    try:
        try:
            slurm.start()
        except (AssertionError, subprocess.SubprocessError) as error:
            pytest.skip(f"Slurm does not start: {error}")
        yield slurm
    finally:
        slurm.stop()


@pytest.mark.thorough
def test_a_sweep_has_the_same_bytes_on_a_cluster(slurm, tmp_path):
    here, there = (copied(ROOT, tmp_path / name) for name in ("here", "there"))
    for tree in (here, there):
        tree.edit("config/studies.yaml", "sweeps:\n", SWEEP)
    here.snakemake("--set-scatter", "plane=1", "--", TABLE)
    build = there.start(
        *("--workflow-profile", "profiles/slurm", *QUICK, "--set-scatter", "plane=4", "--", TABLE), PATH=slurm.path
    )
    printed = build.communicate(timeout=PATIENCE)[0]
    assert build.returncode == 0, printed
    assert (there / TABLE).read_bytes() == (here / TABLE).read_bytes()
    submitted = "".join(path.read_text() for path in there.path.glob(".snakemake/log/*.log")).count("with SLURM jobid")
    assert submitted == 4, "only tiles are submitted: other jobs take a second"


@pytest.mark.thorough
def test_a_sweep_has_the_same_bytes_in_any_number_of_tiles(tmp_path):
    tree = copied(ROOT, tmp_path / "tree")
    tree.edit("config/studies.yaml", "sweeps:\n", SWEEP)
    tables = []
    for tiles in (1, 3):
        tree.snakemake("--set-scatter", f"plane={tiles}", "--", TABLE)
        tables.append((tree / TABLE).read_bytes())
        assert len(list((tree / "results/sweeps/plane/tiles").glob(f"*-of-{tiles}.csv"))) == tiles
    assert tables[0] == tables[1]
