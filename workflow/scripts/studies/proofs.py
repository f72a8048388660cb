"""Write proofs on the fixed points and orbits of all cases as JSON.

Interval arithmetic proves that the lists of fixed points and of symmetric orbits are complete. The list of asymmetric
orbits has no proof. The search for these orbits counts the first values of Newton's method that led to each orbit. If
many first values led to each orbit in the list, it is unlikely that an orbit was missed.
"""

import dataclasses
import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

from vibroimpact.studies.completeness.orbits import certify as certify_orbits
from vibroimpact.studies.completeness.points import certify, certify_asymmetric
from vibroimpact.system import System

CERTIFIED = {
    "fixed_points": certify,
    "asymmetric_fixed_points": certify_asymmetric,
    "symmetric_orbits": certify_orbits,
}


def proofs_of(system, search) -> dict:
    """Return the proofs in CERTIFIED for one case, and the content of the file `search` (search.json).

    Each proof shows that one list of fixed points or orbits is complete.
    """
    proofs = {name: prove(system) for name, prove in CERTIFIED.items()}
    return {
        **{name: {"proved": len(proof.isolated), **dataclasses.asdict(proof)} for name, proof in proofs.items()},
        "asymmetric_orbits": json.loads(Path(search).read_text(encoding="utf-8")),
    }


with running(snakemake) as out:
    cases = zip(snakemake.params.systems.items(), snakemake.input, strict=True)
    found = {case: proofs_of(System(**values), search) for (case, values), search in cases}
    Path(out.json).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
