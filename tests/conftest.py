"""Compiled code for the tests: kept in the checkout, apart for each state of its sources."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "workflow/scripts"))

from environment import settle  # noqa: E402
from vibroimpact.checks.sources import Sources  # noqa: E402

settle(ROOT, Sources())
os.environ.pop("PYTHONPATH", None)
