"""Integrate one case; write samples, events and a summary of the window after the transient.

strobe.csv contains the state at the start of every forcing cycle, including the transient.
"""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.accuracy.window import Window, window
from vibroimpact.system import System
from vibroimpact.system.state import KINDS, NAMES


def summarise(simulated: Window, settings: dict) -> dict:
    """Return a summary of the window after the transient.

    The summary contains the time span of the window, the numbers of events and the final state. It also contains the
    largest change of a coordinate over 1, 2, 3 and 4 cycles. Numbers of cycles that exceed the window are left out.
    """
    events, states = simulated.events, simulated.samples[list(NAMES)].to_numpy()
    counts = {
        kind: {str(module): int(((events["kind"] == kind) & (events["module"] == module)).sum()) for module in (1, 2)}
        for kind in KINDS.values()
    }
    per_cycle = settings["samples_per_cycle"]
    returns = {
        str(cycles): float(abs(states[cycles * per_cycle :] - states[: -cycles * per_cycle]).max())
        for cycles in range(1, min(4, settings["window_cycles"]) + 1)
    }
    return {
        "window": simulated.samples["tau"].iloc[[0, -1]].tolist(),
        "events": counts,
        "largest_change_after_cycles": returns,
        "final": states[-1].tolist(),
    }


with running(snakemake) as out:
    case, parameters, settings = snakemake.wildcards.case, snakemake.params.system, snakemake.params.settings
    simulated = window(System(**parameters), settings)
    for name in ("samples", "events", "strobe"):
        tables.write(getattr(simulated, name), getattr(out, name))
    summary = {"case": case, "system": parameters, "settings": settings}
    summary |= summarise(simulated, settings) | {"trust": simulated.trust}
    Path(out.summary).write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
