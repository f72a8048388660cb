"""Scenes of the config's accuracy section as the library takes them."""

from vibroimpact.accuracy.work_precision import Scene
from vibroimpact.system import System


def scene_of(name: str, parameters: dict, settings: dict) -> Scene:
    return Scene(name, System(**parameters), tuple(settings["initial_state"]), settings["cycles"])
