"""Bad arguments are refused before anything is computed, in one short line that begins with the argument's name."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.absorbers.decay import decay_time
from vibroimpact.studies.regimes.lyapunov import largest_exponent

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
DECAY, EXPONENT = dict(system=SYSTEM, impulse=1.0), dict(system=SYSTEM, state=[0.0] * 8, blocks=2, cycles=10)


@pytest.mark.parametrize(
    ("function", "good", "name", "value"),
    [
        (decay_time, DECAY, "impulse", 0.0),
        (decay_time, DECAY, "impulse", np.nan),
        (decay_time, DECAY, "module", 0),
        (decay_time, DECAY, "fraction", 0.0),
        (decay_time, DECAY, "cycles", 0),
        (largest_exponent, EXPONENT, "blocks", 1),
    ],
)
def test_arguments_of_functions(function, good, name, value):
    with pytest.raises(ValueError, match=rf"\A{name}[:\[]") as refusal:
        function(**{**good, name: value})
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 240
