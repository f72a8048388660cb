"""Tables of simulations, and lightness of colours."""

import numpy as np
from matplotlib.colors import to_rgb

from vibroimpact.accuracy.window import window


def tables_of_run(system, start, transient, window_cycles, per_cycle):
    """Return samples and events of a simulation in the format of the pipeline's tables."""
    settings = {"initial_state": start, "transient_cycles": transient, "window_cycles": window_cycles}
    made = window(system, settings | {"samples_per_cycle": per_cycle, "model": "float64"})
    return made.samples, made.events


def lightness(colour):
    """Return the lightness CIE L* of a colour, 0 to 100, which is all that grey print shows."""
    channels = np.array(to_rgb(colour))
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
