# Sweeps: snakemake sweep_NAME; the default build makes the tables that companion figures draw. A few points are measured,
# and by what they took a sweep is cut into tiles, a job each, so that it spreads over the cores of any executor.

import json

from vibroimpact_pipeline.config.sweeps import DRAWN, LIMIT_HOURS
from vibroimpact_pipeline.sweeps.places import table_path, tile_path
from vibroimpact_pipeline.sweeps.words import announced

SWEEPS = config.get("sweeps", {})
OBSERVED_BY = ("observe", "starts", "seed", "cycles", "settle", "band")
ANNOUNCED = set()


def sweep_request(wildcards):
    """What decides on the numbers of a sweep, and nothing else: see vibroimpact.sweeps.request."""
    sweep = SWEEPS[wildcards.sweep]
    asked = {name: sweep[name] for name in OBSERVED_BY if name in sweep}
    if "regimes" in sweep["observe"]:
        asked["observation"] = REGIMES["observation"]
    return {"system": system_of(sweep["case"]), "axes": sweep["axes"], "asked": asked}


def sweep_tiles(wildcards):
    """The tiles that the plan cuts a sweep into; what they cost is said once, before the first of them is begun."""
    sweep = wildcards.sweep
    with open(checkpoints.plan_of_sweep.get(sweep=sweep).output[0], encoding="utf-8") as file:
        plan = json.load(file)
    number = plan["tiles"]
    tiles = [str(tile_path(sweep, tile, number)) for tile in range(1, number + 1)]
    if workflow.is_main_process and sweep not in ANNOUNCED and not all(map(os.path.exists, tiles)):
        ANNOUNCED.add(sweep)
        print(announced(sweep, plan), file=sys.stderr, flush=True)
    return tiles


def table_of(name):
    return table_path(name, SWEEPS[name]["axes"])


def sweep_keys(name):
    """Entries of the config that decide on the numbers of a sweep."""
    keys = [f"sweeps.{name}.{key}" for key in SWEEPS[name] if key != "limit_hours"]
    return keys + ["regimes.observation"] * ("regimes" in SWEEPS[name]["observe"])


def sweep_provenance(wildcards):
    name = wildcards.sweep
    return provenance(f"sweep_{name}", sweep_keys(name), [SWEEPS[name]["case"]], SWEEP_STEPS)


SWEEP_PICTURE = "vibroimpact.figures.sweep"
SWEEP_STEPS = [
    step(*STEPS["tile_of_sweep"]),
    step("as computed", DOUBLE, "workflow/scripts/figure.py", modules=[SWEEP_PICTURE]),
]


wildcard_constraints:
    sweep="[a-z][a-z0-9_]+",
    kind="csv|parquet",
    tile=r"\d+",
    tiles=r"\d+",


rule probe_of_sweep:
    output:
        "results/sweeps/{sweep}/probe.json",
    params:
        request=sweep_request,
        code=code("workflow/scripts/sweep_probe.py"),
    log:
        "results/logs/sweeps/{sweep}/probe.log",
    benchmark:
        "results/benchmarks/sweeps/{sweep}/probe.tsv"
    script:
        "../scripts/sweep_probe.py"


# How long a tile takes is a matter of the executor, not of the question: `set-resources` of a profile, or on the command
# line `--set-resources plan_of_sweep:tile_seconds=600`, in whole seconds, 0 for a tile per point. A plan that is there is
# kept: another target cuts no sweep anew.
checkpoint plan_of_sweep:
    input:
        rules.probe_of_sweep.output,
    output:
        "results/sweeps/{sweep}/plan.json",
    params:
        request=sweep_request,
        limit_hours=lambda wildcards: SWEEPS[wildcards.sweep].get("limit_hours", LIMIT_HOURS),
        code=code("workflow/scripts/sweep_plan.py"),
    resources:
        tile_seconds=20,
    log:
        "results/logs/sweeps/{sweep}/plan.log",
    benchmark:
        "results/benchmarks/sweeps/{sweep}/plan.tsv"
    script:
        "../scripts/sweep_plan.py"


rule tile_of_sweep:
    output:
        "results/sweeps/{sweep}/tiles/{tile}-of-{tiles}.csv",
    params:
        request=sweep_request,
        code=code("workflow/scripts/sweep_tile.py"),
    threads: 1
    log:
        "results/logs/sweeps/{sweep}/{tile}-of-{tiles}.log",
    benchmark:
        "results/benchmarks/sweeps/{sweep}/{tile}-of-{tiles}.tsv"
    script:
        "../scripts/sweep_tile.py"


rule table_of_sweep:
    input:
        sweep_tiles,
    output:
        "results/sweeps/{sweep}.{kind}",
    params:
        request=sweep_request,
        code=code("workflow/scripts/sweep_table.py"),
    log:
        "results/logs/sweeps/{sweep}/table_{kind}.log",
    benchmark:
        "results/benchmarks/sweeps/{sweep}/table_{kind}.tsv"
    script:
        "../scripts/sweep_table.py"


rule picture_of_sweep:
    input:
        table=lambda wildcards: table_of(wildcards.sweep),
    output:
        **figure_files("results/sweeps/{sweep}/figure"),
    params:
        module=SWEEP_PICTURE,
        settings=lambda wildcards: {"axes": SWEEPS[wildcards.sweep]["axes"]},
        provenance=sweep_provenance,
    log:
        "results/logs/sweeps/{sweep}/figure.log",
    script:
        "../scripts/figure.py"


rule page_of_sweep:
    input:
        table=lambda wildcards: table_of(wildcards.sweep),
        plan="results/sweeps/{sweep}/plan.json",
        svg=rules.picture_of_sweep.output.svg,
    output:
        "results/sweeps/{sweep}.html",
    params:
        request=sweep_request,
        code=code("workflow/scripts/sweep_page.py"),
    log:
        "results/logs/sweeps/{sweep}/page.log",
    script:
        "../scripts/sweep_page.py"


for name in SWEEPS:

    rule:
        name:
            f"sweep_{name}"
        input:
            table_of(name),
            f"results/sweeps/{name}.html",
            figure_files(f"results/sweeps/{name}/figure").values(),
