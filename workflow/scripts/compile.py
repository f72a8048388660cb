"""Compile the engine and its rivals into the cache of the checkout, so that the first build does not have to."""

from pathlib import Path

from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.sources import Sources

prepare(Path.cwd(), Sources())

from vibroimpact import compile  # noqa: E402  (Numba reads the environment when it is imported)
from vibroimpact.rivals import METHODS  # noqa: E402
from vibroimpact.system import System  # noqa: E402
from vibroimpact.system.chapter import CASES, PARAMETERS  # noqa: E402

compile.main()
system, start = System(**PARAMETERS, **CASES["equal"]), [0.0] * 8
for method in METHODS:
    if not method.available():
        method.run(system, start, 1, 0.0, method.ladder[0])
