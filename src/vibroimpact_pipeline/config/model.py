"""The whole config, and the conditions across its sections."""

from pydantic import Field

from vibroimpact_pipeline.config.accuracy import Accuracy
from vibroimpact_pipeline.config.cases import Cases
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.names import taken
from vibroimpact_pipeline.config.regimes import Regimes
from vibroimpact_pipeline.config.report import Report
from vibroimpact_pipeline.config.section import Section, hint, sections
from vibroimpact_pipeline.config.stability import Stability
from vibroimpact_pipeline.config.sweeps import DRAWN, Sweeps, not_drawn
from vibroimpact_pipeline.config.system import SystemSection, unsound


class Config(Section):
    """Everything that decides on a build. All is dimensionless but plants; times are in forcing periods."""

    system: SystemSection
    cases: Cases = Field(description="Excitation amplitudes, and how the motion is integrated, by free names")
    figures: Figures
    stability: Stability
    regimes: Regimes
    accuracy: Accuracy
    tile_seconds: float = Field(20.0, gt=0, le=1e5, description="Cut sweeps into jobs of about so long [core seconds]")
    report: Report
    sweeps: Sweeps = Field({}, description=f"Sweeps by name; companion figures draw {', '.join(DRAWN)}")

    def parameters(self, case: str) -> dict:
        """Return the parameters of System for one case."""
        return {**dict(self.system), "f10_hat": self.cases[case].f10_hat, "f20_hat": self.cases[case].f20_hat}

    def conditions(self):
        yield from taken(self)
        yield from ((("sweeps", *place), what) for place, what in not_drawn(self.sweeps))
        for place, section, case in sections(self):
            if hasattr(section, "case") and case not in self.cases:
                yield (*place, "case"), f"unknown case {case!r}{hint(case, self.cases)}"
        if (drawn := self.regimes.coexistence.case) != (followed := self.regimes.branches.case):
            what = f"{drawn!r} is not {followed!r}, over whose branches it is drawn"
            yield ("regimes", "coexistence", "case"), what
        yield from dict(self._unsound_cases()).items() or self._unsound_moves().items()
        for name, sweep in self.sweeps.items():
            yield from ((("sweeps", name, *place), what) for place, what in sweep.costs(self.regimes.observation))
        for name, shown in self.report.animations.items():
            if shown.case in self.cases and shown.cycles > (kept := self.cases[shown.case].simulation.window_cycles):
                what = f"{shown.cycles} is above {kept}, window_cycles of the case {shown.case}"
                yield ("report", "animations", name, "cycles"), what

    def _unsound_cases(self):
        """Yield problems of the systems; a problem of shared parameters has the same place in all cases."""
        for case in self.cases:
            for name, what in unsound(self.parameters(case)):
                shared = name and name[0] in SystemSection.model_fields
                yield ("system", *name) if shared else ("cases", case, *name), what

    def _unsound_moves(self):
        """Return the first problem at each place that parameters are moved to."""
        found = {}
        for place, section, case in sections(self):
            for move in section.moves():
                for one in {case} & self.cases.keys() if case else self.cases:
                    at = ", ".join(f"{name} = {value:g}" for name, value in move.items())
                    for name, what in unsound(self.parameters(one) | move):
                        found.setdefault(place, f"at {at}: {': '.join([*name, what])}")
        return found
