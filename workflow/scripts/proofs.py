"""How complete the lists of fixed points and orbits of all cases are -> JSON, by case.

Proved in interval arithmetic of fixed points, those with unequal flights too, and symmetric orbits. Of asymmetric
orbits nothing is proved: the number of Newton starts that led to the one that was met least says how likely another one
was missed.
"""

import dataclasses
import json
from pathlib import Path

from job import running
from vibroimpact.exact.orbits import certify as symmetric_orbits
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System
from vibroimpact.theory.asymmetric import certify as asymmetric_points
from vibroimpact.theory.fixed_points import certify as fixed_points


def main(systems: dict, searches: dict, output) -> None:
    """Prove of every case what can be proved; `searches` are the files that tell how its orbits were sought."""
    proofs = {case: of_case(System(**parameters), Path(searches[case])) for case, parameters in systems.items()}
    with replacing(output) as partial:
        partial.write_text(json.dumps(proofs, indent=1) + "\n", encoding="utf-8")


def of_case(system, search: Path) -> dict:
    proofs = {
        "fixed_points": fixed_points.certify(system),
        "asymmetric_fixed_points": asymmetric_points.certify(system),
        "symmetric_orbits": symmetric_orbits.certify(system),
    }
    return {
        **{name: {"proved": len(proof.isolated), **dataclasses.asdict(proof)} for name, proof in proofs.items()},
        "asymmetric_orbits": json.loads(search.read_text(encoding="utf-8")),
    }


if "snakemake" in globals():
    with running(snakemake):
        systems = snakemake.params.systems
        main(systems, dict(zip(systems, snakemake.input, strict=True)), snakemake.output[0])
