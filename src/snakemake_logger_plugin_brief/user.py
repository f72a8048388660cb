"""A user without a home or without a name, as containers have it; Snakemake asks for both before it reads any rule."""

import getpass
import os
from pathlib import Path

CHECKOUT = Path(__file__).parents[2]


def settle() -> None:
    """Set in the environment what Snakemake would otherwise look for in the home directory and the list of users.

    Its cache of sources comes into the checkout, or into the working directory where the checkout cannot be written
    to; a user without a name is called by number.
    """
    place = CHECKOUT if os.access(CHECKOUT, os.W_OK) else Path.cwd()
    os.environ.setdefault("XDG_CACHE_HOME", str(place / ".cache"))
    try:
        getpass.getuser()
    except (KeyError, OSError):  # OSError since Python 3.13
        os.environ["LOGNAME"] = str(os.getuid())
