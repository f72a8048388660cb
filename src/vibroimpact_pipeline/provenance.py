"""Write the provenance record of a figure, or compare a record with the current checkout.

The following command compares the record of one figure:
python -m vibroimpact_pipeline.provenance results/figures/fig10_06.png
"""

import argparse
import json
import os
import platform
import sys
from collections.abc import Iterator
from pathlib import Path

from vibroimpact_pipeline import code
from vibroimpact_pipeline.git import origin
from vibroimpact_pipeline.result_records import RESULTS, digest_of, is_result
from vibroimpact_pipeline.specs import at, case_parameters

CONFIG = "config"
"""Folder of config files, relative to the folder of a build or to the checkout."""


def write(job, out) -> None:
    """Write the provenance record of a figure whose files exist.

    The file `out.provenance` must already contain the versions of packages.
    """
    folder = Path(job.output.provenance).parent
    outputs = {path: getattr(out, name) for name, path in job.output.items() if name != "provenance"}
    commit, tree = origin(code.ROOT)
    record = {
        "figure": job.params.figure,
        "config": job.params.config,
        "code": dict(job.params.code),
        "inputs": {os.path.relpath(path, folder): digest_of(path) for path in job.input if is_result(path)},
        "files": {os.path.relpath(path, folder): digest_of(partial) for path, partial in outputs.items()},
        **json.loads(Path(out.provenance).read_text(encoding="utf-8")),
        "commit": commit,
        "tree": tree,
    }
    Path(out.provenance).write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def read(path) -> dict:
    """Return the provenance record of a figure, given one of its files.

    Raises
    ------
    ValueError
        If there is no readable record.
    """
    path = Path(path)
    try:
        return json.loads(path.with_name(path.name.split(".")[0] + ".provenance.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ValueError(f"{path}: no readable provenance record next to this file") from None


def differences(path, record: dict, config: dict) -> Iterator[str]:
    """Yield one line for each change since the figure was made.

    `path` is a file of the figure, and `config` is the current config.
    """
    for place, value in record["config"].items():
        if (now := _at(config, place)) != value:
            yield f"config, {place}: was {value}, is now {now}"
    python = platform.python_version_tuple()[:2]
    if (then := tuple(record["versions"]["python"].split(".")[:2])) != python:
        yield f"Python: was {'.'.join(then)}, is now {'.'.join(python)}; code cannot be compared across versions"
    elif code.changed(record["code"]):
        yield f"code of {', '.join(record['code']['of'])}: has changed since the figure was made"
    for name, digest in {**record["inputs"], **record["files"]}.items():
        file = Path(os.path.normpath(Path(path).parent / name))
        if not file.is_file() or digest_of(file) != digest:
            yield f"{file}: missing or changed since the figure was made"


def _at(config, place):
    """Return the config entry at a key path such as "section.key", or None if the entry is missing.

    For "cases.NAME", return the parameters of System for this case. For "cases", return a mapping from the
    name of each case to these parameters.
    """
    section, _, name = place.partition(".")
    if place == "cases":
        return {case: case_parameters(config, case) for case in config["cases"]}
    if section == "cases" and "." not in name:
        return case_parameters(config, name) if name in config["cases"] else None
    try:
        return at(config, place)
    except (LookupError, TypeError):
        return None


def main() -> int:
    """Compare a figure with the checkout; return 0 if they agree, 1 if they differ, 2 if the comparison fails."""
    from vibroimpact_pipeline.config import checked, merged
    from vibroimpact_pipeline.config import read as read_config

    parser = argparse.ArgumentParser(prog="python -m vibroimpact_pipeline.provenance", description=__doc__)
    parser.add_argument("file", type=Path, help="file of a figure, such as results/figures/fig10_06.png")
    file = parser.parse_args().file
    # Symbolic links are not resolved, because `results` may be a link to a folder on another disk.
    parents = Path(os.path.abspath(file)).parents
    build = next((folder.parent for folder in parents if folder.name == RESULTS), code.ROOT)
    of_checkout = sorted((code.ROOT / CONFIG).glob("*.yaml"))
    settings = [own if (own := build / CONFIG / path.name).is_file() else path for path in of_checkout]
    try:
        record, config = read(file), checked(merged([(path, read_config(path)) for path in settings]))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    found = list(differences(file, record, config))
    commit, tree = record.get("commit") or "unknown", record.get("tree") or "without git"
    summary = f"{len(found)} difference(s)." if found else "No differences: this checkout makes the same figure."
    print(f"{file}: {record['figure']}, made from commit {commit} ({tree})", *found, summary, sep="\n")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
