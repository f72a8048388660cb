"""Verdicts on stability, "stable", "unstable" or "undecided", from numbers with error bounds."""

STABLE, UNSTABLE, UNDECIDED = "stable", "unstable", "undecided"


def verdict(margin: float, error: float) -> str:
    """Return "stable" for a positive margin, "unstable" for a negative one, or "undecided".

    The verdict is "undecided" if the margin is not larger in magnitude than its error, or not a number.

    Parameters
    ----------
    margin : float
        Distance from the threshold, positive on the stable side.
    error : float
        Bound on the error of the margin.
    """
    if margin > error:
        return STABLE
    return UNSTABLE if margin < -error else UNDECIDED


def all_stable(verdicts) -> str:
    """Return "stable" if every verdict is "stable", "unstable" if one is "unstable", else "undecided"."""
    found = set(verdicts)
    if UNSTABLE in found:
        return UNSTABLE
    return STABLE if found <= {STABLE} else UNDECIDED
