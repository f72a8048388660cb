"""Run Python programs in other processes."""

import os
import subprocess
import sys


def run_program(program: str, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
    """Run Python code that can import what the tests import, with the given environment variables only."""
    return subprocess.run(
        [sys.executable, "-c", program, *arguments],
        env={"PYTHONPATH": os.pathsep.join(filter(None, sys.path)), **environment},
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
