"""Tabulate Lyapunov spectra and measures of the modulation, with uncertainties, for the motions in each regime."""

import numpy as np
import pandas as pd

from vibroimpact.exact.measures.modulation import (
    PER_CYCLE,
    cycle_amplitudes,
    extreme_depth,
    mean_and_error,
    measures,
    sampled,
    variation,
)
from vibroimpact.studies.regimes import spectra
from vibroimpact.studies.regimes.classification import CHAOS, REGIMES, STRONGLY_MODULATED
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.studies.regimes.settling import Observation, settle

EXPONENT, SHARE = "largest Lyapunov exponent", "share of starts"
WINDOW_MOTIONS = 4
"""Largest number of strongly modulated motions per case that are observed over windows of several lengths."""


def modulation_tables(
    systems: dict, starts: int, seed: int, cycles: int, blocks: int, block: int, windows: list[int], observation: dict
) -> dict:
    """Return measures of the modulation and Lyapunov exponents for each case and regime.

    The runs of each case start from evenly spread initial states and from rest. The runs from spread initial states
    that end in the same regime are evaluated together. The run from rest is evaluated separately. All lengths are in
    forcing periods.

    starts: number of evenly spread initial states of each case.
    cycles: length of the runs from which the measures are computed.
    windows: lengths of the observation windows for which measures of the envelope are compared.
    blocks, block: number and length of the blocks of the runs from which Lyapunov exponents are computed. A run from a
        spread initial state has `blocks` blocks if it ends in a regime of CHAOS. All other runs have the length
        `cycles`.

    The tables are "measures", "windows" and "spectra". The table "windows" describes strongly modulated motions from
    spread initial states. In the column "module", the number 0 stands for both modules.

    The uncertainty of a share of initial states is its binomial standard error. All other uncertainties are standard
    errors of the mean over the runs. For a single run, only the Lyapunov exponent has an uncertainty. This uncertainty
    comes from the blocks of the run.
    """
    tables = [
        _case(case, system, starts, seed, cycles, blocks, block, windows, observation)
        for case, system in systems.items()
    ]
    rows, compared, exponents = zip(*tables, strict=True)
    return {
        "measures": pd.concat(rows, ignore_index=True),
        "spectra": pd.DataFrame([row for part in exponents for row in part]),
        "windows": pd.DataFrame(
            [row for part in compared for row in part],
            columns=["case", "module", "cycles", "quantity", "mean", "uncertainty"],
        ),
    }


def _case(case, system, starts, seed, cycles, blocks, block, windows, observation):
    regimes = settle(system, spread_starts(starts + 1, seed), Observation(**observation))
    groups = {("rest", regimes[0].name): regimes[:1]}
    for name in REGIMES:
        if members := [regime for regime in regimes[1:] if regime.name == name]:
            groups["spread", name] = members
    rows, compared, exponents = [], [], []
    for (start, name), members in groups.items():
        states = [regime.run.final for regime in members]
        lasts = start == "spread" and name in CHAOS
        watched = spectra.spectra_of(system, states, blocks * block if lasts else cycles, block)
        found = [
            measures(system, state, cycles) | {(EXPONENT, 0): one.spectrum.exponents[0]}
            for state, one in zip(states, watched, strict=True)
        ]
        key = {"case": case, "start": start, "regime": name}
        if start == "spread":
            share = len(members) / starts
            error = np.sqrt(share * (1 - share) / starts)
            rows.append({**key, "starts": starts, "quantity": SHARE, "module": 0, "mean": share, "uncertainty": error})
        for quantity, module in found[0]:
            mean, error, count = mean_and_error([values[quantity, module] for values in found])
            if quantity == EXPONENT and count == 1:
                error = watched[0].errors[0]
            named = {"quantity": quantity, "module": module, "mean": mean, "uncertainty": error}
            rows.append({**key, "starts": count, **named})
        exponents += spectra.rows(key, watched)
        if (start, name) == ("spread", STRONGLY_MODULATED):
            compared = _windows(case, system, states[:WINDOW_MOTIONS], windows)
    return pd.DataFrame(rows), compared, exponents


def _windows(case, system, states, windows):
    """Return measures of the envelope for windows of several lengths; all windows start at the same instant."""
    runs = [sampled(system, state, max(windows)) for state in states]
    rows = []
    for module in (1, 2):
        envelopes = [cycle_amplitudes(run.samples[:, 2 * module - 2], PER_CYCLE) for run in runs]
        for cycles in windows:
            for name, measure in (("amplitude variation", variation), ("depth from extremes", extreme_depth)):
                mean, error, _ = mean_and_error([measure(envelope[:cycles]) for envelope in envelopes])
                rows.append((case, module, cycles, name, mean, error))
    return rows
