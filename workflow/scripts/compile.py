"""Compile the engine and its rivals into the cache of the checkout, so that the first build does not have to."""

from pathlib import Path

from vibroimpact_pipeline.config import case_parameters, read
from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.sources import Sources

prepare(Path.cwd(), Sources())

from vibroimpact import compile  # noqa: E402  (Numba reads the environment when it is imported)
from vibroimpact.rivals import METHODS  # noqa: E402
from vibroimpact.system import System  # noqa: E402

compile.main()
config = read("config/config.yaml")
case = next(iter(config["cases"]))
system, start = System(**case_parameters(config, case)), config["cases"][case]["simulation"]["initial_state"]
for method in METHODS:
    if not method.available():
        method.run(system, start, 1, 0.0, method.ladder[0])
