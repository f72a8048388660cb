"""Tune linear absorbers in place of the balls."""

from vibroimpact.studies.absorbers.references import Tuning
from vibroimpact.studies.absorbers.tuning import best, den_hartog
from vibroimpact.system import System
from vibroimpact.system.arguments import instance


def best_tuning(system: System, band) -> Tuning:
    """Return the linear absorbers with the lowest peak over a band of frequencies.

    Each absorber has the mass of a ball.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    band : tuple of float
        First and last forcing frequency Omega, dimensionless.

    Returns
    -------
    Tuning
        Frequencies and damping ratios of both absorbers.

    Raises
    ------
    ValueError
        If an argument is malformed, or if no force acts.
    ArithmeticError
        If the optimisation fails.

    Examples
    --------
    >>> tuning = vi.best_tuning(system, (0.9, 1.1))  # doctest: +SKIP
    >>> vi.tuned(system, tuning).peak((0.9, 1.1))  # doctest: +SKIP
    """
    return best(instance("system", system, System), band)


def textbook_tuning(system: System) -> Tuning:
    """Return the linear absorbers tuned by Den Hartog's rule.

    Each absorber has the mass of a ball. The rule treats each box as uncoupled and undamped.

    Parameters
    ----------
    system : System
        Dimensionless parameters.

    Returns
    -------
    Tuning
        Frequencies and damping ratios of both absorbers.

    Raises
    ------
    ValueError
        If system is not a System.

    References
    ----------
    Den Hartog, Mechanical Vibrations, 4th edition 1956, chapter 3; Brock 1946 (damping).

    Examples
    --------
    >>> vi.textbook_tuning(system).frequency  # doctest: +SKIP
    """
    return den_hartog(instance("system", system, System))
