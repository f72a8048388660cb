"""Tabulate proofs by interval arithmetic for every exact orbit of a case."""

import pandas as pd

from vibroimpact.exact.orbits.proof.orbit import prove
from vibroimpact.exact.orbits.proof.passage import NOT_PROVED


def proof_rows(orbits) -> pd.DataFrame:
    """Return a row per exact orbit, in order, from its `OrbitProof`.

    Columns box_radius, orbit_error, moduli_error (as in `OrbitProof`), motion_proved ("legal", "not legal", "not
    proved"), floquet_proved ("stable", "unstable", "not proved").
    """
    proofs = [prove(orbit) for orbit in orbits]
    rows = [(p.radius, p.error, p.moduli_error, p.motion, p.stability) for p in proofs]
    names = ["box_radius", "orbit_error", "moduli_error", "motion_proved", "floquet_proved"]
    return pd.DataFrame(rows, columns=names)


def counts(table: pd.DataFrame) -> dict:
    """Count the orbits of a table, and those whose existence, motion and verdict are proved.

    Stable ones count only if their motion is proved legal too.
    """
    legal, stability = table["motion_proved"] == "legal", table["floquet_proved"]
    found = {
        "listed": table["label"],
        "proved": table[table["box_radius"] > 0],
        "motion_proved": table[table["motion_proved"] != NOT_PROVED],
        "floquet_proved": table[stability != NOT_PROVED],
        "legal": table[legal],
        "legal_and_stable": table[legal & (stability == "stable")],
        "legal_and_unstable": table[legal & (stability == "unstable")],
    }
    return {name: len(rows) for name, rows in found.items()}
