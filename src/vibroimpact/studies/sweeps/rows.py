"""Table of a sweep: names of its columns, and one row per point."""

from collections.abc import Iterable, Iterator

from vibroimpact.studies.sweeps.grid import Grid
from vibroimpact.studies.sweeps.observations import OBSERVATIONS, observed
from vibroimpact.studies.sweeps.spec import FAILED, POINT, Spec


def columns(grid: Grid, spec: Spec) -> list[str]:
    """Return the names of the columns, in their order."""
    moved = [name for axis in grid.axes for name in axis.along]
    return [POINT, *moved, *(column for name in spec.observe for column in OBSERVATIONS[name][0]), FAILED]


def rows(grid: Grid, spec: Spec, numbers: Iterable[int]) -> Iterator[dict]:
    """Yield one row for each point in `numbers`.

    If an observation fails at a point, the column FAILED of this row contains the error message.

    Raises
    ------
    ValueError
        If a point does not give a valid system.
    """
    for number in numbers:
        row = {POINT: number, **grid.place(number)}
        system = grid.system(number)
        try:
            yield {**row, **observed(system, spec), FAILED: ""}
        except (ArithmeticError, RuntimeError, ValueError) as error:
            yield {**row, FAILED: " ".join(str(error).split())}
