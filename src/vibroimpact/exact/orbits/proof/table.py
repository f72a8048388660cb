"""Count the proofs in a table of orbits."""

import pandas as pd

from vibroimpact.exact.orbits.proof.passage import NOT_PROVED


def counts(table: pd.DataFrame) -> dict:
    """Return the number of orbits in a table, and the number of orbits with each kind of proof, by name.

    "legal_and_stable" is the number of orbits that are proved to be legal motions and stable.
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
