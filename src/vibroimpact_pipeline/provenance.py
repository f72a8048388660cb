"""Provenance of a figure: a record beside it and in its metadata, and a command that compares it with the checkout.

python -m vibroimpact_pipeline.provenance results/figures/fig10_06.png
"""

import argparse
import json
import platform
import re
import sys
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

from PIL import Image

from vibroimpact_pipeline import code
from vibroimpact_pipeline.git import git
from vibroimpact_pipeline.results import digest_of, read_record
from vibroimpact_pipeline.specs import at, case_parameters

LOCK = "environment.lock"
PACKAGES = ("numpy", "scipy", "numba", "matplotlib")
DUBLIN_CORE = "{http://purl.org/dc/elements/1.1/}description"


def record(job) -> dict:
    """Return the record for the metadata of the pictures, the same in every build of one commit."""
    return {
        "figure": job.params.figure,
        "config": job.params.config,
        "code": dict(job.params.code),
        "inputs": {_name(path): digest_of(path) for path in job.input},
        "lock": digest_of(code.ROOT / LOCK),
        "versions": {"python": platform.python_version(), **{name: version(name) for name in PACKAGES}},
    }


def _name(path):
    """Return the path of an input, relative to the checkout if it lies there."""
    return str(Path(path).relative_to(code.ROOT)) if Path(path).is_relative_to(code.ROOT) else str(path)


def write(path, made: dict) -> None:
    """Write the record beside the figure, with the commit of the checkout and whether it is clean."""
    changes = git("status", "--porcelain", root=code.ROOT)
    tree = {None: None, "": "clean"}.get(changes, "modified")
    full = {**made, "commit": git("rev-parse", "HEAD", root=code.ROOT), "tree": tree}
    Path(path).write_text(json.dumps(full, indent=1) + "\n", encoding="utf-8")


def read(path) -> dict:
    """Return the record of a figure: the file beside it, else the metadata of its PNG, SVG or PDF.

    Raises:
        ValueError: the file has none.
    """
    path = Path(path)
    beside = path.with_name(path.name.split(".")[0] + ".provenance.json")
    try:
        return json.loads(beside.read_text(encoding="utf-8") if beside.is_file() else METADATA[path.suffix](path))
    except (KeyError, TypeError, ValueError, ElementTree.ParseError):
        raise ValueError(f"{path} has no record of where it comes from") from None


def _in_png(path):
    with Image.open(path) as picture:
        return picture.info["Description"]


def _in_svg(path):
    return ElementTree.parse(path).findtext(f".//{DUBLIN_CORE}")


def _in_pdf(path):
    """Return /Subject, which Matplotlib writes as plain text with backslashes before brackets and backslashes."""
    found = re.search(rb"/Subject \(((?:[^\\()]|\\.)*)\)", path.read_bytes(), re.DOTALL)
    return found and re.sub(rb"\\(.)", rb"\1", found[1])


METADATA = {".png": _in_png, ".svg": _in_svg, ".pdf": _in_pdf}


def differences(path, made: dict, config: dict) -> Iterator[str]:
    """Yield one line per change since the figure was made.

    Args:
        path: of the figure's file.
        made: its record.
        config: the config of today, checked.
    """
    for place, value in made["config"].items():
        if (now := _at(config, place)) != value:
            yield f"config, {place}: is {now}, was {value}"
    for part, fingerprint in made["code"].items():
        if code.fingerprint(part) != fingerprint:
            yield f"code of the {part}: has changed"
    for name, digest in {**made["inputs"], str(code.ROOT / LOCK): made["lock"]}.items():
        file = Path(name) if Path(name).is_file() else code.ROOT / name
        if not file.is_file() or digest_of(file) != digest:
            yield f"{name}: has changed"
    written = read_record(path)
    if written and written["sha256"] != digest_of(path):
        yield "the file itself: is not what its job wrote"


def _at(config, place):
    """Return the config entry at "section.key"; for a case, the parameters of its System."""
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
    """Return the exit status: 0 the file matches, 1 it does not, 2 it has no record."""
    from vibroimpact_pipeline.config import checked
    from vibroimpact_pipeline.config import read as read_config

    parser = argparse.ArgumentParser(prog="python -m vibroimpact_pipeline.provenance", description=__doc__)
    parser.add_argument("file", type=Path, help="a figure's file, such as results/figures/fig10_06.png")
    file = parser.parse_args().file
    settings = next(path for path in (Path("config/config.yaml"), code.ROOT / "config/config.yaml") if path.is_file())
    try:
        made, config = read(file), checked(read_config(settings))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    found = list(differences(file, made, config))
    commit, tree = made.get("commit") or "not known", made.get("tree") or "without git"
    print(f"{file}: {made['figure']}, made from commit {commit} ({tree})")
    print(*found, f"{len(found)} difference(s)." if found else "It is what this checkout makes.", sep="\n")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
