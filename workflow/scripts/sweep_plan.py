"""What was measured of a sweep -> JSON: into how many tiles it is cut; no plan for one that would take too long."""

import json
import sys
from pathlib import Path

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact.sweeps.cost import Cost, tiles
from vibroimpact.sweeps.request import fingerprint
from vibroimpact_pipeline.sweeps.tiles import is_of, tile_path


def main(name: str, request: dict, probe, target: float, limit_hours: float, output) -> None:
    """Write the plan of the sweep of this name.

    Args:
        probe: path of what was measured. target: core seconds of a tile, 0 for a point each.
        limit_hours: core hours that what is left of the sweep may take; tiles that are there already cost nothing.

    Raises:
        SystemExit: it would take more, or the target is below 0.
    """
    cost = Cost(**json.loads(Path(probe).read_text(encoding="utf-8")))
    try:
        number = tiles(cost, target)
    except ValueError as error:
        sys.exit(str(error))
    mine = fingerprint(request)
    left = sum(not is_of(tile_path(name, k, number), mine) for k in range(1, number + 1)) / number
    hours = cost.core_seconds / 3600
    if hours * left > limit_hours:
        enough = f"sweeps={{{name}: {{limit_hours: {1.5 * hours * left:.2g}}}}}"
        sys.exit(
            f"sweeps.{name}: {cost.points} points with {cost.runs} simulated starts would take about "
            f"{hours * left:.3g} core hours, above limit_hours {limit_hours:g}. "
            f"To run it all the same: snakemake --cores 2 --config '{enough}' -- sweep_{name}"
        )
    plan = {"tiles": number, "points": cost.points, "runs": cost.runs, "core_hours": hours, "tile_seconds": target}
    with replacing(output) as partial:
        partial.write_text(json.dumps(plan) + "\n", encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        job = snakemake
        target, limit = float(job.resources.tile_seconds), job.params.limit_hours
        main(job.wildcards.sweep, job.params.request, job.input[0], target, limit, job.output[0])
