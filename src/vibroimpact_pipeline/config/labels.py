"""Fixed points that the config names: are they there? To know, the fixed points of the case are solved for."""

import hashlib
import json
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System
from vibroimpact_pipeline.config.fields import OfFixedPoint
from vibroimpact_pipeline.config.section import Problem, marked

Labels = Callable[[dict], list[str]]
"""The labels of the fixed points, by the parameters of System."""
MODULES = ["vibroimpact.theory.fixed_points.labels", "vibroimpact.theory.fixed_points.search"]
"""What labels depend on beside the parameters."""


def labels(parameters: dict) -> list[str]:
    """The labels of the fixed points, in ascending order."""
    # Here, because SciPy takes longer to load than all else that a build with nothing to do needs.
    from vibroimpact.theory.fixed_points.labels import labels as labelled
    from vibroimpact.theory.fixed_points.search import fixed_points

    system = System(**parameters)
    return sorted(labelled(system, fixed_points(system)))


def remembered(path, version: str) -> Labels:
    """`labels`, each computed once and kept in a file, as long as the version is the same."""
    path = Path(path)
    known = _kept(path, version)

    def remember(parameters):
        key = hashlib.sha256(json.dumps(parameters, sort_keys=True).encode()).hexdigest()
        if key not in known:
            known[key] = labels(parameters)
            _keep(path, {"version": version, "labels": known})
        return known[key]

    return remember


def without_fixed_points(config, labels: Labels) -> Iterator[Problem]:
    """Cases that cannot be solved, and labels under which a case has no fixed point."""
    known = {}
    for case in config.cases:
        try:
            known[case] = labels(config.parameters(case))
        except ArithmeticError as error:
            yield Problem(("cases", case), f"its fixed points cannot be found: {error}")
    for place, label in marked(config, OfFixedPoint):
        case = _beside(config, place, "case")
        if label not in known.get(case, label):
            has = f"it has {', '.join(known[case])}" if known[case] else "it has none"
            has += "; write null to leave the entry out" if "mixed" in place else ""
            yield Problem(place, f"the case {case} has no fixed point {label!r}: {has}")


def _beside(config, place, name):
    """The field of a name in the section of a place."""
    for part in place[:-1]:
        config = config[part] if isinstance(config, dict | list) else getattr(config, part)
    return getattr(config, name)


def _kept(path, version):
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        return kept["labels"] if kept["version"] == version else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def _keep(path, content):
    """Where that is not possible they are computed again the next time."""
    with suppress(OSError), replacing(path) as partial:
        partial.write_text(json.dumps(content), encoding="utf-8")
