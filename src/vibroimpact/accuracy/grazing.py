"""Compute, in high precision, initial states from which a ball barely misses or barely hits a wall."""

from fractions import Fraction

from vibroimpact.accuracy.reference.taylor_models import ExactSystem, rate_matrix, to_ball
from vibroimpact.system.extras import need

need("reference", "flint")

from flint import arb, arb_mat, ctx  # noqa: E402 (after the dependency check)

BITS = 256
NEWTON_STEPS = 12


def grazing_start(system, boxes, ball_velocity, guess, clearance) -> tuple[float, ...]:
    """Return an initial state, shape (8,), from which ball 1 barely misses or barely hits the wall +1.

    W_1 = X_1 - Y_1 has a maximum when X_1' equals the ball velocity. The time of the maximum does not depend on the
    initial Y_1. This time is therefore computed first. Then Y_1 is chosen such that the maximum has the required value.
    Rounding the initial state to floats changes the clearance by up to 1e-16.

    boxes: initial X_1, X_2, X_1', X_2' as decimal strings. guess: time tau near the maximum of W_1.
    clearance: 1 - (maximum of W_1 in a motion without impacts). If `clearance` is negative, ball 1 hits the wall.

    Raises
    ------
    ValueError
        If W_1 has no maximum near `guess`.
    """
    rates = rate_matrix(ExactSystem.of(system), (False, False))
    with ctx.workprec(BITS):
        start = arb_mat(6, 1, [*(to_ball(Fraction(str(value))) for value in boxes), arb(0), arb(1)])
        rate = arb_mat(6, 6, [to_ball(entry) for row in rates for entry in row])
        speed, tau = to_ball(Fraction(str(ball_velocity))), arb(str(guess))
        for _ in range(NEWTON_STEPS):
            there = (rate * tau).exp() * start
            acceleration = (rate * there)[2, 0]
            tau = (tau - (there[2, 0] - speed) / acceleration).mid()
        if not acceleration < 0:
            raise ValueError(f"guess: W_1 has no maximum near tau = {guess}")
        highest = ((rate * tau).exp() * start)[0, 0] - speed * tau
        ball = float(highest - 1 + to_ball(Fraction(str(clearance))))
    x1, x2, v1, v2 = (float(value) for value in boxes)
    return x1, ball, x2, x2, v1, float(ball_velocity), v2, v2
