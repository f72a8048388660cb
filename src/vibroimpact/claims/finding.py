"""What a check says of a claim: a verdict that follows from its parts, and the numbers behind it."""

from dataclasses import dataclass, field

import numpy as np

HOLDS, IN_PART, REFUTED, OPEN = "holds", "holds in part", "refuted", "cannot be decided from the text"
VERDICTS = (HOLDS, IN_PART, REFUTED, OPEN)


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    parts: what the claim asserts, piece by piece: true, false, or None where the text leaves open what it asserts.
    numbers: what was measured, by name.
    """

    parts: dict[str, bool | None]
    numbers: dict = field(default_factory=dict)

    def __post_init__(self):
        if not self.parts:
            raise ValueError("parts: a finding without parts says nothing")
        # Plain numbers, so that a finding can be written down, whatever NumPy made them.
        object.__setattr__(self, "parts", {name: _plain(value) for name, value in self.parts.items()})
        object.__setattr__(self, "numbers", {name: _plain(value) for name, value in self.numbers.items()})

    @property
    def verdict(self) -> str:
        """One of VERDICTS: holds if all parts do, refuted if none does, in part between; open if some part is."""
        found = list(self.parts.values())
        if None in found:
            return OPEN
        if all(found):
            return HOLDS
        return IN_PART if any(found) else REFUTED


def _plain(value):
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value


def misprint(printed: bool, corrected: bool, **numbers) -> Finding:
    """Of a claim whose printed form is not meant: judged as printed, with what holds of the corrected form beside."""
    return Finding({"as printed": printed}, {**numbers, "as corrected": HOLDS if corrected else REFUTED})
