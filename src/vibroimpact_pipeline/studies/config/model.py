"""The config of the studies, config/studies.yaml: its smaller sections, and the conditions across both files."""

from collections.abc import Iterator

from pydantic import Field

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.section import Place, Section
from vibroimpact_pipeline.studies.config.machines import Machines
from vibroimpact_pipeline.studies.config.regimes import Regimes
from vibroimpact_pipeline.studies.config.sweeps import Sweep


class Companion1005(Section):
    """Companion of figure 10.5."""

    C_range: fields.around(0.6, fields.HIGHEST) = Field(description="Ends of the axis, which holds the derived limits")


class VerdictGrid(Section):
    """The theory's verdicts against exact orbits, at the centres of points x points cells of forces."""

    f10_range: fields.Forces
    f20_range: fields.Forces
    points: fields.Points
    epsilon: fields.items(fields.Epsilon, 1, 20, "Values at which the exact orbits are looked for")


class Stability(Section):
    """The axis of the companion of figure 10.5, and the grid for judging the criteria."""

    companion_10_05: Companion1005
    verdict_grid: VerdictGrid


class Animation(Section):
    """The first cycles of a case's simulated window."""

    case: fields.CaseName
    cycles: fields.count("Cycles shown, no more than the window has [forcing periods]", 1, 1000)


class ForceSweep(Section):
    """The slider on the page of fixed points: f20_hat varies, all else is as in the case."""

    case: fields.CaseName
    range: fields.Forces
    values: fields.count("Values of f20_hat", 2, fields.MOST)
    C_max: fields.Amplitude = Field(description="Right end of the planes")

    def conditions(self):
        if self.range[1] - self.range[0] < 1e-6 * (self.values - 1):
            yield ("values",), f"{self.values} in {self.range} are not all different in six decimals"


class Report(Section):
    """The live parts of the report: animations, and the slider of the fixed points."""

    animations: fields.named(Animation, 0, 10) = Field(description="Animations by free names")
    force_sweep: ForceSweep


class Studies(Section):
    """All beyond the chapter: dimensionless except machines, times in forcing periods."""

    stability: Stability
    regimes: Regimes
    tile_seconds: float = Field(20.0, gt=0, le=1e5, description="Cut sweeps into jobs of about so long [core seconds]")
    report: Report
    sweeps: fields.named(Sweep, 0, 100) = Field({}, description="Questions of one's own, by name; companions draw some")
    machines: fields.named(Machines, 0, 10) = Field({}, description="Machines in SI units, a figure each, by name")


class Whole(Config, Studies):
    """Both files together."""

    def conditions(self):
        yield from super().conditions()
        for name, sweep in self.sweeps.items():
            for place, what in sweep.not_drawn(name):
                yield ("sweeps", name, *place), what
        if "self" in self.sweeps:
            yield ("sweeps", "self"), "a sweep cannot have this name, which Snakemake gives to an argument"
        for name, shown in self.report.animations.items():
            if shown.cycles > (kept := self.cases[shown.case].simulation.window_cycles):
                what = f"{shown.cycles} is above {kept}, window_cycles of the case {shown.case}"
                yield ("report", "animations", name, "cycles"), what

    def named_rules(self) -> Iterator[Place]:
        """Yield the places of entries whose names become names of rules."""
        yield from super().named_rules()
        yield from (("report", "animations", name) for name in self.report.animations)
        yield from (("machines", name) for name in self.machines)

    def moves(self) -> Iterator[tuple[Place, str | None, dict[str, float]]]:
        """Yield changed parameters: the place of the change, its case (None: all), and the parameters by name."""
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
