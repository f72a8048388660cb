"""Results of a build for the checks of claims: the cases and the tables that the pipeline wrote."""

from dataclasses import dataclass, field

import pandas as pd

from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS

OF_CASES = dict.fromkeys(("fixed_points", "orbits", "modulation", "epsilon_orders", "special_points"), tuple(CASES))
OF_CASES |= {"absorber": ("equal",), "clearance": ("equal",), "verdict_grid": ()}
"""Cases that a whole table depends on."""


class NotOfTheChapter(Exception):
    """Evidence of a check made with other parameters or settings than those that the claims are about."""


class ByCase(dict):
    """Evidence by case; reading a case that differs from the chapter's, or all, raises NotOfTheChapter."""

    def __init__(self, entries, unlike: dict[str, str]):
        super().__init__(entries)
        self.unlike = unlike

    def __getitem__(self, case):
        _refuse((case,), self.unlike)
        return super().__getitem__(case)

    def items(self):
        _refuse(self.unlike, self.unlike)
        return super().items()

    def values(self):
        _refuse(self.unlike, self.unlike)
        return super().values()


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
    simulations: case -> Simulation. unlike: why a part of it is not about the chapter, by its name: a case, a table,
    "simulations.<case>", or "system" for all; reading that part raises NotOfTheChapter.
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
    unlike: dict[str, str] = field(default_factory=dict)

    def __post_init__(self):
        for name in ("systems", "proofs"):
            object.__setattr__(self, name, ByCase(getattr(self, name), self.by_case("")))
        object.__setattr__(self, "simulations", ByCase(self.simulations, self.by_case("simulations.")))

    def by_case(self, prefix: str) -> dict[str, str]:
        """Return why cases are not the chapter's, themselves or in a part of the evidence."""
        unlike = self.unlike
        whole = dict.fromkeys(CASES, unlike["system"]) if "system" in unlike else {}
        return whole | {case: unlike[name] for case in CASES for name in (f"{prefix}{case}", case) if name in unlike}

    def __getattribute__(self, name):
        if name in OF_CASES:
            _refuse(("system", name, *OF_CASES[name]), self.unlike)
        return super().__getattribute__(name)

    def rows(self, name: str, case: str) -> pd.DataFrame:
        """Return the rows of a table for one case."""
        _refuse(("system", name, case), self.unlike)
        table = super().__getattribute__(name)
        return table[table["case"] == case]

    @property
    def system(self) -> System:
        """A system with the parameters that all cases of the chapter share."""
        _refuse(("system",), self.unlike)
        return System(**PARAMETERS, **CASES["equal"]) if "equal" in self.unlike else self.systems["equal"]

    def points(self, case: str) -> pd.DataFrame:
        """Return the fixed points of a case, a row each, by label."""
        return self.rows("fixed_points", case).set_index("label")

    def motions(self, case: str) -> pd.DataFrame:
        """Return the exact orbits of a case that stay between the walls."""
        orbits = self.rows("orbits", case)
        return orbits[orbits["admissible"].astype(bool)]

    def measured(self, case: str, start: str, quantity: str) -> pd.DataFrame:
        """Return the rows of the table of modulation for one quantity, of spread starts or the one from rest."""
        table = self.rows("modulation", case)
        return table[(table["start"] == start) & (table["quantity"] == quantity)]

    def shares(self, case: str) -> pd.Series:
        """Return the share of the spread starts that end in each regime, by its name."""
        return self.measured(case, "spread", "share of starts").set_index("regime")["mean"]


def _refuse(names, unlike):
    """Raise NotOfTheChapter if one of the parts is not the chapter's."""
    for name in names:
        if name in unlike:
            raise NotOfTheChapter(unlike[name])
