"""Event-driven simulation (closed-form flight, impacts, chatter, sticking, release) with a certificate for each run."""
