"""Compare figures as they are built with the reference set, without building any."""

import argparse
import sys

from vibroimpact_pipeline.config.reading import checked, read
from vibroimpact_pipeline.figure_check.check import check, has_failed, lines
from vibroimpact_pipeline.specs import spec_of, specs


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(prog="python -m vibroimpact_pipeline.figure_check", description=__doc__)
    parser.add_argument("figures", nargs="+", help="as fig10_06")
    known, scenes = specs(), checked(read("config/config.yaml"))["figures"]
    found = [
        check(
            figure,
            spec_of(figure, scenes.get(figure), known) if figure in scenes or figure in known else None,
            "figures",
            ".",
        )
        for figure in parser.parse_args(arguments).figures
    ]
    for verdict in found:
        print(f"{verdict['figure']}: {verdict['status']}", *verdict["reasons"], sep="\n  ")
    print(lines(found)[-1])
    return int(has_failed(found))


if __name__ == "__main__":
    sys.exit(main())
