"""Set the version in all files that contain it; for a release, also set its date and that of the changelog entry."""

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
"""Patterns and replacements by file; each pattern occurs once."""


def changes(text: str, version: str) -> str:
    """Return the entries of a version (or "Unreleased") in a changelog, without heading."""
    return text.partition(f"## [{version}]")[2].partition("\n")[2].partition("\n## [")[0].strip()


def dated(text: str, version: str, date: datetime.date) -> str:
    """Return a changelog with the unreleased changes moved to a version.

    Raises:
        ValueError: if there are no unreleased changes, or the version already exists.
    """
    if f"## [{version}]" in text:
        raise ValueError(f"CHANGELOG.md: version {version} already exists")
    if not changes(text, "Unreleased"):
        raise ValueError("CHANGELOG.md: no entries in [Unreleased]")
    return text.replace(NEXT, f"{NEXT}\n## [{version}] - {date}\n", 1)


def replaced(text: str, places: list, words: dict) -> str:
    """Return a text with each pattern replaced.

    Raises:
        ValueError: if a pattern does not occur exactly once.
    """
    for pattern, new in places:
        text, count = re.subn(pattern, lambda _, new=new: new.format(**words), text, flags=re.MULTILINE)
        if count != 1:
            raise ValueError(f"{pattern}: found {count} times, expected once")
    return text


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("version", help="for example 0.2.0, or 0.3.0.dev0 after a release")
    parser.add_argument("--changes", action="store_true", help="only print the changes of the version")
    given = parser.parse_args(arguments)
    version, date = given.version, datetime.datetime.now(datetime.UTC).date()
    if not re.fullmatch(r"\d+\.\d+\.\d+(\.dev\d+)?", version):
        parser.error(f"version: {version!r}, expected a version such as 0.2.0 or 0.3.0.dev0")
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
        print(f"Check `git diff`, then run: {commands}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
