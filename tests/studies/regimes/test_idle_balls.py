"""Long runs at equal forces end on the stable pair or with an idle ball, as docs/studies/findings.md states."""

import re

import numpy as np

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.studies.regimes.basins import plane

PAGE = " ".join((ROOT / "docs/studies/findings.md").read_text(encoding="utf-8").split())
SPEED, CHANGE = 1e-3, 1e-6


def test_long_runs_settle_except_for_idle_balls(chapter):
    """Runs have settled if they no longer change per cycle. Newton's method gives the stable orbits of the pair."""
    system = chapter(1.0, 1.0)
    pair = [orbit.state for orbit in vi.orbits(system) if orbit.admissible and orbit.stable]
    early = finals(system, plane(np.zeros(8), 15), 400)
    late = finals(system, early, 1600)

    def changing(states):
        return np.count_nonzero(np.abs(finals(system, states, 1) - states).max(axis=1) > CHANGE)

    def away(states):
        return np.min([np.abs(states - state).max(axis=1) for state in pair], axis=0) > CHANGE

    idle = (late[:, [5, 7]] == 0).any(axis=1)
    stated = re.search(r"Of 225 starts at equal forces, (\d+) end on this pair. In the (\d+) others a ball rests", PAGE)
    assert [changing(early), changing(late), np.count_nonzero(idle)] == [int(stated[1]), 0, int(stated[2])]
    np.testing.assert_array_equal(away(late), idle)
    nudged = late[idle]
    nudged[:, [5, 7]] += np.where(nudged[:, [5, 7]] == 0, SPEED, 0.0)
    assert not away(finals(system, nudged, 4000)).any()
