"""The scenes in which many runs are timed, and what is said of all of them."""

import numpy as np

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.accuracy.throughput import scenes


def test_scenes_are_as_they_are_called():
    equal, weak = (vi.System(**PARAMETERS, f10_hat=f1, f20_hat=f2) for f1, f2 in (FORCES["equal"], FORCES["weak"]))
    found = scenes(equal, weak, np.zeros(8))
    for name, scene in found.items():
        systems, states = scene.runs(10**6)
        counts = [int(word) for word in name.replace(",", "").split() if word.isdigit()]
        assert np.prod(counts[:2] if "systems" in name else counts[:1]) == len(systems) == len(states), name
        assert scene.cycles == (counts[-1] if "cycles" in name else 100), name
