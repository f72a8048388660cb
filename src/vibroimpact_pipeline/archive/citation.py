"""What is cited: CITATION.cff and pyproject.toml, which must say the same."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import yaml

CITATION, PROJECT = "CITATION.cff", "pyproject.toml"
SAME = ("version", "license", "keywords")
"""What both files say."""


@dataclass(frozen=True)
class Citation:
    """What is to be cited: `cff`, the entries of CITATION.cff; `project`, the table of pyproject.toml."""

    cff: dict
    project: dict

    def authors(self) -> list[dict]:
        """Authors as JSON-LD: a person has a family name, all else is an organization."""
        return [_author(entry) for entry in self.cff["authors"]]

    def chapter(self) -> dict:
        """The work that is replicated, as CITATION.cff refers to it."""
        return self.cff["references"][0]


def citation(root) -> Citation:
    """What the checkout at root says of itself.

    Raises:
        ValueError: its two files say different things.
    """
    cff = yaml.safe_load((Path(root) / CITATION).read_text(encoding="utf-8"))
    project = tomllib.loads((Path(root) / PROJECT).read_text(encoding="utf-8"))["project"]
    for name in SAME:
        if cff.get(name) != project.get(name):
            said = f"{CITATION} says {cff.get(name)!r}, {PROJECT} {project.get(name)!r}"
            raise ValueError(f"{name}: {said}. Make them agree.")
    return Citation(cff, project)


def _author(entry):
    where = {"@id": entry["orcid"]} if "orcid" in entry else {}
    if "family-names" not in entry:
        return {"@type": "Organization", **where, "name": entry["name"]}
    given, family = entry.get("given-names", ""), entry["family-names"]
    return {"@type": "Person", **where, "givenName": given, "familyName": family, "name": f"{given} {family}".strip()}
