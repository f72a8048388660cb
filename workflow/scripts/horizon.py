"""True states at the start of every cycle -> companion figure: where float64 leaves the true trajectory."""

from adapter import logging_to
from vibroimpact.figures import companion_horizon, style, tables
from vibroimpact.system import System


def main(strobe, parameters: dict, settings: dict, outputs: dict) -> None:
    system, truth = System(**parameters), tables.read(strobe)
    table = companion_horizon.compute(system, settings["initial_state"], truth, settings["transient_cycles"])
    tables.write(table, outputs["csv"])
    style.save(companion_horizon.draw(table), outputs)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.input.strobe, snakemake.params.system, snakemake.params.settings, dict(snakemake.output.items()))
