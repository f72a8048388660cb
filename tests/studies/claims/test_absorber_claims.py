"""Claims on the balls as absorbers: what would refute them does."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.studies.claims import absorber_checks
from vibroimpact.studies.claims.finding import HOLDS, IN_PART, OPEN, REFUTED
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact.system.state import IMPACT


def systems(**changes):
    """Evidence with the systems of the chapter, changed."""
    cases = {case: System(**{**PARAMETERS, **forces, **changes}) for case, forces in CASES.items()}
    return SimpleNamespace(systems=cases, system=next(iter(cases.values())))


def test_nearly_elastic_balls_do_not_absorb(monkeypatch):
    """They pass the energy on: what is lost is lost in the dampers, as without them."""
    monkeypatch.setattr(absorber_checks, "IMPULSES", absorber_checks.IMPULSES[3::4])
    inelastic, elastic = systems(), systems(kappa=0.99)
    most = "impacts take most of the energy of some shock"
    assert [absorber_checks.absorbs_rapidly(one).parts[most] for one in (inelastic, elastic)] == [True, False]
    felt = "felt for a shorter time, if a ball meets a wall"
    assert [absorber_checks.suppresses_shocks(one).parts[felt] for one in (inelastic, elastic)] == [True, False]


def test_boxes_without_dampers_ring_until_balls_stop_them():
    """What impacts take is then all that is lost, by the balance of energy: nine tenths when a tenth is left."""
    finding = absorber_checks.absorbs_rapidly(systems(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0))
    assert finding.verdict == HOLDS
    assert finding.numbers["without balls"] == np.inf
    assert finding.numbers["shares of the impacts"][:3] == [0.0, 0.0, 0.0]
    assert all(
        0.9 <= share < 0.96 for share in finding.numbers["shares of the impacts"][3:]
    )  # up to the end of that cycle


def test_impacts_take_most_of_the_energy_of_some_shocks_only():
    """By what a collision with restitution loses, summed over the impacts."""
    system = systems().system.with_(f10_hat=0.0, f20_hat=0.0)
    finding = absorber_checks.absorbs_rapidly(systems())
    assert finding.verdict == IN_PART
    assert [part for part, holds in finding.parts.items() if not holds] == [
        "of every shock that brings a ball to a wall"
    ]
    shares = finding.numbers["shares of the impacts"]
    for impulse, time, share in zip(absorber_checks.IMPULSES, finding.numbers["times with balls"], shares, strict=True):
        run = simulate(system, [0, 0, 0, 0, impulse, 0, 0, 0], int(np.ceil(time / system.period)))
        impacts = run.events[run.events["kind"] == IMPACT]
        box = 2 + 2 * impacts["module"]
        after = np.diff(np.take_along_axis(impacts["state"], np.stack([box, box + 1], axis=1), axis=1))
        # Of a collision of the masses 1 and epsilon; the relative velocity before it is that after it over -kappa.
        lost = system.epsilon / (1 + system.epsilon) * (1 / system.kappa**2 - 1) * (after**2).sum() / 2
        assert lost / (impulse**2 / 2) == pytest.approx(share, abs=1e-9)


def table_of_peaks(**values):
    """Peaks as companion_absorber tells them: value and spread of each, and the plateau of the restitution."""
    told = {"without balls": (50.0, np.nan), "balls fixed": (55.0, np.nan), "best absorbers": (5.0, np.nan)}
    told |= {"balls": (20.0, 1.0), "balls, best kappa": (10.0, 0.5)} | values
    rows = [{"quantity": "peak", "who": who, "value": value, "spread": spread} for who, (value, spread) in told.items()]
    table = pd.DataFrame(rows).assign(kappa=0.1, f10_hat=1.0, regime="symmetric")
    table = table.assign(of_without=table["value"] / 50.0, of_absorbers=table["value"] / 5.0)
    lowest = {
        "quantity": "lowest peak",
        "who": "balls",
        "kappa": [0.1, 0.5],
        "value": [10.0, 20.0],
        "spread": [0.5, 1.0],
    }
    plateau = pd.DataFrame({"quantity": ["plateau"], "who": ["balls"], "value": [0.1]})
    return pd.concat([table, pd.DataFrame(lowest), plateau], ignore_index=True)


@pytest.mark.parametrize(
    ("value", "spread", "expected"),
    [(20.0, 1.0, OPEN), (51.0, 1.0, IN_PART), (49.0, 1.0, IN_PART), (53.5, 1.0, REFUTED), (60.0, 1.0, REFUTED)],
)
def test_efficiency_is_a_peak_lower_than_without_balls_and_with_fixed_ones(value, spread, expected):
    """By twice its spread. If that is *very* efficient is left open; linear absorbers are no part of it."""
    table = table_of_peaks(balls=(value, spread))
    assert absorber_checks.efficient(SimpleNamespace(absorber=table)).verdict == expected


@pytest.mark.parametrize(
    ("best", "own", "at", "expected"),
    [
        ((10.0, 0.5), (20.0, 1.0), 1.0, HOLDS),
        ((10.0, 0.5), (11.0, 1.0), 1.0, IN_PART),  # not beyond the spreads of both
        ((10.0, 0.5), (20.0, 1.0), 0.25, IN_PART),  # the widest clearance that was tried
        ((70.0, 0.5), (70.0, 1.0), 4.0, REFUTED),
    ],
)
def test_an_optimum_is_inside_what_was_tried_and_beyond_the_spread(best, own, at, expected):
    """Peaks per force with one minimum over the force; that of the system is 2."""
    force = np.array([0.25, 0.5, 1.0, 2.0, 4.0])
    ratio = 15.0 + 20 * np.abs(np.log(force / at))
    clearance = pd.DataFrame({"f10_hat": force, "peak": 0.1 * force * ratio})
    table = table_of_peaks(**{"balls": own, "balls, best kappa": best})
    evidence = SimpleNamespace(clearance=clearance, absorber=table, system=systems().system.with_(f10_hat=2.0))
    found = absorber_checks.can_be_optimised(evidence)
    assert found.verdict == expected
    assert found.numbers["peak, of the chapter's"] == pytest.approx(best[0] / ratio[3], rel=1e-12)
