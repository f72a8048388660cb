"""Measure the speed of every method on one motion, and of many runs; print the results and write CSV with versions."""

import argparse
from pathlib import Path
from string import ascii_lowercase

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.config import ConfigError, checked, merged, read
from vibroimpact_pipeline.result_records import replacing
from vibroimpact_pipeline.specs import case_parameters

import pandas as pd

from vibroimpact.system import System

SECONDS = 0.5


HANDICAPS = """\
Each time is the shortest of many calls in one process. Only this engine proves that it misses no impact.
SciPy's methods (RK45, DOP853, Radau, LSODA) execute steps in Python and locate events to 4 units of rounding.
heyoka calls the impact law in Python, which takes a sixth to a third of its time. Its batches use starts without
sticking."""


def main(config: dict, output) -> None:
    """Run the benchmark of a config, print its tables and write them to the file `output`."""
    from vibroimpact.accuracy.benchmark import measure, unavoidable_error
    from vibroimpact.accuracy.throughput import ranges, throughput
    from vibroimpact.accuracy.timing import versions
    from vibroimpact.accuracy.work_precision import Problem
    from vibroimpact.integrators import TIMED

    settings = config["accuracy"]["benchmark"]
    system = System(**case_parameters(config, settings["case"]))
    problem = Problem("benchmark", system, tuple(settings["initial_state"]), settings["cycles"])
    table = pd.DataFrame(measure(problem, TIMED, SECONDS))
    scenes = throughput(system, System(**case_parameters(config, "weak")), problem.state, SECONDS)
    many = pd.DataFrame(scenes).set_index("scene")
    notes = [f"unavoidable error: {unavoidable_error(problem):.3g}", "many runs, ns per impact on one core:"]
    notes += [f"{letter}: {column}" for letter, column in zip(ascii_lowercase, many.columns, strict=False)]
    many.columns = list(ascii_lowercase[: len(many.columns)])
    notes += many.to_string(float_format="{:.3g}".format, na_rep="", index_names=False).splitlines()
    notes += [*ranges(scenes), *HANDICAPS.splitlines()]
    notes += ["  ".join(f"{name} {version}" for name, version in versions().items())]
    print(table.to_string(index=False, float_format="{:.3g}".format), *notes, sep="\n")
    with replacing(output) as partial:
        text = table.to_csv(index=False, lineterminator="\n") + "".join(f"# {line}\n" for line in notes)
        partial.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--config", type=Path, default=ROOT / "config/config.yaml")
    parser.add_argument("--output", type=Path, default=ROOT / "results/accuracy/benchmark.csv")
    arguments = parser.parse_args()
    try:
        files = *sorted((ROOT / "config").glob("*.yaml")), arguments.config
        sources = [(path, read(path)) for path in files]
        config = checked(merged(sources), sources)
    except ConfigError as error:
        parser.exit(1, f"{error}\n")
    main(config, arguments.output)
