"""Verdicts on stability: stable, unstable or undecided."""

STABLE, UNSTABLE, UNDECIDED = "stable", "unstable", "undecided"


def verdict(margin: float, error: float) -> str:
    """Return "stable", "unstable" or "undecided" by the sign of the margin.

    The verdict is "undecided" where the margin is within its error or not a number.

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
    """Return "stable" if every verdict is, "unstable" if one of them is, else "undecided"."""
    found = set(verdicts)
    if UNSTABLE in found:
        return UNSTABLE
    return STABLE if found <= {STABLE} else UNDECIDED
