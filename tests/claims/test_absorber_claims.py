"""Claims on the balls as absorbers: what would refute them does."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from vibroimpact.claims import absorber
from vibroimpact.claims.finding import HOLDS, IN_PART, REFUTED
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS


def systems(**changes):
    """Evidence with the systems of the chapter, changed."""
    cases = {case: System(**{**PARAMETERS, **forces, **changes}) for case, forces in CASES.items()}
    return SimpleNamespace(systems=cases, system=next(iter(cases.values())))


def test_nearly_elastic_balls_neither_absorb_nor_leave_anything_to_harvest(monkeypatch):
    """They pass the energy on: what is lost is lost in the dampers, as without them."""
    monkeypatch.setattr(absorber, "IMPULSES", absorber.IMPULSES[3::4])
    inelastic, elastic = systems(), systems(kappa=0.99)
    assert absorber.absorbs_rapidly(inelastic).verdict == IN_PART
    assert absorber.absorbs_rapidly(elastic).verdict == REFUTED
    felt = "felt for a shorter time, if a ball meets a wall"
    assert [absorber.suppresses_shocks(one).parts[felt] for one in (inelastic, elastic)] == [True, False]
    harvested = absorber.modulation_favours_harvesting(elastic, "weak").parts
    assert not harvested["impacts take more in a cycle"]


def test_boxes_without_dampers_ring_until_balls_stop_them():
    """What impacts take is then all that is lost, by the balance of energy: nine tenths when a tenth is left."""
    finding = absorber.absorbs_rapidly(systems(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0))
    assert finding.numbers["without balls"] == np.inf
    assert 0.9 <= finding.numbers["share of the impacts"] < 0.95  # up to the end of that cycle


PEAKS = pd.DataFrame(
    {
        "quantity": "peak",
        "who": ["balls", "balls, best kappa", "balls fixed"],
        "value": [20.0, 10.0, 55.0],
        "of_without": [0.4, 0.2, 1.1],
        "of_absorbers": [0.9, 0.8, 12.0],
        "kappa": [0.65, 0.1, np.nan],
        "regime": ["strongly modulated", "other periodic", None],
    }
)


@pytest.mark.parametrize(
    ("value", "of_without", "of_absorbers", "expected"),
    [(20.0, 0.4, 0.9, HOLDS), (20.0, 0.4, 4.0, IN_PART), (60.0, 1.2, 14.0, REFUTED)],
)
def test_efficiency_is_that_of_the_lowest_peak(value, of_without, of_absorbers, expected):
    peaks = PEAKS.copy()
    peaks.loc[0, ["value", "of_without", "of_absorbers"]] = value, of_without, of_absorbers
    assert absorber.efficient(SimpleNamespace(absorber=peaks)).verdict == expected


@pytest.mark.parametrize(("at", "expected"), [((0.5, 1.0), HOLDS), ((0.1, 1.0), IN_PART), ((0.65, 4.0), REFUTED)])
def test_an_optimum_lies_inside_what_was_tried(at, expected):
    """Peaks per force with one minimum, at a kappa and a force; those of the system are 0.65 and that force or 2."""
    kappa, force = (values.ravel() for values in np.meshgrid([0.1, 0.5, 0.65], [0.25, 1.0, 2.0, 4.0]))
    ratio = 3.0 + np.abs(kappa - at[0]) + np.abs(np.log(force / at[1]))
    design = pd.DataFrame({"kappa": kappa, "f10_hat": force, "peak": ratio * force})
    own = systems().system.with_(f10_hat=4.0 if expected == REFUTED else 2.0)
    tables = {"design": design, "clearance": design[design["kappa"] == 0.65], "absorber": PEAKS}
    assert absorber.can_be_optimised(SimpleNamespace(**tables, system=own)).verdict == expected
