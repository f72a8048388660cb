# A sweep is split into parts (tiles). Each tile is computed by one job. The table of the sweep does not depend on the
# number of tiles.

from vibroimpact.studies.sweeps.cost import points, tiles

SWEEPS = config.get("sweeps", {})


# The number of tiles follows from the predicted cost. The option `--set-scatter NAME=8` overrides this number.
scattergather:
    **{name: tiles(sweep_request(sweep), config["tile_seconds"]) for name, sweep in SWEEPS.items()},


for name, sweep in SWEEPS.items():

    rule:
        name:
            f"tile_{name}"
        output:
            csv=f"results/sweeps/{name}/tiles/{{scatteritem}}.csv",
        params:
            request=sweep_request(sweep),
            code=code("studies/sweep_tile"),
        script:
            "../../scripts/studies/sweep_tile.py"

    rule:
        name:
            f"table_{name}"
        input:
            getattr(gather, name)(f"results/sweeps/{name}/tiles/{{scatteritem}}.csv"),
        output:
            **in_report({"csv": f"results/sweeps/{name}.csv"}, "Tables"),
            netcdf=f"results/sweeps/{name}.nc",
        params:
            points=points(sweep["axes"]),
            along=[axis["along"] for axis in sweep["axes"]],
            code=code("studies/sweep_table"),
        script:
            "../../scripts/studies/sweep_table.py"

    rule:
        name:
            f"sweep_{name}"
        input:
            table=f"results/sweeps/{name}.csv",
        output:
            **figure_files(f"results/sweeps/{name}/figure", {"csv": {"file": f"results/sweeps/{name}/figure.csv"}}),
        params:
            figure="sweep",
            module=module_of("sweep"),
            settings={"axes": sweep["axes"]},
            config={f"sweeps.{name}": sweep, f"cases.{sweep['case']}": system_of(sweep["case"])},
            code=code("figure", module_of("sweep")),
        script:
            "../../scripts/figure.py"


# Draw a figure for each sweep that no companion figure draws.
rule sweeps:
    input:
        [
            f"results/sweeps/{name}/figure.{kind}"
            for name in SWEEPS
            if not any(name in drawn.get("sweeps", {}) for drawn in SPECS.values())
            for kind in ("png", "csv")
        ],
