"""Find the first root of a power series on an interval, or prove that the interval has no root."""

from flint import arb, ctx


class Undecidable(ArithmeticError):
    """Raised if the working precision is too low to determine a sign on which the next event depends."""


def first_root(series, end: arb, hint: arb | None = None) -> arb | None:
    """Return an interval that contains the first root of a series in (0, end], but no other root of the series.

    If the series has no root in (0, end], the result is None.
    Mean-value enclosures of the series in interval arithmetic prove the result.

    series: arb_poly, positive at 0. hint: point at which (0, end] is split first.

    Raises
    ------
    Undecidable
        If the precision cannot distinguish a near miss from a contact.
    """
    if not series(arb(0)) > 0:
        raise Undecidable("cannot decide whether a ball touches or leaves a wall when a flight starts; use more digits")
    slope = series.derivative()
    pieces = [(arb(0), end, 0)] if hint is None else [(hint, end, 0), (arb(0), hint, 0)]
    while pieces:
        start, stop, depth = pieces.pop()
        middle = ((start + stop) / 2).mid()
        interval = start.union(stop)
        steepness = slope(interval)
        if series(middle) + steepness * (interval - middle) > 0 or steepness > 0:
            continue
        if steepness < 0:
            last = series(stop)
            if last > 0:
                continue
            if last < 0:
                return interval
            stop = (stop + (stop - start) / 8).mid()  # the root may be at `stop`: extend the interval
        if depth > 0.6 * ctx.prec:
            least = float(abs(series(middle)).upper())
            raise Undecidable(
                "cannot decide whether a ball touches a wall, or whether a sticking ball leaves its wall: "
                f"the gap or the contact force falls to {least:.1e}; use more digits"
            )
        pieces += [(middle, stop, depth + 1), (start, middle, depth + 1)]
    return None


def refine(series, ball: arb) -> arb:
    """Return the root of a series in the interval `ball`, to working precision.

    The series must decrease on this interval and have exactly one root in the interval.
    """
    slope = series.derivative()
    while True:
        middle = ball.mid()
        height = series(middle)
        narrower = (middle - height / slope(ball)).intersection(ball)
        if narrower.rad() > ball.rad() / 2:
            if height.contains(0):
                return narrower
            narrower = (ball.upper() if height > 0 else ball.lower()).union(middle).intersection(ball)
        ball = narrower
