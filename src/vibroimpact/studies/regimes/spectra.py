"""Compute Lyapunov spectra of motions, and the rows of a table with these spectra."""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.measures.modulation import mean_and_error
from vibroimpact.studies.regimes.lyapunov import Spectrum, lyapunov_spectrum

DIMENSION, SUM, CONTRACTION = "Kaplan-Yorke dimension", "sum of exponents", "contraction"
DOUBLE, OF_CYCLES = "double sticks per million cycles", 1e6


class MotionSpectrum(NamedTuple):
    """Spectrum of a motion, from all cycles except those in which both balls stick at the same time.

    errors: standard errors of the exponents, from the bootstrap.
    dimension_error: standard error of the dimension, from the bootstrap.
    double_sticks: number of excluded cycles.
    """

    spectrum: Spectrum
    errors: np.ndarray
    dimension_error: float
    double_sticks: int


def spectra_of(system, states, cycles: int, block: int) -> list[MotionSpectrum]:
    """Return the spectrum of the motion from each initial state, over `cycles` cycles after a transient.

    block: number of cycles per block of the bootstrap. A number above half of `cycles` is reduced to half of `cycles`.
    The transient is as long as ten blocks.
    """
    found, block = [], max(1, min(block, cycles // 2))
    for state in states:
        one = lyapunov_spectrum(system, state, cycles, 0, 10 * block)
        single = one.without_double_sticks()
        errors = single.errors(min(block, len(single.growth) // 2))
        found.append(MotionSpectrum(single, *errors, one.double_sticks))
    return found


def rows(key: dict, found) -> list[dict]:
    """Return the rows of the table for the motions of one regime, with one row per quantity.

    key: columns that all rows share. found: MotionSpectrum of each motion.
    """
    size = found[0].spectrum.growth.shape[1]
    columns = {f"exponent {k + 1}": [(one.spectrum.exponents[k], one.errors[k]) for one in found] for k in range(size)}
    columns[DIMENSION] = [(one.spectrum.dimension, one.dimension_error) for one in found]
    columns[SUM] = [(_mean_without_sticks(one, one.growth.sum(axis=1)), np.nan) for one, *_ in found]
    columns[CONTRACTION] = [(_mean_without_sticks(one, one.contraction), np.nan) for one, *_ in found]
    values = {name: _summary(*zip(*column, strict=True)) for name, column in columns.items()}
    values[DOUBLE] = _rate(sum(one.double_sticks for one in found), sum(len(one.spectrum.growth) for one in found))
    return [{**key, "starts": len(found), "quantity": name, **summary} for name, summary in values.items()]


def _rate(count, others):
    """Return the number of events per OF_CYCLES cycles, and the Poisson error of this rate.

    If there is no event, the error is that of one event.

    count: number of cycles with an event. others: number of cycles without an event.
    """
    scale = OF_CYCLES / (count + others)
    return {"mean": scale * count, "uncertainty": scale * np.sqrt(max(count, 1)), "bootstrap": np.nan}


def _mean_without_sticks(one, values):
    """Return the mean of `values` over those cycles of the Spectrum `one` in which no ball sticks.

    values: one value per cycle of the Spectrum.
    """
    return values[one.stuck == 0].mean()


def _summary(values, errors):
    if -np.inf in values:
        return {"mean": -np.inf, "uncertainty": np.nan, "bootstrap": np.nan}
    mean, error, _ = mean_and_error(values)
    return {"mean": mean, "uncertainty": error, "bootstrap": float(np.mean(errors))}
