"""What keeps a build from being archived, told before anything is built."""

import os
from importlib.util import find_spec

from vibroimpact_pipeline.archive.checkout_state import state
from vibroimpact_pipeline.archive.citation import citation

CONFIG = "config/config.yaml"


def obstacles(root, directory, overrides: list[str]) -> list[str]:
    """A line for each thing that keeps the build from being archived.

    Args:
        root: the checkout.
        directory: where the build works.
        overrides: what sets entries of the config beside its file.
    """
    if not os.path.samefile(root, directory):
        return [f"archive: {directory} is not the checkout, {root}: build the archive there, without --directory"]
    if overrides:
        return [
            f"archive: {', '.join(overrides)} overrides {CONFIG}, which goes into the archive: "
            "write it there, or leave the override away"
        ]
    if find_spec("rocrate") is None:
        return ["archive: the package rocrate is missing: pip install 'vibroimpact[archive]', or make archive"]
    try:
        state(root)
        citation(root)
    except ValueError as error:
        return [f"archive: {error}"]
    return []
