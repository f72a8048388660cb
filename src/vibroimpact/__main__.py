"""Entry point of the command line: `vibroimpact` or `python -m vibroimpact`."""

import sys

from vibroimpact.interrupt import without_traceback


def main() -> int:
    """Run one command; return the exit status."""
    with without_traceback():
        # This import takes a second. The import is inside the `with` block, so that Ctrl-C prints no traceback.
        from vibroimpact.cli.parser import main

        return main()


if __name__ == "__main__":
    sys.exit(main())
