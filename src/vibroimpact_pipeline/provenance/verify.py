"""Where a figure comes from, as its file says, and whether the tree would still make it so.

A PNG, PDF or SVG file bears its record itself; for any other file of a figure the sidecar <figure>.provenance.json
speaks, which also tells commit and run time.
"""

import argparse
import json
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import yaml
from PIL import Image

import vibroimpact
from vibroimpact.figures.kit.style import PROVENANCE_KEYS
from vibroimpact_pipeline.checkout import ROOT
from vibroimpact_pipeline.integrity.checksums import digest_of
from vibroimpact_pipeline.sources import Sources

CONFIG, LOCK = "config/config.yaml", "environment.lock"
DUBLIN_CORE = "{http://purl.org/dc/elements/1.1/}"


def embedded(path) -> dict:
    """The record in the metadata of a PNG, PDF or SVG file.

    Raises:
        ValueError: the file bears no record.
    """
    path = Path(path)
    try:
        return json.loads(READERS[path.suffix](path))
    except (KeyError, TypeError, ValueError, SyntaxError):
        raise ValueError(f"{path} bears no record of where it comes from") from None


def _from_png(path):
    with Image.open(path) as picture:
        return picture.info[PROVENANCE_KEYS["png"]]


def _from_svg(path):
    return ElementTree.parse(path).findtext(f".//{DUBLIN_CORE}{PROVENANCE_KEYS['svg'].lower()}")


def _from_pdf(path):
    """Matplotlib writes the entry as plain text, with a backslash before brackets and backslashes."""
    entry = re.search(rb"/%s \(((?:[^\\()]|\\.)*)\)" % PROVENANCE_KEYS["pdf"].encode(), path.read_bytes(), re.DOTALL)
    return re.sub(rb"\\(.)", rb"\1", entry[1]) if entry else None


READERS = {".png": _from_png, ".pdf": _from_pdf, ".svg": _from_svg}


def sidecar(path) -> dict | None:
    """The sidecar beside a figure's file, if there is one."""
    path = Path(path)
    beside = path.with_name(path.name.split(".")[0] + ".provenance.json")
    return json.loads(beside.read_text(encoding="utf-8")) if beside.is_file() else None


def provenance(path) -> dict:
    """The record of a figure's file, with what its sidecar adds where the two agree.

    Raises:
        ValueError: neither the file nor a sidecar tells.
        OSError: the file cannot be read.
    """
    beside = sidecar(path)
    if Path(path).suffix not in READERS:
        if beside is None or not Path(path).is_file():
            raise ValueError(f"{path}: no such file of a figure with a sidecar beside it")
        return beside
    record = embedded(path)
    same = beside is not None and all(beside.get(name) == value for name, value in record.items())
    return beside if same else record


def differences(record: dict, root, file=None, directory=None) -> list[tuple[str, str | None]]:
    """Everything that decided on a figure, each with what differs in the tree at root now, or None.

    Args:
        record: see `provenance`.
        root: the checkout.
        file: the file itself, to compare with what its sidecar says was written.
        directory: where the build worked, whose config goes before that of the checkout; None: in the checkout.

    Raises:
        ValueError: the library in use is not the one of the tree.
    """
    root = Path(root).resolve()
    directory = root if directory is None else Path(directory)
    if not Path(vibroimpact.__file__).resolve().is_relative_to(root):
        raise ValueError(f"root: the library in use, {Path(vibroimpact.__file__).parent}, does not belong to {root}")
    settings = directory / CONFIG if (directory / CONFIG).is_file() else root / CONFIG
    config = yaml.safe_load(settings.read_text(encoding="utf-8"))
    found = [(f"{CONFIG}, {key}", _config_difference(config, key, value)) for key, value in record["config"].items()]
    found.append((LOCK, _file_difference(root / LOCK, record["lock"])))
    found += [(name, _file_difference(directory / name, digest)) for name, digest in record["inputs"].items()]
    sources = Sources()
    found += [(" and ".join(step["files"]), _code_difference(sources, root, step)) for step in record["steps"]]
    written = {Path(name).name: digest for name, digest in record.get("outputs", {}).items()}
    if file is not None and Path(file).name in written:
        found.append(("the file itself", _file_difference(Path(file), written[Path(file).name])))
    return found


def _config_difference(config, key, value):
    for name in key.split("."):
        if not isinstance(config, dict) or name not in config:
            return f"is gone, was {value}"
        config = config[name]
    return None if config == value else f"is {config}, was {value}"


def _file_difference(path, digest):
    if not path.is_file():
        return "is missing"
    return None if digest_of(path) == digest else "has changed"


def _code_difference(sources, root, step):
    files = [root / name for name in step["files"]]
    missing = [name for name, path in zip(step["files"], files, strict=True) if not path.is_file()]
    if missing:
        return f"{', '.join(missing)} is missing"
    try:
        same = sources.fingerprint(*files, modules=step["modules"]) == step["fingerprint"]
    except ValueError as error:
        return str(error)
    return None if same else "or library code that it uses has changed"


def report(path, record: dict, found) -> list[str]:
    """Lines to read: what made the file, then what still matches and what does not."""
    said = [f"{path}: {record['figure']}"]
    said += [f"  method: {step['method']} ({step['digits']} digits)" for step in record["steps"]]
    said += ["  drawn with: " + ", ".join(f"{name} {version}" for name, version in record["versions"].items())]
    if "commit" in record:
        made_from = f"{record['commit']}, {record['tree']} tree" if record["commit"] else "not known, made without git"
        said.append(f"  commit: {made_from}")
    if "seconds" in record:
        said.append(f"  run time: {record['seconds']} s")
    said += [f"  {name}: {difference or 'same'}" for name, difference in found]
    wrong = sum(difference is not None for _, difference in found)
    return [*said, f"{wrong} difference(s): the tree has changed since." if wrong else "The file matches the tree."]


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m vibroimpact_pipeline.provenance.verify",
        description="Where a figure's file comes from, and whether it still matches the tree.",
        epilog="Exit status: 0 it matches, 1 it does not, 2 the file does not tell.",
    )
    parser.add_argument("file", type=Path, help="a figure's file, such as results/figures/fig10_06.png")
    parser.add_argument("--root", type=Path, help="the checkout (default: this directory, else that of the library)")
    parser.add_argument("--directory", type=Path, help="where the build worked (default: --root, else this directory)")
    parser.add_argument("--json", action="store_true", help="print the record as JSON and compare nothing")
    given = parser.parse_args(arguments)
    try:
        record = provenance(given.file)
        if given.json:
            print(json.dumps(record, indent=2))
            return 0
        here = Path()
        root = given.root or (here if (here / LOCK).is_file() else ROOT)
        found = differences(record, root, given.file, given.directory or given.root or here)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    print(*report(given.file, record, found), sep="\n")
    return int(any(difference is not None for _, difference in found))


if __name__ == "__main__":
    sys.exit(main())
