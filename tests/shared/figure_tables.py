"""Tables of simulations."""

from vibroimpact.accuracy.window import window


def tables_of_run(system, start, transient, window_cycles, per_cycle):
    """Return samples and events of a simulation in the format of the pipeline's tables."""
    settings = {"initial_state": start, "transient_cycles": transient, "window_cycles": window_cycles}
    made = window(system, settings | {"samples_per_cycle": per_cycle, "model": "float64"})
    return made.samples, made.events
