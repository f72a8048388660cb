"""Decide whether a motion is "stable", "unstable" or "undecided" from numbers with known error bounds."""

STABLE, UNSTABLE, UNDECIDED = "stable", "unstable", "undecided"


def verdict(margin: float, error: float) -> str:
    """Return "stable" if margin > error, "unstable" if margin < -error, and otherwise "undecided".

    `margin` is a number that is positive for a stable motion. `error` is an upper bound on the error of `margin`. If
    one of them is nan, the verdict is "undecided".
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
