"""Two small sweeps, one of two axes in 8 tiles, one of one axis in 2: made once for all who look at them."""

import shutil

from pipeline_trees import ROOT, Tree, copied, made_once

SWEEPS = """\
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
  line:
    case: equal
    axes: [{along: [kappa], range: [0.5, 0.7], values: 2}]
    observe: [fixed_points]
"""
POINT_EACH = ("--set-resources", "plan_of_sweep:tile_seconds=0")
TARGETS = ("sweep_plane", "sweep_line")


def made(tmp_path_factory) -> Tree:
    """Both, a tile for every point. Read it, do not change it."""
    return made_once(tmp_path_factory, "swept", _asking, *POINT_EACH, "--", *TARGETS)


def again(tmp_path_factory, path) -> Tree:
    """The same, for a test to change."""
    shutil.copytree(made(tmp_path_factory).path, path, symlinks=True, ignore=shutil.ignore_patterns("locks"))
    return Tree(path)


def _asking(path):
    copied(ROOT, path).edit("config/config.yaml", "sweeps:\n", SWEEPS)
