"""Events that coincide with each other, with the start, the end or a sample, in every contact state.

docs/engine.md has the definitions. Runs are compared with the arbitrary-precision reference, with closed forms, and
with runs in which the modules are swapped.
"""

from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from attacks import same_events
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import IMPACT, RELEASE, STICK

DIGITS = 40
SWAP = [2, 3, 0, 1, 6, 7, 4, 5]
SWAPPED = pytest.mark.parametrize("swap", [False, True], ids=["as it is", "swapped"])
SYSTEM = vi.System(
    epsilon=0.5, kappa=0.65, alpha12_hat=0.4, gamma1_hat=0.3, gamma2_hat=0.1, gamma12_hat=0.4, sigma20_hat=0.0,
    sigma_e_hat=6.0, f10_hat=0.3, f20_hat=-0.2,
)  # fmt: skip
# Starts of one module: X, Y, X', Y'.
FLIES = (-0.2, -0.1, 0.0, 0.0)
MEETS = (0.1, -0.3, 0.2, -1.3)
STICKS = (-2.5, -3.5, 0.0, 0.0)
RELEASES = (-0.9, -1.9, 0.0, 0.0)
CHATTERS = (-1.5, -2.49, 0.0, 0.0)
# Starts of both modules, and the event of module 1 to be tested.
PROBLEMS = {
    "impact, other flies": (MEETS, FLIES, IMPACT),
    "impact, other sticks": (MEETS, STICKS, IMPACT),
    "impact that releases the other": ((0.1, -0.3, 0.2, -6.0), (-0.4, -1.4, 0.0, 0.0), IMPACT),
    "release, other flies": (RELEASES, FLIES, RELEASE),
    "release, other sticks": (RELEASES, STICKS, RELEASE),
    "chatter ends, other flies": (CHATTERS, FLIES, STICK),
    "chatter ends, other sticks": (CHATTERS, STICKS, STICK),
}
# Starts of both modules, their events, and bounds on the velocity of module 2 (at an impact: of its ball) at which both
# events coincide.
PAIRS = {
    "impact and impact": (MEETS, FLIES, IMPACT, IMPACT, (-3.0, -2.2)),
    "release and impact that pulls": (RELEASES, FLIES, RELEASE, IMPACT, (-0.6, -0.4)),
    "release and impact that pushes": (RELEASES, FLIES, RELEASE, IMPACT, (0.35, 0.6)),
    "end of chatter and impact": (CHATTERS, FLIES, STICK, IMPACT, (-2.6, -1.8)),
    "release and release": (RELEASES, RELEASES, RELEASE, RELEASE, (-0.3, -0.1)),
    "end of chatter and release": (CHATTERS, RELEASES, STICK, RELEASE, (0.8, 1.0)),
    "end of chatter and end of chatter": (CHATTERS, CHATTERS, STICK, STICK, (-0.4, -0.1)),
}


def start_of(first, second):
    return np.array([*first[:2], *second[:2], *first[2:], *second[2:]])


def arranged(system, start, swap):
    """Return system, start and number of the first module, with the modules swapped or not."""
    if not swap:
        return system, start, 1
    changes = {"gamma1_hat": system.gamma2_hat, "gamma2_hat": system.gamma1_hat}
    changes |= {"f10_hat": system.f20_hat, "f20_hat": system.f10_hat}
    return system.with_(**changes), start[SWAP], 2


def events_of(events, module, kind):
    return events[(events["module"] == module) & (events["kind"] == kind)]


def truth_of(system, start, cycles):
    return reference_run(system, start, cycles, DIGITS, exact_floats=False)


def time_of(system, start, module, kind):
    """Return the time of the first event of a kind and module in the reference."""
    return events_of(truth_of(system, start, 4.0 / system.period).events, module, kind)["tau"][0]


def assert_same_motion(run, events, final, kinds=(IMPACT, STICK, RELEASE)):
    np.testing.assert_allclose(run.final, final, rtol=0, atol=1e-12)
    assert same_events(*(some[np.isin(some["kind"], kinds)] for some in (run.events, events)), late=1e-6)


@cache
def coincident(pair):
    """Return a start from which the two events of a pair happen at the same time."""
    first, second, kind, other, bracket = PAIRS[pair]

    def start(velocity):
        tuned = start_of(first, second)
        tuned[[7] if other == IMPACT else [6, 7]] = velocity
        return tuned

    def apart(velocity):  # before its impact a ball does not affect the boxes
        undisturbed = start_of(first, second) if other == IMPACT else start(velocity)
        return time_of(SYSTEM, undisturbed, 1, kind) - time_of(SYSTEM, start(velocity), 2, other)

    return start(brentq(apart, *bracket, xtol=1e-15))


@cache
def ending(problem):
    """Return the sigma_e_hat at which the forcing period equals the time of the event of a problem."""
    *parts, kind = PROBLEMS[problem]

    def lag(sigma):
        system = SYSTEM.with_(sigma_e_hat=sigma)
        return time_of(system, start_of(*parts), 1, kind) - system.period

    return brentq(lag, 3.0, 200.0, xtol=1e-15)


NUDGES = [-1e-9, -1e-12, -4e-16, 0.0, 4e-16, 1e-12, 1e-9]


@pytest.mark.parametrize("nudge", NUDGES)
@SWAPPED
@pytest.mark.parametrize("pair", PAIRS)
def test_two_events_at_the_same_or_almost_the_same_time(pair, swap, nudge):
    """Rounding may decide the order of two events, in which case the run is undecided."""
    start = coincident(pair).copy()
    start[6:] *= 1.0 + nudge
    system, start, _ = arranged(SYSTEM, start, swap)
    run, truth = vi.simulate(system, start, 2), truth_of(system, start, 2)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-12)
    assert same_events(run.events, truth.events, late=1e-6) or run.certificate.undecided


@pytest.mark.parametrize("nudge", NUDGES)
@SWAPPED
@pytest.mark.parametrize("problem", PROBLEMS)
def test_an_event_at_the_end_belongs_to_the_run_and_not_to_its_continuation(problem, swap, nudge):
    *parts, kind = PROBLEMS[problem]
    system = SYSTEM.with_(sigma_e_hat=ending(problem) * (1.0 + nudge))
    system, start, module = arranged(system, start_of(*parts), swap)
    whole, truth = vi.simulate(system, start, 2), truth_of(system, start, 2)
    assert_same_motion(whole, truth.events, truth.final)
    if problem == "impact that releases the other":
        assert events_of(whole.events, 3 - module, RELEASE)["tau"] == events_of(whole.events, module, IMPACT)["tau"]
    first = vi.simulate(system, start, 1)
    if kind != STICK:  # the impacts of a chatter may end before or after the end of the run
        assert len(events_of(first.events, module, kind)) == (nudge <= 4e-16)
    kinds = (IMPACT, RELEASE)  # a ball that sticks at the end is listed again where the run is continued
    second = vi.simulate(system, first.final, 1)
    later = whole.events[len(first.events) :].copy()
    later["tau"] -= system.period
    assert_same_motion(first, whole.events[: len(first.events)], first.final, kinds)
    assert_same_motion(second, later, whole.final, kinds)


@pytest.mark.parametrize("late", [-1e-9, -1e-13, -4e-16, 0.0, 4e-16, 1e-13, 1e-9])
@pytest.mark.parametrize("module", [1, 2])
def test_an_impact_within_rounding_of_the_end_is_undecided(module, late):
    """The boxes are at rest; a ball arrives at constant speed after 1 + late periods."""
    system, start = SYSTEM.with_(f10_hat=0.0, f20_hat=0.0), np.zeros(8)
    start[3 + 2 * module] = 1.0 / ((1.0 + late) * system.period)
    run = vi.simulate(system, start, 1)
    assert run.certificate.undecided == (abs(late) < 1e-15)
    assert len(run.events) == (late < 1e-15)


@SWAPPED
@pytest.mark.parametrize("tau0", [0.0, 0.3, 1234.5])
@pytest.mark.parametrize("problem", PROBLEMS)
def test_a_sample_at_an_event_is_the_state_after_it(problem, tau0, swap):
    *parts, kind = PROBLEMS[problem]
    system, start, module = arranged(SYSTEM, start_of(*parts), swap)
    event = events_of(vi.simulate(system, start, 2, tau0).events, module, kind)[0]
    around = np.nextafter(event["tau"], [-np.inf, event["tau"], np.inf])
    before, at, after = vi.simulate(system, start, 2, tau0, sample_times=around).samples
    np.testing.assert_allclose(at, event["state"], rtol=0, atol=1e-11)
    np.testing.assert_allclose(after, event["state"], rtol=0, atol=1e-11)
    velocities = [2 + 2 * module, 3 + 2 * module]
    if kind == IMPACT:  # Newton's law backwards
        event["state"][velocities] = after_impact(system.epsilon, 1.0 / system.kappa, *event["state"][velocities])
    np.testing.assert_allclose(before, event["state"], rtol=0, atol=1e-11)


OUTWARD, INWARD = (-0.4, -1.4, 0.9, 0.2), (-0.4, -1.4, -0.9, -0.2)
STARTS = {
    # starts of both modules, and the events at the start; a box pushes its ball if x < 0
    "impact, other flies": (OUTWARD, FLIES, {(1, IMPACT)}),
    "impact, other sticks": (OUTWARD, STICKS, {(1, IMPACT), (2, STICK)}),
    "impact pulls the other ball off its wall": ((-0.4, -1.4, 9.0, -9.0), (-0.1, -1.1, 0.0, 0.0), {(1, IMPACT)}),
    "impact presses the other on": ((-0.4, 0.6, -9.0, 30.0), (0.1, -0.9, 0.0, 0.0), {(1, IMPACT), (2, STICK)}),
    "impact and impact": (OUTWARD, OUTWARD, {(1, IMPACT), (2, IMPACT)}),
    "both stick: no impact": (STICKS, STICKS, {(1, STICK), (2, STICK)}),
    "just after an impact": (INWARD, FLIES, set()),
}


@SWAPPED
@pytest.mark.parametrize(("first", "second", "expected"), STARTS.values(), ids=STARTS)
def test_events_at_the_start(first, second, expected, swap):
    system, start, _ = arranged(SYSTEM, start_of(first, second), swap)
    run, truth = vi.simulate(system, start, 1), truth_of(system, start, 1)
    found = {(3 - e["module"] if swap else e["module"], e["kind"]) for e in run.events if e["tau"] == 0.0}
    assert found == expected
    assert_same_motion(run, truth.events, truth.final)
    instant = vi.simulate(system, start, 0, sample_times=[0.0])  # the start is also the end, and a sample
    assert_same_motion(vi.simulate(system, instant.final, 1), run.events[run.events["tau"] > 0.0], run.final)
    np.testing.assert_array_equal(instant.samples[0], instant.final)
