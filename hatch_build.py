"""Add metadata from other files when hatchling builds the project: long description and web addresses.

The address of the repository is the entry `repository-code` of CITATION.cff. Without it, no addresses are added.
"""

import re
from pathlib import Path

from hatchling.metadata.plugin.interface import MetadataHookInterface

LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!\w+:|#)([^)]+)\)")
"""Matches a relative link or picture in Markdown; the groups are the "!" of a picture, the text and the target."""
REPOSITORY = re.compile(r'^repository-code: "?([^"\s]+)"?$', re.MULTILINE)


def long_description(readme: str, repository: str | None, version: str) -> str:
    """Return a README with absolute links in place of relative ones, or with their texts if `repository` is None.

    The links lead to the files of `version` in the repository.
    """

    def absolute(link):
        picture, text, target = link.groups()
        kind = "raw" if picture else "blob"
        return f"{picture}[{text}]({repository}/{kind}/v{version}/{target})" if repository else text

    return LINK.sub(absolute, readme)


class Metadata(MetadataHookInterface):
    """Add the long description and the web addresses of the project to the metadata."""

    def update(self, metadata):
        root = Path(self.root)
        found = REPOSITORY.search((root / "CITATION.cff").read_text(encoding="utf-8"))
        repository = found and found[1].rstrip("/")
        readme = (root / "README.md").read_text(encoding="utf-8")
        text = long_description(readme, repository, metadata["version"])
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
        metadata["urls"] = (
            {"Repository": repository, "Changes": f"{repository}/blob/main/CHANGELOG.md"} if found else {}
        )
