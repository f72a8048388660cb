"""Computational nonlinear dynamics of two coupled vibro-impact modules: theory, exact simulation, comparison.

- `System`, `PhysicalSystem`: the parameters, dimensionless or in SI units.
- `fixed_points`: the motions that the chapter's theory predicts.
- `orbits`, `prove`: exact periodic motions with Floquet multipliers; proof of such a motion in interval arithmetic.
- `periodic_orbit`: a periodic motion of any period and any impacts, refined from a state near it.
- `simulate`, `simulate_many`, `ensemble`: one exact run; many exact runs; summary statistics of many runs.
- `largest_lyapunov`, `lyapunov_spectrum`: Lyapunov exponents with errors.
- `attractors`, `basins`: the attractors of a system; their basins on a plane of initial states.
- `sections`: stroboscopic sections of many runs, such as a bifurcation diagram.
- `branches`, `bifurcation_curves`: continuation in one parameter; folds and symmetry breaking in two parameters.
- `sweep`: observations over a grid of parameters.
- `design`, `best_tuning`, `textbook_tuning`: choice of the ball for a machine; linear absorbers.
- `to_frame`, `to_dataset`: results as tables.

Verdicts on stability have the same names everywhere: `fast` (impacts), `slow` (amplitudes), `theory` (both), `exact`
(the exact orbit).
"""

from importlib import import_module
from importlib.metadata import version

_PUBLIC = {
    "System": "vibroimpact.system",
    "PhysicalSystem": "vibroimpact.system",
    "fixed_points": "vibroimpact.theory.fixed_points.symmetric_points",
    "FixedPoint": "vibroimpact.theory.fixed_points.symmetric_points",
    "orbits": "vibroimpact.exact.orbits.search",
    "Orbit": "vibroimpact.exact.orbits.search",
    "prove": "vibroimpact.exact.orbits.search",
    "periodic_orbit": "vibroimpact.exact.periodic",
    "PeriodicOrbit": "vibroimpact.exact.periodic",
    "to_frame": "vibroimpact.frames",
    "to_dataset": "vibroimpact.frames",
    "branches": "vibroimpact.studies.public.continuation",
    "bifurcation_curves": "vibroimpact.studies.public.continuation",
    "sweep": "vibroimpact.studies.public.sweeps",
    "sections": "vibroimpact.studies.public.sections",
    "attractors": "vibroimpact.studies.regimes.attractors",
    "basins": "vibroimpact.studies.regimes.attractors",
    "Basins": "vibroimpact.studies.regimes.attractors",
    "Attractor": "vibroimpact.studies.regimes.attractors",
    "Observation": "vibroimpact.studies.regimes.settling",
    "starts": "vibroimpact.studies.regimes.classification",
    "largest_lyapunov": "vibroimpact.studies.regimes.lyapunov",
    "lyapunov_spectrum": "vibroimpact.studies.regimes.lyapunov",
    "Tuning": "vibroimpact.studies.absorbers.references",
    "tuned": "vibroimpact.studies.absorbers.references",
    "best_tuning": "vibroimpact.studies.absorbers.tuning",
    "textbook_tuning": "vibroimpact.studies.absorbers.tuning",
    "decay_time": "vibroimpact.studies.absorbers.decay",
    "design": "vibroimpact.studies.one_machine",
    "Design": "vibroimpact.studies.one_machine",
    "simulate": "vibroimpact.exact.engine.simulation",
    "simulate_many": "vibroimpact.exact.engine.simulation",
    "ensemble": "vibroimpact.exact.lanes.ensemble",
    "OUTCOME": "vibroimpact.exact.lanes.ensemble",
    "STATUSES": "vibroimpact.exact.lanes.ensemble",
    "Run": "vibroimpact.exact.engine.simulation",
    "Energy": "vibroimpact.exact.engine.energy",
    "ENERGY": "vibroimpact.exact.engine.energy",
    "Certificate": "vibroimpact.exact.engine.certificate",
    "EVENT": "vibroimpact.system.state",
    "KINDS": "vibroimpact.system.state",
    "IMPACT": "vibroimpact.system.state",
    "STICK": "vibroimpact.system.state",
    "RELEASE": "vibroimpact.system.state",
}
"""Python module of each public name; `__init__.pyi` lists the same names for type checkers."""
__all__ = [*_PUBLIC, "__version__"]


def __getattr__(name: str):
    """Load a public name on first use, so that `import vibroimpact` is fast."""
    if name == "__version__":
        return version("vibroimpact")
    if name not in _PUBLIC:
        raise AttributeError(f"module 'vibroimpact' has no attribute {name!r}")
    try:
        value = getattr(import_module(_PUBLIC[name]), name)
    except ModuleNotFoundError as error:
        if error.name != "vibroimpact.studies":
            raise
        missing = f"vibroimpact.{name} belongs to the studies, the folder vibroimpact/studies, which is missing here"
        raise ModuleNotFoundError(missing, name=error.name) from None
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)
