"""Tables of all cases -> one table."""

import pandas as pd

from adapter import logging_to, write_csv


def main(inputs, output) -> None:
    write_csv(pd.concat([pd.read_csv(path) for path in inputs], ignore_index=True), output)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.input, snakemake.output[0])
