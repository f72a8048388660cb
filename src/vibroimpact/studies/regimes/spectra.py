"""Compute Lyapunov spectra of motions, and the rows of their table."""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.measures.modulation import mean_and_error
from vibroimpact.studies.regimes.lyapunov import Spectrum, lyapunov_spectrum

DIMENSION, SUM, CONTRACTION = "Kaplan-Yorke dimension", "sum of exponents", "contraction"
DOUBLE, OF_CYCLES = "double sticks per million cycles", 1e6


class MotionSpectrum(NamedTuple):
    """Spectrum of a motion without its double sticks (cycles in which both balls stick), with bootstrap errors."""

    spectrum: Spectrum
    errors: np.ndarray
    dimension_error: float
    double_sticks: int


def spectra_of(system, states, cycles: int, block: int) -> list[MotionSpectrum]:
    """Return the spectrum of each motion over `cycles` cycles, after a transient of ten bootstrap blocks."""
    found, block = [], max(1, min(block, cycles // 2))
    for state in states:
        one = lyapunov_spectrum(system, state, cycles, 0, 10 * block)
        single = one.without_double_sticks()
        errors = single.errors(min(block, len(single.growth) // 2))
        found.append(MotionSpectrum(single, *errors, one.double_sticks))
    return found


def rows(key: dict, found) -> list[dict]:
    """Return the rows of the table for motions of one regime, one per quantity; all rows contain `key`."""
    size = found[0].spectrum.growth.shape[1]
    columns = {f"exponent {k + 1}": [(one.spectrum.exponents[k], one.errors[k]) for one in found] for k in range(size)}
    columns[DIMENSION] = [(one.spectrum.dimension, one.dimension_error) for one in found]
    columns[SUM] = [(_mean_without_sticks(one, one.growth.sum(axis=1)), np.nan) for one, *_ in found]
    columns[CONTRACTION] = [(_mean_without_sticks(one, one.contraction), np.nan) for one, *_ in found]
    values = {name: _summary(*zip(*column, strict=True)) for name, column in columns.items()}
    values[DOUBLE] = _rate(sum(one.double_sticks for one in found), sum(len(one.spectrum.growth) for one in found))
    return [{**key, "starts": len(found), "quantity": name, **summary} for name, summary in values.items()]


def _rate(count, others):
    """Return the rate per OF_CYCLES cycles, with Poisson error, of an event in `count` cycles but not in `others`."""
    scale = OF_CYCLES / (count + others)
    return {"mean": scale * count, "uncertainty": scale * np.sqrt(max(count, 1)), "bootstrap": np.nan}


def _mean_without_sticks(one, values):
    """Return the mean of `values`, one per cycle of the Spectrum `one`, over the cycles in which no ball sticks."""
    return values[one.stuck == 0].mean()


def _summary(values, errors):
    if -np.inf in values:
        return {"mean": -np.inf, "uncertainty": np.nan, "bootstrap": np.nan}
    mean, error, _ = mean_and_error(values)
    return {"mean": mean, "uncertainty": error, "bootstrap": float(np.mean(errors))}
