"""The results of a build that the checks of claims read: the cases and the tables that the pipeline has written."""

from dataclasses import dataclass

import pandas as pd

from vibroimpact.system import System


@dataclass(frozen=True, eq=False)
class Simulation:
    """The window of a direct integration: samples and events, a row per instant, and its summary."""

    samples: pd.DataFrame
    events: pd.DataFrame
    summary: dict

    @property
    def impacts(self) -> pd.DataFrame:
        """The events that are impacts."""
        return self.events[self.events["kind"] == "impact"]


@dataclass(frozen=True, eq=False)
class Evidence:
    """Results of a build.

    systems: case -> system. fixed_points, orbits, verdict_grid, modulation, special_points, epsilon_orders, absorber:
    the tables of these names; clearance: that of the sweep. proofs: case -> what is proved of the lists.
    simulations: case -> Simulation.
    """

    systems: dict[str, System]
    fixed_points: pd.DataFrame
    orbits: pd.DataFrame
    proofs: dict
    verdict_grid: pd.DataFrame
    modulation: pd.DataFrame
    special_points: pd.DataFrame
    epsilon_orders: pd.DataFrame
    absorber: pd.DataFrame
    clearance: pd.DataFrame
    simulations: dict[str, Simulation]

    @property
    def system(self) -> System:
        """A system with the parameters that all cases share."""
        return next(iter(self.systems.values()))

    def points(self, case: str) -> pd.DataFrame:
        """Fixed points of a case, a row each, by label."""
        return self.fixed_points[self.fixed_points["case"] == case].set_index("label")

    def motions(self, case: str) -> pd.DataFrame:
        """Exact orbits of a case that stay between the walls."""
        return self.orbits[(self.orbits["case"] == case) & self.orbits["admissible"]]

    def measured(self, case: str, start: str, quantity: str) -> pd.DataFrame:
        """Rows of the table of modulation for one quantity, of spread starts or the one from rest."""
        table = self.modulation
        return table[(table["case"] == case) & (table["start"] == start) & (table["quantity"] == quantity)]

    def shares(self, case: str) -> pd.Series:
        """Share of the spread starts that end in each regime, by its name."""
        return self.measured(case, "spread", "share of starts").set_index("regime")["mean"]
