"""`python -m vibroimpact`, or `vibroimpact`: a first look at a system from the command line."""

import sys

from vibroimpact.interrupt import without_traceback


def main() -> int:
    """Run one command; return the exit status."""
    with without_traceback():
        from vibroimpact.cli.parser import main  # takes a second, which may be interrupted, too

        return main()


if __name__ == "__main__":
    sys.exit(main())
