"""How complete the lists of fixed points and orbits of all cases are, what is proved of the orbits -> JSON, by case.

Lists are proved complete in interval arithmetic: of fixed points, those with unequal flights too, and of symmetric
orbits. That of asymmetric orbits is not: the number of Newton starts that led to the one that was met least says how
likely another one was missed.
"""

import dataclasses
import json
from pathlib import Path

from job import running
from vibroimpact.claims.orbit_proofs import counts
from vibroimpact.exact.orbits import certify as symmetric_orbits
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System
from vibroimpact.theory.asymmetric import certify as asymmetric_points
from vibroimpact.theory.fixed_points import certify as fixed_points


def main(systems: dict, found: dict, output) -> None:
    """Prove of every case what can be proved; `found` names its table of orbits and what tells how they were sought."""
    proofs = {case: of_case(System(**parameters), *map(Path, found[case])) for case, parameters in systems.items()}
    with replacing(output) as partial:
        partial.write_text(json.dumps(proofs, indent=1) + "\n", encoding="utf-8")


def of_case(system, table: Path, search: Path) -> dict:
    proofs = {
        "fixed_points": fixed_points.certify(system),
        "asymmetric_fixed_points": asymmetric_points.certify(system),
        "symmetric_orbits": symmetric_orbits.certify(system),
    }
    return {
        **{name: {"proved": len(proof.isolated), **dataclasses.asdict(proof)} for name, proof in proofs.items()},
        "asymmetric_orbits": json.loads(search.read_text(encoding="utf-8")),
        "orbits": counts(tables.read(table)),
    }


if "snakemake" in globals():
    with running(snakemake):
        systems = snakemake.params.systems
        pairs = zip(snakemake.input.tables, snakemake.input.searches, strict=True)
        main(systems, dict(zip(systems, pairs, strict=True)), snakemake.output[0])
