"""Tables of all cases -> one table."""

import pandas as pd

from job import running
from vibroimpact.figures.kit import tables


def main(inputs, output) -> None:
    tables.write(pd.concat([pd.read_csv(path) for path in inputs], ignore_index=True), output)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.input, snakemake.output[0])
