"""Tables of figures at the chapter's parameters, in the format of the pipeline, and lightness of colours."""

import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.system.state import NAMES
from vibroimpact.theory.fixed_points.symmetric_points import labels


def system_of(case):
    f10_hat, f20_hat = FORCES[case]
    return vi.System(**PARAMETERS, f10_hat=f10_hat, f20_hat=f20_hat)


def table_of_points(system):
    """Return the fixed points of a system in the format of the pipeline's table."""
    points = vi.fixed_points(system)
    table = pd.DataFrame(
        {
            "label": label,
            **{f"{name}{i}": getattr(point, name)[i - 1] for name in ("C", "B", "psi") for i in (1, 2)},
        }
        for label, point in zip(labels(system, points), points, strict=True)
    )
    return table.sort_values("label", ignore_index=True)


def tables_of_run(system, start, transient, window, per_cycle):
    """Return samples and events of a simulation in the format of the pipeline's tables."""
    times = (transient + np.arange(window * per_cycle + 1) / per_cycle) * system.period
    run = vi.simulate(system, start, transient + window, sample_times=times)
    samples = pd.DataFrame({"tau": times, **dict(zip(NAMES, run.samples.T, strict=True))})
    events = pd.DataFrame({name: run.events[name] for name in ("tau", "module", "wall")})
    events[list(NAMES)] = run.events["state"]
    events["kind"] = np.array(["impact", "stick", "release"])[run.events["kind"]]
    return samples, events


def lightness(colour):
    """Return the lightness CIE L* of a colour, 0 to 100, which is all that grey print shows."""
    channels = np.array(to_rgb(colour))
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
