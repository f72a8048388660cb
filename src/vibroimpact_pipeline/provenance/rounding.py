"""What decides on the last digits of a computation: where all of it is the same, a build gives the same numbers."""

import hashlib
import platform
from importlib.metadata import version

from llvmlite.binding import get_host_cpu_features, get_host_cpu_name

COMPUTING = "numpy", "scipy", "numba", "llvmlite"
"""Packages that round."""


def rounded_by() -> dict[str, str]:
    """Processor, its instructions as a digest, C library, and versions of what computes."""
    instructions = hashlib.sha256(get_host_cpu_features().flatten().encode()).hexdigest()[:16]
    return {
        "processor": get_host_cpu_name(),
        "instructions": instructions,
        "C library": " ".join(platform.libc_ver()).strip() or platform.platform(),
        "python": platform.python_version(),
        **{name: version(name) for name in COMPUTING},
    }
