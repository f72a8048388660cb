"""Pydantic models of config/studies.yaml and of both config files together, with checks that involve both files."""

from collections.abc import Iterator

from pydantic import Field

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.section import Place, Section
from vibroimpact_pipeline.studies.config.machines import Machines
from vibroimpact_pipeline.studies.config.regimes import Regimes
from vibroimpact_pipeline.studies.config.sweeps import Sweep


class VerdictGrid(Section):
    """Grid of `points` x `points` cells in the plane of the two forcing amplitudes.

    Stability is judged at the centre of each cell.
    """

    f10_range: fields.Forces
    f20_range: fields.Forces
    points: fields.Points
    epsilon: fields.items(fields.Epsilon, 1, 20, "Values of epsilon for the exact orbits")


class Stability(Section):
    """The grid on which stability criteria are judged."""

    verdict_grid: VerdictGrid


class Studies(Section):
    """Config of the studies. Except in `machines`, values are dimensionless, and times are in forcing periods."""

    stability: Stability
    regimes: Regimes
    tile_seconds: float = Field(
        20.0, gt=0, le=1e5, description="Approximate run time of each job of a sweep [core seconds]"
    )
    sweeps: fields.named(Sweep, 0, 100) = Field({}, description="Parameter sweeps by name; companion figures draw some")
    machines: fields.named(Machines, 0, 10) = Field(
        {}, description="Machines in SI units by name; each becomes a figure"
    )


class Whole(Config, Studies):
    """Both config files together."""

    def conditions(self):
        yield from super().conditions()
        for name, sweep in self.sweeps.items():
            for place, what in sweep.not_drawn(name):
                yield ("sweeps", name, *place), what
        if "self" in self.sweeps:
            yield ("sweeps", "self"), "this name is reserved by Snakemake; rename the sweep"

    def named_rules(self) -> Iterator[Place]:
        """Yield the key path of each config entry whose name becomes the name of a Snakemake rule."""
        yield from super().named_rules()
        yield from (("machines", name) for name in self.machines)

    def varied_parameters(self) -> Iterator[tuple[Place, str | None, dict[str, float]]]:
        """Yield parameter values that entries of the config use in place of the values of a case.

        Each item contains the key path of the entry, the name of a case, and a mapping from parameters to values. If
        the values apply to all cases, the name is None.
        """
        branches, grid, regimes = self.regimes.branches, self.stability.verdict_grid, self.regimes
        for number, path in enumerate(branches.paths):
            for end in path.range:
                yield ("regimes", "branches", "paths", number), branches.case, dict.fromkeys(path.along, end)
        lists = {("stability", "verdict_grid"): grid.epsilon, ("regimes", "epsilon"): regimes.epsilon.epsilon}
        for place, values in (lists | {("regimes", "asymmetric"): regimes.asymmetric.epsilon}).items():
            for value in values:
                yield place, None, {"epsilon": value}
        for name, sweep in self.sweeps.items():
            for moved in sweep.corners():
                yield ("sweeps", name), sweep.case, moved
