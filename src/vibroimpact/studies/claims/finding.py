"""Finding of a check: parts of a claim, the verdict that follows from them, and supporting numbers."""

from dataclasses import dataclass, field

import numpy as np

HOLDS, IN_PART, REFUTED, MISPRINT = "holds", "holds in part", "refuted", "misprint"
OPEN = "cannot be decided from the text"
VERDICTS = (HOLDS, IN_PART, REFUTED, OPEN, MISPRINT)
"""All verdicts, in the order of presentation."""


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    parts: for each assertion of the claim, True or False; None if the text of the chapter is ambiguous.
    numbers: measured values by name.
    corrected: True if the claim holds once a misprint is corrected, False if not, None if no correction is known.
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
        """Verdict on the claim, one of VERDICTS.

        The first of these conditions that is met decides:

        - OPEN: a part is None.
        - HOLDS: all parts hold.
        - MISPRINT: the corrected claim holds.
        - IN_PART: at least one part holds.
        - REFUTED: no part holds.
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
    """Return the Finding on a printed statement.

    holds: True if the printed statement holds.
    corrected: True if the corrected statement holds. The function adds the verdict on this statement to `numbers`.
    numbers: measured values by name.
    """
    numbers["verdict on the corrected statement"] = HOLDS if corrected else REFUTED
    return Finding({"the statement holds as printed": holds}, numbers, corrected=bool(corrected))
