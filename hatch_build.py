"""Metadata that hatchling takes from elsewhere when it builds: the long description and the project's addresses.

Where the project lives is said once, as `repository-code` in CITATION.cff; while it is not, there are no addresses.
"""

import re
from pathlib import Path

from hatchling.metadata.plugin.interface import MetadataHookInterface

LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!\w+:|#)([^)]+)\)")
"""A relative link or picture of Markdown: mark of a picture, text, target."""
REPOSITORY = re.compile(r'^repository-code: "?([^"\s]+)"?$', re.MULTILINE)


def long_description(readme: str, repository: str | None, version: str) -> str:
    """Return a README whose relative links lead into the repository at a version; without one, only their texts."""

    def absolute(link):
        picture, text, target = link.groups()
        kind = "raw" if picture else "blob"
        return f"{picture}[{text}]({repository}/{kind}/v{version}/{target})" if repository else text

    return LINK.sub(absolute, readme)


class Metadata(MetadataHookInterface):
    """Add the long description and the addresses of the project to its metadata."""

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
