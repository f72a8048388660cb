"""Define test problems that are hard for a known reason, and judge integration methods on these problems."""

from dataclasses import dataclass

from vibroimpact.accuracy.errors import FAINT, run_errors
from vibroimpact.accuracy.grazing import grazing_start
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.integrators.protocol import REFUSED, UNFINISHED
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS

VISIBLE = 1e-2
"""Error of the final state that is visible in a figure: half a percent of the distance between the walls."""

SETTLED_CHANGE = 1e-6
"""Largest change of a coordinate over one cycle of a settled motion."""

RIGHT, SILENTLY_WRONG, UNDECIDABLE = "right", "silently wrong", "reported undecidable"
ERROR, ENDLESS, UNAVAILABLE = "refused with an error", "did not finish", "unavailable"
FAILURES = {REFUSED: ERROR, UNFINISHED: ENDLESS}

CHAPTER = PARAMETERS | CASES["equal"]


@dataclass(frozen=True)
class StressTest:
    """Test problem that is hard for a known reason.

    state: initial state at tau = 0, shape (8,).
    cycles: number of forcing cycles.
    faint: largest rebound speed of an impact that a method may miss.
    reference_cycles: number of cycles of the reference run, after which the motion has settled. If this number is None,
    the reference run has `cycles` cycles.
    quick: True if the test is also in the reduced set of tests.
    """

    group: str
    name: str
    system: System
    state: tuple[float, ...]
    cycles: int
    faint: float = FAINT
    reference_cycles: int | None = None
    quick: bool = True


REST = (0.0,) * 8
SETTLED = (-0.0863, 0.3689, -0.4889, -0.7167, -0.1597, -0.6893, -0.3681, -1.2869)
MODULATED = (0.0647, 0.5421, -0.1898, 0.0, -0.2101, -0.6997, 0.0459, 0.0)
PRESSED = (-0.8, -1.799, 0.1, 0.1, 0.0, -0.01, 0.0, 0.0)  # ball 1 will hit a wall slowly and chatter
RESTING = (-0.8, -1.8, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0)  # ball 1 rests on a wall that pushes it
TOGETHER = (0.1, 0.3, 0.1, 0.3, 0.2, -0.6, 0.2, -0.6)  # both modules move in the same way
MIRRORED = (0.1, 0.3, -0.1, -0.3, 0.2, -0.6, -0.2, 0.6)  # module 2 mirrors module 1
FOLD = (0.0817, -0.8165, 0.0817, -0.8165, 0.1945, -0.5797, 0.1945, -0.5797)  # at the fold of the slow manifold (10.25)


def stress_tests() -> list[StressTest]:
    """Return all stress tests, in the order of the tables; add a new test here."""
    system = System(**CHAPTER)
    weak = system.with_(f10_hat=0.5, f20_hat=0.5)
    twins = system.with_(sigma20_hat=0.0)
    still = system.with_(f10_hat=0.0, f20_hat=0.0)
    return [
        *(grazing(system, side, n) for n in (2, 6, 10, 12, 13, 14) for side in (1, -1)),
        *(StressTest("chatter", f"kappa = {k}", system.with_(kappa=k), PRESSED, 2) for k in (0.3, 0.65, 0.9)),
        StressTest("sticking", "stick and release", system, RESTING, 2),
        StressTest("sticking", "modulated response", weak, MODULATED, 8),
        StressTest("coincidence", "both balls, same wall", twins, TOGETHER, 3),
        StressTest("coincidence", "both balls, opposite walls", twins.with_(f20_hat=-1.0), MIRRORED, 3),
        StressTest("coincidence", "impact on a step boundary", still, _crossing(still, 0.5), 1),
        StressTest("coincidence", "impact 1e-9 before the end", still, _crossing(still, 1.0 - 1e-9), 1),
        StressTest("coincidence", "impact 1e-9 after the end", still, _crossing(still, 1.0 + 1e-9), 1),
        StressTest("long run", "100 000 cycles", system, SETTLED, 100_000, reference_cycles=2_000, quick=False),
        StressTest("extreme parameters", "kappa = 1e-3", system.with_(kappa=1e-3), SETTLED, 3),
        StressTest("extreme parameters", "kappa = 1e-6", system.with_(kappa=1e-6), SETTLED, 3, quick=False),
        StressTest("extreme parameters", "kappa = 0.999", system.with_(kappa=0.999), SETTLED, 5),
        StressTest("extreme parameters", "epsilon = 0.5", system.with_(epsilon=0.5), SETTLED, 5),
        StressTest("extreme parameters", "epsilon = 1", system.with_(epsilon=1.0), SETTLED, 5),
        StressTest("slow manifold", "near the fold", weak, FOLD, 10),
        StressTest("chaos", "within the horizon", weak, REST, 20),
        StressTest("chaos", "far beyond the horizon", weak, REST, 120, quick=False),
    ]


def judge(test: StressTest, methods) -> list[dict]:
    """Run each method on a stress test, with the setting `Method.careful`; return one row with a verdict per method."""
    reference = reference_of(test)
    return [_row(test, method, reference) for method in methods]


def reference_of(test: StressTest):
    """Return the reference run of a stress test.

    Raises
    ------
    ArithmeticError
        If the motion has not settled after `test.reference_cycles` cycles.
    """
    if test.reference_cycles is None:
        return proven_run(test.system, test.state, test.cycles, exact_floats=False).run
    times = [(test.reference_cycles - 1) * test.system.period]
    # Errors do not grow near an attracting motion. Therefore `proven_run` can start with few digits.
    few = {"digits": 40, "sample_times": times, "exact_floats": False}
    run = proven_run(test.system, test.state, test.reference_cycles, **few).run
    change = abs(run.samples[0] - run.final).max()
    if change > SETTLED_CHANGE:
        raise ArithmeticError(
            f"stress test {test.name!r}: the reference motion still changes by {change:.1e} in cycle "
            f"{test.reference_cycles}; expected at most {SETTLED_CHANGE:.0e}"
        )
    return run


def _row(test, method, reference):
    row = {"group": test.group, "test": test.name, "method": method.name, "family": method.family}
    if missing := method.available():
        return row | {"verdict": UNAVAILABLE, "reason": missing}
    run = method.run(test.system, test.state, test.cycles, 0.0, method.careful)
    row |= {"setting": str(method.careful), "steps": run.steps}
    if run.outcome in FAILURES:
        return row | {"verdict": FAILURES[run.outcome], "reason": run.reason}
    whole = test.reference_cycles is None
    errors, doubt = run_errors(run, reference, test.system.period, test.faint, events=whole), run.doubt()
    wrong = not errors.error_state <= VISIBLE or errors.missed or errors.spurious
    verdict = UNDECIDABLE if doubt else SILENTLY_WRONG if wrong else RIGHT
    return row | {"verdict": verdict, **errors._asdict(), "reason": doubt}


def grazing(system: System, side: int, digits: int) -> StressTest:
    """Return the test in which ball 1 barely misses a wall (side 1) or barely hits a wall (side -1).

    If ball 1 misses the wall, the smallest gap is 10^-digits. If ball 1 hits the wall, the ball would go 10^-digits
    beyond the wall without the impact.
    """
    start = grazing_start(system, ("0.4", "-0.3", "0.5", "0.2"), "0.15", guess=1.0, clearance=f"{side}e-{digits}")
    name = f"{'clears' if side > 0 else 'hits'} by 1e-{digits}"
    return StressTest("grazing", name, system, start, 1, faint=0.0, quick=digits in (2, 6, 10, 14))


def _crossing(system, periods):
    """Return a state from which ball 1 hits a wall after `periods` forcing periods, up to rounding.

    The forces of `system` must be 0, so that the boxes stay at rest until the impact.
    """
    return (0.0, 0.0, 0.0, 0.0, 0.0, -1.0 / (periods * system.period), 0.0, 0.0)
