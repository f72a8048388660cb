"""The whole config, and the conditions across its sections."""

from vibroimpact_pipeline.config.accuracy import Accuracy
from vibroimpact_pipeline.config.cases import Cases
from vibroimpact_pipeline.config.fields import OfCase
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.messages import hint
from vibroimpact_pipeline.config.names import taken
from vibroimpact_pipeline.config.regimes import Regimes
from vibroimpact_pipeline.config.report import Report
from vibroimpact_pipeline.config.section import Problem, Section, marked, sections
from vibroimpact_pipeline.config.stability import Stability
from vibroimpact_pipeline.config.sweeps import Sweeps, not_drawn
from vibroimpact_pipeline.config.system import SystemSection, unsound


class Config(Section):
    """Everything that decides on a build. All is dimensionless but plants; times are in forcing periods."""

    system: SystemSection
    cases: Cases
    figures: Figures
    stability: Stability
    regimes: Regimes
    accuracy: Accuracy
    report: Report
    sweeps: Sweeps = {}  # noqa: RUF012

    def parameters(self, case: str) -> dict:
        """Parameters of System for one case."""
        return {**dict(self.system), "f10_hat": self.cases[case].f10_hat, "f20_hat": self.cases[case].f20_hat}

    def conditions(self):
        yield from taken(self)
        for place, case in marked(self, OfCase):
            if case not in self.cases:
                yield Problem(place, f"unknown case {case!r}{hint(case, self.cases)}")
        yield from (unsound_cases := list(self._unsound_cases()))
        if not unsound_cases:
            yield from self._unsound_changes()
            yield from self._unsound_sweeps()
        yield from self._short_windows()
        drawn, over = self.regimes.coexistence.case, self.regimes.branches.case
        if drawn != over and {drawn, over} <= self.cases.keys():
            what = f"{drawn!r} is not {over!r}, over whose branches it is drawn"
            yield Problem(("regimes", "coexistence", "case"), what)

    def _unsound_cases(self):
        """Problems of the systems; those of shared parameters once."""
        found = {}
        for case in self.cases:
            for (*name,), what in unsound(self.parameters(case)):
                shared = name and name[0] in SystemSection.model_fields
                found[("system", *name) if shared else ("cases", case, *name)] = what
        return [Problem(place, what) for place, what in found.items()]

    def _unsound_changes(self):
        found = {}
        for place, section in sections(self):
            for change in section.changes():
                for case in {change.case} & self.cases.keys() if change.case else self.cases:
                    found |= {(*place, *where): what for where, what in _problems_along(change, self.parameters(case))}
        return [Problem(place, what) for place, what in found.items()]

    def _unsound_sweeps(self):
        for place, what in not_drawn(self.sweeps):
            yield Problem(("sweeps", *place), what)
        for name, sweep in self.sweeps.items():
            found = [*sweep.costs(self.regimes.observation)]
            if sweep.case in self.cases:
                found += sweep.unsound_corners(self.parameters(sweep.case))
            for place, what in found:
                yield Problem(("sweeps", name, *place), what)

    def _short_windows(self):
        """Animations that show more than their case keeps."""
        windows = {case: settings.simulation.window_cycles for case, settings in self.cases.items()}
        for name, shown in self.report.animations.items():
            kept = windows.get(shown.case, shown.cycles)
            if shown.cycles > kept:
                what = f"{shown.cycles} is above {kept}, window_cycles of the case {shown.case}"
                yield Problem(("report", "animations", name, "cycles"), what)


def _problems_along(change, parameters):
    """What is wrong with a system on the way; limits of parameters are intervals, so that the ends speak for all."""
    for number, value in enumerate(change.values):
        for (*name,), what in unsound(parameters | dict.fromkeys(change.along, value)):
            moved = name and name[0] in change.along
            yield Problem((*change.place, number), f"{name[0]}: {what}" if moved else f"at {value}: {what}")
