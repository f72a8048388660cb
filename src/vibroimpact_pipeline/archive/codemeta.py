"""CITATION.cff and pyproject.toml -> codemeta.json, the same for catalogues of software (codemeta.github.io)."""

import json

from vibroimpact_pipeline.archive.citation import Citation, citation
from vibroimpact_pipeline.checkout import ROOT

CODEMETA = "codemeta.json"
SPDX = "https://spdx.org/licenses/"


def codemeta(cited: Citation) -> dict:
    """The entries of codemeta.json."""
    project, chapter = cited.project, cited.chapter()
    return {
        "@context": "https://w3id.org/codemeta/3.0",
        "type": "SoftwareSourceCode",
        "name": project["name"],
        "description": project["description"],
        "version": project["version"],
        "license": SPDX + project["license"],
        "author": [_without_at(author) for author in cited.authors()],
        "keywords": project["keywords"],
        "programmingLanguage": "Python",
        "runtimePlatform": f"Python {project['requires-python']}",
        "operatingSystem": "Linux",
        "softwareRequirements": project["dependencies"],
        "referencePublication": {"type": "CreativeWork", "name": chapter["title"], "position": chapter["section"]},
        "readme": project["readme"],
    }


def _without_at(author):
    """CodeMeta 3.0 writes type and id."""
    return {name.removeprefix("@"): value for name, value in author.items()}


def page(cited: Citation) -> str:
    """The text of codemeta.json."""
    return json.dumps(codemeta(cited), indent=2, ensure_ascii=False) + "\n"


def main() -> None:
    """Write codemeta.json of the checkout."""
    (ROOT / CODEMETA).write_text(page(citation(ROOT)), encoding="utf-8")


if __name__ == "__main__":
    main()
