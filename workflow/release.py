"""Write a version into every file that bears it; for a release, date it and the changes since the last one."""

import argparse
import datetime
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
NEXT = "## [Unreleased]\n"
PLACES = {
    "pyproject.toml": [(r'^version = ".*"$', 'version = "{version}"')],
    "CITATION.cff": [(r"^version: .*(\ndate-released: .*)?$", "version: {version}{released}")],
    "CITATION.bib": [
        (r"^  version = .*$", "  version = {{{version}}},"),
        (r"^  year = .*$", "  year = {{{date:%Y}}},"),
    ],
    ".zenodo.json": [(r'^  "version": ".*",$', '  "version": "{version}",')],
    "codemeta.json": [(r'^  "version": ".*",$', '  "version": "{version}",')],
}
"""Pattern and replacement, once in each file."""


def changes(text: str, version: str) -> str:
    """Return the entries of a version in a changelog, or "Unreleased", without heading."""
    return text.partition(f"## [{version}]")[2].partition("\n")[2].partition("\n## [")[0].strip()


def dated(text: str, version: str, date: datetime.date) -> str:
    """Return a changelog whose unreleased changes are those of a version.

    Raises:
        ValueError: there are none, or the version is there.
    """
    if f"## [{version}]" in text:
        raise ValueError(f"CHANGELOG.md: {version} has been released")
    if not changes(text, "Unreleased"):
        raise ValueError("CHANGELOG.md: nothing under [Unreleased]")
    return text.replace(NEXT, f"{NEXT}\n## [{version}] - {date}\n", 1)


def replaced(text: str, places: list, words: dict) -> str:
    """Return a text with each pattern replaced.

    Raises:
        ValueError: a pattern that does not occur exactly once.
    """
    for pattern, new in places:
        text, count = re.subn(pattern, lambda _, new=new: new.format(**words), text, flags=re.MULTILINE)
        if count != 1:
            raise ValueError(f"{pattern} occurs {count} times, not once")
    return text


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("version", help="as 0.2.0; after a release the next one, as 0.3.0.dev0")
    parser.add_argument("--changes", action="store_true", help="write nothing; print the changes of a version")
    given = parser.parse_args(arguments)
    version, date = given.version, datetime.datetime.now(datetime.UTC).date()
    if not re.fullmatch(r"\d+\.\d+\.\d+(\.dev\d+)?", version):
        parser.error(f"version: {version!r} is not like 0.2.0 or 0.3.0.dev0")
    log = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    if given.changes:
        print(changes(log, version))
        return 0
    final = ".dev" not in version
    words = {"version": version, "date": date, "released": f'\ndate-released: "{date}"' if final else ""}
    try:
        new = {name: replaced((ROOT / name).read_text(encoding="utf-8"), PLACES[name], words) for name in PLACES}
        if final:
            new["CHANGELOG.md"] = dated(log, version, date)
    except ValueError as error:
        sys.exit(str(error))
    for name, text in new.items():
        (ROOT / name).write_text(text, encoding="utf-8")
    if final:
        commands = f'git commit -am "Version {version}" && git tag v{version} && git push origin main v{version}'
        print(f"Look at `git diff`, then: {commands}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
