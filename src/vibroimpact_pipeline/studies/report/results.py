"""Read tables, numbers, provenance and claims for the report from results."""

import json
import re
from pathlib import Path

import pandas as pd

KINDS = ("csv", "svg", "pdf", "png")
FOLDERS = ("figures", "accuracy", "nudge")


class Results:
    """Read the results of a build from one directory.

    If `judged` is False, the list of claims is empty.
    """

    def __init__(self, root, judged: bool = True):
        self.root, self.judged = Path(root), judged

    def table(self, name: str) -> pd.DataFrame:
        """Return the table in a CSV file; `name` is its path relative to the results directory."""
        return pd.read_csv(self.root / name)

    def text(self, name: str) -> str:
        return (self.root / name).read_text(encoding="utf-8")

    def files(self, figure: str) -> dict[str, Path]:
        """Return the paths of the files of a figure by kind (csv, svg, pdf or png).

        If the figure has a further table <figure>.<name>.csv, the path of this table has the key <name>.

        Raises
        ------
        ValueError
            If the figure has no files.
        """
        folder = self._folder(figure)
        found = {kind: folder / f"{figure}.{kind}" for kind in KINDS}
        found = {kind: path for kind, path in found.items() if path.is_file()}
        return found | {path.suffixes[0][1:]: path for path in sorted(folder.glob(f"{figure}.*.csv"))}

    def _folder(self, figure: str) -> Path:
        for folder in FOLDERS:
            if (self.root / folder / f"{figure}.svg").is_file():
                return self.root / folder
        raise ValueError(f"figure: no files of {figure!r} found in {self.root}")

    def notebook(self, figure: str) -> Path | None:
        path = self.root / f"notebooks/{figure}.html"
        return path if path.is_file() else None

    def provenance(self, figure: str) -> dict:
        """Return the provenance record of a figure."""
        return json.loads((self._folder(figure) / f"{figure}.provenance.json").read_text(encoding="utf-8"))

    def claims(self) -> list[dict]:
        """Return the judged claims in the order of the chapter. If claims are not judged, the list is empty."""
        return json.loads(self.text("claims.json")) if self.judged else []

    def claims_about(self, figure: str) -> list[dict]:
        """Return the judged claims that refer to a figure of the chapter."""
        named = re.compile(rf"[Ff]ig[a-z]*\.?[^()]*\b10\.{figure.removeprefix('fig10_').lstrip('0')}(?!\d)")
        return [claim for claim in self.claims() if named.search(claim["place"])]

    def most_accurate(self) -> pd.DataFrame:
        """Return the finished run with the smallest error for each problem and method.

        The column `ratio` contains the run time divided by the run time of the event-driven engine for this problem.
        """
        table = self.table("accuracy/work_precision.csv")
        whole = table[(table["outcome"] == "finished") & table["error_state"].notna()]
        best = whole.loc[whole.groupby(["problem", "method"], sort=False)["error_state"].idxmin()]
        ours = best[best["method"] == table["method"].iloc[0]].set_index("problem")["seconds_per_cycle"]
        return best.assign(ratio=best["seconds_per_cycle"] / best["problem"].map(ours))

    def value(self, place: str):
        """Return a number from the results. docs/studies/numbers.yaml describes the form of `place`.

        Raises
        ------
        ValueError
            If a query of a table does not find exactly one value.
        """
        file, *path = place.removeprefix("percent | ").split(" | ")
        scale = 100 if place.startswith("percent | ") else 1
        if file.endswith(".csv"):
            query, column = path
            (found,) = self.table(file).query(query)[column].unique()
            return scale * found
        found = json.loads(self.text(file))
        for key in path:
            if isinstance(found, list):
                found = found[int(key)] if key.isdigit() else next(entry for entry in found if entry["id"] == key)
            else:
                found = found[key]
        return scale * found
