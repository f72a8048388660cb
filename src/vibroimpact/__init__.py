"""Computational nonlinear dynamics of two coupled vibro-impact modules: theory, exact simulation, comparison.

- `System`, `PhysicalSystem`: parameters, dimensionless or in SI units.
- `fixed_points`: motions that the chapter's theory predicts.
- `orbits`, `prove`: exact periodic motions with Floquet multipliers, and their proofs.
- `periodic_orbit`: a periodic motion of any period, refined from a nearby state.
- `simulate`, `simulate_many`, `ensemble`: one exact run, many exact runs, summary statistics of many runs.
- `largest_lyapunov`, `lyapunov_spectrum`: Lyapunov exponents with error estimates.
- `attractors`, `basins`: attractors, and their basins on a plane of initial states.
- `sections`: stroboscopic sections, such as a bifurcation diagram.
- `branches`: continuation of motions with one impact at each wall per forcing period.
- `sweep`: regimes and amplitudes on a grid of parameters.
- `design`: choice of the ball for a machine.
- `to_frame`, `to_dataset`: results as tables.

There are four verdicts on stability: `fast` (stability of the impacts), `slow` (stability of the amplitudes), `theory`
(`fast` and `slow` together) and `exact` (stability of the exact orbit).
"""

from importlib import import_module
from importlib.metadata import version

_NAMES = {
    "system": "System PhysicalSystem",
    "theory.fixed_points.symmetric_points": "fixed_points FixedPoint",
    "exact.orbits.search": "orbits Orbit prove",
    "exact.periodic": "periodic_orbit PeriodicOrbit",
    "frames": "to_frame to_dataset",
    "studies.public.continuation": "branches",
    "studies.public.sweeps": "sweep",
    "studies.public.sections": "sections",
    "studies.regimes.attractors": "attractors basins Basins Attractor",
    "studies.regimes.settling": "Observation",
    "studies.regimes.classification": "starts",
    "studies.regimes.lyapunov": "largest_lyapunov lyapunov_spectrum",
    "studies.one_machine": "design Design",
    "exact.engine.simulation": "simulate simulate_many Run",
    "exact.lanes.ensemble": "ensemble OUTCOME STATUSES",
    "exact.engine.energy": "Energy ENERGY",
    "exact.engine.certificate": "Certificate",
    "system.state": "EVENT KINDS IMPACT STICK RELEASE",
}
"""Public names in each module of the package; `__init__.pyi` lists the same names for type checkers."""
_PUBLIC = {name: f"vibroimpact.{module}" for module, names in _NAMES.items() for name in names.split()}
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
        missing = f"vibroimpact.{name} needs the studies, the folder vibroimpact/studies, which is not installed"
        raise ModuleNotFoundError(missing, name=error.name) from None
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)
