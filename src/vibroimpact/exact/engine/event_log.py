"""What a run writes down: its events, one row each, and a ledger of what its certificate needs besides.

A row is [time since the start, module, wall, kind, state after, forcing phase when it was noted, approach, sine and
cosine of the phase]; the stick that completes a chatter is noted at the chatter's last simulated impact.
"""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import inlined

EVENTS, FLIGHTS, EVALUATIONS, UNDECIDED, CHATTERS, RESIDUAL, NEGLECTED, ENTRIES = range(8)
"""Entries of a run's ledger: five counts, then the largest |W| - 1 at an impact and the sum of what completed chatters
neglect; their number."""


class Log(NamedTuple):
    """Rows of events (n, ROW), as many as the ledger (ENTRIES,) counts, the rest free."""

    rows: np.ndarray
    ledger: np.ndarray


TIME, MODULE, WALL, KIND = range(4)
PHASE, APPROACH, SINE, COSINE, ROW = 12, 13, 14, 15, 16  # places in a row, and its length


@inlined
def record(log, time, i, wall, kind, boxes, balls, approach):
    """Write an event of module i (0, 1), all but its phase.

    approach: the relative velocity before an impact; the speed with which the last rebound of a completed chatter
    starts, at its stick; else 0.
    """
    row = log.rows[int(log.ledger[EVENTS])]
    row[0], row[1], row[2], row[3] = time, i + 1, wall, kind
    pack(boxes, balls, row[4:PHASE])
    row[APPROACH] = approach
    log.ledger[EVENTS] += 1.0


@inlined
def pack(boxes, balls, state):
    """Write the state in the public order [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
    for i in range(4):
        state[2 * i] = boxes[i]
        state[2 * i + 1] = balls[i]
