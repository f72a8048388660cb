"""Observations of a sweep at every point, and their settings; this module does not load the engine."""

from dataclasses import dataclass

from vibroimpact.studies.sweeps.cost import RUNS
from vibroimpact.studies.sweeps.grid import axis

POINT, FAILED = "point", "failed"
"""Columns of every table: the number of the point, and the reason of a failure, or ""."""


@dataclass(frozen=True)
class Spec:
    """Observations at every point.

    observe: names of observations. starts, seed: see `regimes.classification.starts`. cycles, settle: of the runs whose
    amplitudes are observed, forcing periods; those before `settle` are left out. band: arguments of `grid.axis`, of the
    parameters that peaks are sought along. observation: those of `regimes.settling.Observation`.
    """

    observe: tuple[str, ...]
    starts: int = 1
    seed: int = 0
    cycles: int = 0
    settle: int = 0
    band: dict | None = None
    observation: dict | None = None

    @property
    def runs(self) -> int:
        """Number of runs at a point, over all observations."""
        along_band = len(axis(**self.band).values) if "peaks" in self.observe else 0
        return self.starts * (along_band + sum(name in ("regimes", *RUNS) for name in self.observe))
