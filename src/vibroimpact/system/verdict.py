"""Verdicts with three states, shared by every criterion of stability."""

STABLE, UNSTABLE, UNDECIDED = "stable", "unstable", "undecided"


def verdict(margin: float, error: float) -> str:
    """ "stable" or "unstable" by the sign of the margin; "undecided" where it is within its error, or not a number.

    Args:
        margin: distance from the threshold, positive on the stable side.
        error: bound on the error of the margin.
    """
    if margin > error:
        return STABLE
    return UNSTABLE if margin < -error else UNDECIDED


def all_stable(verdicts) -> str:
    """ "stable" if every verdict is, "unstable" if one of them is, else "undecided"."""
    found = set(verdicts)
    if UNSTABLE in found:
        return UNSTABLE
    return STABLE if found <= {STABLE} else UNDECIDED
