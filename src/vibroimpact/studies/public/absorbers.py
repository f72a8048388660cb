"""Linear absorbers in place of the balls, tuned in one call."""

from vibroimpact.studies.absorbers.references import Tuning
from vibroimpact.studies.absorbers.tuning import best, den_hartog
from vibroimpact.system import System
from vibroimpact.system.arguments import instance


def best_tuning(system: System, band) -> Tuning:
    """Return the linear absorbers of the masses of the balls with the lowest peak over a band of frequencies Omega.

    Raises
    ------
    ValueError
        If an argument is malformed, or no force acts.
    ArithmeticError
        If no best tuning was found.
    """
    return best(instance("system", system, System), band)


def textbook_tuning(system: System) -> Tuning:
    """Return the linear absorbers of the masses of the balls as Den Hartog's rule tunes them.

    Raises
    ------
    ValueError
        If system is not a System.
    """
    return den_hartog(instance("system", system, System))
