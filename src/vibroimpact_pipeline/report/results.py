"""Tables, costs, provenance and claims quoted by the report, read from results."""

import json
import re
from itertools import pairwise
from pathlib import Path

import pandas as pd

from vibroimpact.figures import hazards
from vibroimpact.system.verdict import STABLE

KINDS = {"csv": "numbers (CSV)", "svg": "SVG", "pdf": "PDF", "png": "PNG"}
FOLDERS = ("figures", "accuracy", "force_sweep", "animations")
COSTS = ("figures", "companions", "accuracy", "report", "")
"""Folders of results/benchmarks in which the cost of a rule may stand."""


class Results:
    """Results of a build below one directory.

    Args:
        root: the directory.
        judged: whether the claims have been judged; they are about the chapter's parameters alone.
    """

    def __init__(self, root, judged: bool = True):
        self.root, self.judged = Path(root), judged

    def table(self, name: str) -> pd.DataFrame:
        """Return a CSV file, given its path below the results."""
        return pd.read_csv(self.root / name)

    def text(self, name: str) -> str:
        return (self.root / name).read_text(encoding="utf-8")

    def files(self, figure: str) -> dict[str, Path]:
        """Return the files of a figure by kind, and its further tables <figure>.<name>.csv by name.

        Raises:
            ValueError: no folder holds the figure.
        """
        for folder in FOLDERS:
            found = {kind: self.root / folder / f"{figure}.{kind}" for kind in KINDS}
            found = {kind: path for kind, path in found.items() if path.is_file()}
            if found:
                further = sorted((self.root / folder).glob(f"{figure}.*.csv"))
                return found | {path.suffixes[0][1:]: path for path in further}
        raise ValueError(f"figure: there are no files of {figure!r} in {self.root}")

    def notebook(self, figure: str) -> Path | None:
        path = self.root / f"notebooks/{figure}.html"
        return path if path.is_file() else None

    def cost(self, rule: str) -> dict | None:
        """Return seconds, processor seconds and memory [MB] of the last run of a rule, or None if not recorded."""
        paths = [self.root / "benchmarks" / folder / f"{rule}.tsv" for folder in COSTS]
        # Snakemake's own file, which a power cut leaves empty.
        path = next((path for path in paths if path.is_file() and path.stat().st_size), None)
        if path is None:
            return None
        row = pd.read_csv(path, sep="\t", na_values="-").iloc[-1]
        return {"seconds": row["s"], "processor": row["cpu_time"], "memory": row["max_rss"]}

    def provenance(self, figure: str) -> dict | None:
        """Return the provenance record of a figure, or None."""
        paths = [self.root / folder / f"{figure}.provenance.json" for folder in FOLDERS]
        path = next((path for path in paths if path.is_file()), None)
        return json.loads(path.read_text(encoding="utf-8")) if path else None

    def claims(self) -> list[dict]:
        """Return every claim with its verdict; none if they were not judged."""
        return json.loads(self.text("claims.json")) if self.judged else []

    def claims_about(self, figure: str) -> list[dict]:
        """Return the claims whose place names a figure of the chapter."""
        number = figure.removeprefix("fig10_").lstrip("0")
        named = re.compile(rf"[Ff]ig[a-z]*\.?[^()]*\b10\.{number}(?!\d)")
        return [claim for claim in self.claims() if named.search(claim["place"])]

    def most_accurate(self) -> pd.DataFrame:
        """Return for each problem and method the finished run with the smallest error, with its time as a multiple of
        ours.
        """
        table = self.table("accuracy/work_precision.csv")
        whole = table[(table["outcome"] == "finished") & table["error_state"].notna()]
        best = whole.loc[whole.groupby(["problem", "method"], sort=False)["error_state"].idxmin()]
        ours = best[best["method"] == table["method"].iloc[0]].set_index("problem")["seconds_per_cycle"]
        return best.assign(ratio=best["seconds_per_cycle"] / best["problem"].map(ours))

    def failed_runs(self) -> pd.DataFrame:
        """Return problem, method, outcome and reason of all runs without a result, and their number."""
        table = self.table("accuracy/work_precision.csv")
        failed = table[table["outcome"] != "finished"].fillna({"reason": ""})
        keys = ["problem", "method", "outcome", "reason"]
        return failed.groupby(keys, sort=False).size().rename("runs").reset_index()

    def stress_tests(self) -> pd.DataFrame:
        """Return verdict and numbers of every method in every stress test; a row per test, a column per method."""
        table = self.table("accuracy/hazards.csv")
        table = table.assign(cell=[hazards.cell(row) for row in table.itertuples()])
        cells = table.set_index(["group", "hazard", "method"])["cell"].unstack(sort=False)
        return cells.reset_index(names=["group", "stress test"])

    def value(self, file: str, *path: str):
        """Return a number from a table (file, query, column) or from JSON (file, key, key ...; an id picks a list
        entry).

        Raises:
            ValueError: the query finds several values, or none.
        """
        if file.endswith(".csv"):
            query, column = path
            (found,) = self.table(file).query(query)[column].unique()
            return found
        found = json.loads(self.text(file))
        for key in path:
            if isinstance(found, list):
                found = found[int(key)] if key.isdigit() else next(entry for entry in found if entry["id"] == key)
            else:
                found = found[key]
        return found

    def layers(self, figure: str) -> dict[str, list]:
        """Return points (phase, W2) of each motion of companion_10_08: theory, simulation, mirror image."""
        table = self.table(f"figures/{figure}.csv").query("series != 'impact'")
        motion = table["panel"].where(table["series"] == "W_2", table["series"])
        return {
            name: rows[["phase", "W2"]].round(4).to_numpy().tolist() for name, rows in table.groupby(motion, sort=False)
        }

    def stations(self) -> list[dict]:
        """Return where stability changes along the second force, ascending: value, kind, number of stable points.

        Of the fixed points (`stable`: by both time scales, above the value) the special point that lies between the two
        values of the sweep; of the exact system the onset of the torus, which has no `stable`.
        """
        sweep, special = self.table("force_sweep/force_sweep.csv"), self.table("regimes/special_points.csv")
        stable = sweep["theory"].eq(STABLE).groupby(sweep["value"]).sum()
        special = special[(special["path"] == "f20_hat") & special["admissible"]]
        onsets = special[(special["family"] == "asymmetric orbit") & (special["kind"] == "Neimark-Sacker")]
        special = special[special["family"] == "fixed point"]
        found = []
        for low, high in pairwise(stable.index):
            if stable[low] != stable[high]:
                between = special[special["p"].between(low, high)]
                found += [
                    {"value": row.p, "kind": row.kind, "stable": int(stable[high])} for row in between.itertuples()
                ]
        found += [{"value": onset, "kind": "torus", "stable": None} for onset in onsets["p"].nsmallest(1)]
        return sorted(found, key=lambda station: station["value"])
