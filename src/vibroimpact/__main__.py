"""`python -m vibroimpact`, or `vibroimpact`: a first look at a system from the command line."""

import sys

from vibroimpact.cli.parser import main

if __name__ == "__main__":
    sys.exit(main())
