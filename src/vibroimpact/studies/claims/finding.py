"""Finding of a check: a verdict that follows from its parts, and the supporting numbers."""

from dataclasses import dataclass, field

import numpy as np

HOLDS, IN_PART, REFUTED, MISPRINT = "holds", "holds in part", "refuted", "misprint"
OPEN = "cannot be decided from the text"
VERDICTS = (HOLDS, IN_PART, REFUTED, OPEN, MISPRINT)
"""In the order in which they are presented."""


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    parts: what the claim asserts, piece by piece: true, false, or None where the text leaves open what it asserts.
    numbers: what was measured, by name.
    corrected: True if the statement holds with its misprint corrected; None where no correction is at hand.
    """

    parts: dict[str, bool | None]
    numbers: dict = field(default_factory=dict)
    corrected: bool | None = None

    def __post_init__(self):
        if not self.parts:
            raise ValueError("parts: a finding needs at least one part")
        # Convert NumPy numbers to plain numbers, so that a finding can be written to a file.
        object.__setattr__(self, "parts", {name: _plain(value) for name, value in self.parts.items()})
        object.__setattr__(self, "numbers", {name: _plain(value) for name, value in self.numbers.items()})

    @property
    def verdict(self) -> str:
        """One of VERDICTS: holds if all parts do, refuted if none does, in part between; open if some part is.

        A misprint is a statement that does not hold as printed, and holds corrected.
        """
        found = list(self.parts.values())
        if None in found:
            return OPEN
        if all(found):
            return HOLDS
        if self.corrected:
            return MISPRINT
        return IN_PART if any(found) else REFUTED


def _plain(value):
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value


def as_printed(holds: bool, corrected: bool, **numbers) -> Finding:
    """Return the finding on a statement as printed, with the verdict on the corrected statement."""
    numbers["as corrected"] = HOLDS if corrected else REFUTED
    return Finding({"as printed": holds}, numbers, corrected=bool(corrected))
