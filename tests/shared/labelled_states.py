"""One state with its components labelled in different ways, and labels that are not valid for a state."""

from collections import namedtuple

import numpy as np
import pandas as pd

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.system.state import NAMES

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
START = [0.1, -0.2, 0.3, 0.05, 0.4, -0.6, 0.7, 0.8]
STATE = dict(zip(NAMES, START, strict=True))
SHUFFLED = ["X1", "X2", "Y1", "Y2", "dX1", "dX2", "dY1", "dY2"]
"""Order of components in which a state that is read by position would be another admissible state."""
PRIMED = [name if len(name) == 2 else f"{name[1:]}'" for name in SHUFFLED]
VALUES = [STATE[name] for name in SHUFFLED]
ROW = pd.Series(VALUES, SHUFFLED)
LABELLED = {
    "a row": ROW,
    "a row with primes": pd.Series(VALUES, PRIMED),
    "a row of mixed columns": pd.Series([*VALUES, "impact"], [*SHUFFLED, "kind"], dtype=object),
    "a mapping": dict(zip(SHUFFLED, VALUES, strict=True)),
    "a named tuple": namedtuple("State", SHUFFLED)(*VALUES),
    "a row of a structured array": np.array([tuple(VALUES)], [(name, float) for name in SHUFFLED])[0],
}
UNKNOWN = {
    "other names": (pd.Series(START, [*"abcdefgh"]), "a, b, c"),
    "a name missing": (ROW.drop("dX1"), "dY1, dY2"),
    "a name twice": (pd.Series([*VALUES, 0.0], [*SHUFFLED, "X1"]), "dY2, X1"),
    "a name in both spellings": (pd.Series([*VALUES, 0.0], [*SHUFFLED, "X1'"]), "dY2, X1'"),
    "a misspelt name": ({"x1": 0.0, **dict.fromkeys(NAMES[1:], 0.0)}, "x1, Y1"),
    "numbers in another order": (pd.Series(START, [1, 0, *range(2, 8)]), "1, 0, 2"),
    "an event": (vi.simulate(SYSTEM, START, 3).events[0], "tau, module, wall, kind, state"),
    "states in columns": (pd.DataFrame([START] * 8, columns=NAMES).T, "0, 1, 2"),
}
