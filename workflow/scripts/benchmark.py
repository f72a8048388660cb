"""Measure the speed of every method on one motion, and the speed of ensembles.

The table is printed and written as CSV.
"""

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.result_records import replacing

import pandas as pd

from vibroimpact.accuracy.benchmark import methods_table, scenes_table
from vibroimpact.accuracy.timing import versions

SECONDS = 0.5
OUTPUT = ROOT / "results/accuracy/benchmark.csv"

if __name__ == "__main__":
    table = pd.DataFrame([*methods_table(SECONDS), *scenes_table(SECONDS)])
    computed_with = "  ".join(f"{name} {version}" for name, version in versions().items())
    for scene, rows in table.groupby("scene", sort=False):
        text = rows.drop(columns="scene").dropna(axis="columns", how="all")
        print(scene, text.to_string(index=False, float_format="{:.3g}".format, na_rep=""), "", sep="\n")
    print(computed_with)
    with replacing(OUTPUT) as partial:
        csv = table.to_csv(index=False, lineterminator="\n")
        partial.write_text(f"{csv}# {computed_with}\n", encoding="utf-8")
