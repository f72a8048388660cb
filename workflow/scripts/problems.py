"""Test problems of the config's accuracy section as the library takes them."""

from vibroimpact.accuracy.work_precision import Problem
from vibroimpact.system import System


def problem_of(name: str, parameters: dict, settings: dict) -> Problem:
    return Problem(name, System(**parameters), tuple(settings["initial_state"]), settings["cycles"])
