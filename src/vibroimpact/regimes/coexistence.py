"""Tables of where chaos and periodic motions coexist: mean lives of the chaos, and tori where periodic motion ends."""

import numpy as np

from vibroimpact.regimes.branches import Path
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.regimes.lifetimes import lifetime
from vibroimpact.regimes.settling import Observation
from vibroimpact.regimes.torus import onset, sweep
from vibroimpact.system.extras import need

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the word on what is missing)

QUIET = 1e-4
"""A motion that varies less than this on the section is the periodic one."""


def compute_lifetimes(system, along, values, starts: int, seed: int, observation: dict, **watch):
    """Mean lifetime of the chaotic transient at each value of the parameters `along`.

    Args:
        starts, seed: of `regimes.classification.starts`. observation: arguments of `regimes.settling.Observation`.
        watch: discarded, step and longest, see `regimes.lifetimes.lifetime`.

    Returns columns path, p, starts, escapes, cycles (watched), life, uncertainty, least (the bound where none escaped).
    """
    path, observed, rows = Path(system, tuple(along)), Observation(**observation), []
    for p in sorted(values):
        found = lifetime(
            path(p), spread_starts(starts, seed), **watch, window=observed.window, nearness=observed.nearness
        )
        life = found.mean if found.escapes else np.nan
        rows.append((" ".join(along), p, starts, found.escapes, found.total, life, found.error, found.least))
    return pd.DataFrame(rows, columns=["path", "p", "starts", "escapes", "cycles", "life", "uncertainty", "least"])


def compute_tori(system, paths: list[dict], cycles: int, discarded: int):
    """Tori next to Neimark-Sacker points, and where their size says that they begin.

    Args:
        paths: each with `along` and `values`, on both sides of the point. cycles, discarded: of `regimes.torus.size`.

    Returns "tori": columns path, sweep, p, size; and "onsets": columns path, onset, error (standard error of the fit),
    hysteresis (largest difference in size between both sweeps).
    """
    tori, onsets = [], []
    for settings in paths:
        name = " ".join(settings["along"])
        rows = sweep(Path(system, tuple(settings["along"])), settings["values"], cycles, discarded)
        table = pd.DataFrame(rows, columns=["sweep", "p", "size"])
        both = table.pivot(index="p", columns="sweep", values="size")
        grown = table[table["size"] > QUIET]
        fit = onset(grown["p"], grown["size"]) if grown["p"].nunique() > 2 else (np.nan, np.nan)
        onsets.append((name, *fit, (both["down"] - both["up"]).abs().max()))
        tori.append(table.assign(path=name))
    return {
        "tori": pd.concat(tori, ignore_index=True)[["path", "sweep", "p", "size"]],
        "onsets": pd.DataFrame(onsets, columns=["path", "onset", "error", "hysteresis"]),
    }
