"""Data for the checks of claims: the systems of the cases, and results of a build."""

from dataclasses import dataclass, field

import pandas as pd

from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS


@dataclass(frozen=True, eq=False)
class Simulation:
    """Simulation of a case after the transient.

    samples: table with one row per sample time.
    events: table with one row per event.
    summary: settings and results of the simulation, by name.
    """

    samples: pd.DataFrame
    events: pd.DataFrame
    summary: dict

    @property
    def impacts(self) -> pd.DataFrame:
        """Rows of `events` that describe impacts."""
        return self.events[self.events["kind"] == "impact"]


@dataclass(frozen=True, eq=False)
class Evidence:
    """Results of a build with the parameters of the chapter.

    Each data frame contains the result table that has the same name as the field. The keys of each dictionary are the
    names of the cases.
    """

    fixed_points: pd.DataFrame
    orbits: pd.DataFrame
    proofs: dict
    verdict_grid: pd.DataFrame
    modulation: pd.DataFrame
    special_points: pd.DataFrame
    epsilon_orders: pd.DataFrame
    simulations: dict[str, Simulation]
    systems: dict[str, System] = field(
        default_factory=lambda: {case: System(**PARAMETERS, **forces) for case, forces in CASES.items()}
    )

    @property
    def system(self) -> System:
        """System of the case "equal"; its parameters except the forces are the same in all cases of the chapter."""
        return self.systems["equal"]

    def points(self, case: str) -> pd.DataFrame:
        """Return the fixed points of a case, one row each, indexed by label."""
        return self.fixed_points.query("case == @case").set_index("label")

    def motions(self, case: str) -> pd.DataFrame:
        """Return the admissible exact orbits of a case, on which the balls stay between the walls."""
        orbits = self.orbits.query("case == @case")
        return orbits[orbits["admissible"].astype(bool)]

    def measured(self, case: str, start: str, quantity: str) -> pd.DataFrame:
        """Return the rows of the table `modulation` for a case, a kind of initial state and a quantity.

        start: kind of initial state, "spread" or "rest".
        """
        return self.modulation.query("case == @case and start == @start and quantity == @quantity")

    def shares(self, case: str) -> pd.Series:
        """Return a series with the share of the initial states that lead to each regime, indexed by regime.

        Only the evenly spread initial states of the case are counted.
        """
        return self.measured(case, "spread", "share of starts").set_index("regime")["mean"]
