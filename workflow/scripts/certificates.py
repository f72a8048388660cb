"""How complete the lists of fixed points and orbits of all cases are -> JSON, by case.

Proved in interval arithmetic of fixed points and symmetric orbits. Of asymmetric orbits nothing is proved: the number
of Newton starts that led to the one that was met least says how likely another one was missed.
"""

import dataclasses
import json

from job_log import logging_to
from vibroimpact.exact.orbits import certify as symmetric_orbits
from vibroimpact.exact.orbits.search import search
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System
from vibroimpact.theory.fixed_points import certify as fixed_points


def main(systems: dict, output) -> None:
    certificates = {case: of_case(System(**parameters)) for case, parameters in systems.items()}
    with replacing(output) as partial:
        partial.write_text(json.dumps(certificates, indent=1) + "\n", encoding="utf-8")


def of_case(system) -> dict:
    proofs = {"fixed_points": fixed_points.certify(system), "symmetric_orbits": symmetric_orbits.certify(system)}
    found = search(system)
    listed = sum(not orbit.symmetric for orbit in found.orbits)
    return {
        **{name: {"proved": len(proof.isolated), **dataclasses.asdict(proof)} for name, proof in proofs.items()},
        "asymmetric_orbits": {"listed": listed, "starts": found.starts, "fewest_hits": found.fewest_hits},
    }


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.params.systems, snakemake.output[0])
