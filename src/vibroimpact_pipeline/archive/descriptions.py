"""What is said of each file of an archive: the cards of the figures and the data dictionary tell."""

from dataclasses import dataclass, field
from pathlib import Path

from vibroimpact_pipeline.archive.content import CHECKSUMS, SNAKEMAKE, file_of_record
from vibroimpact_pipeline.data_dictionary import File, files

FORMATS = {
    ".cff": "application/yaml",
    ".css": "text/css",
    ".csv": "text/csv",
    ".html": "text/html",
    ".ipynb": "application/x-ipynb+json",
    ".js": "text/javascript",
    ".json": "application/json",
    ".md": "text/markdown",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".py": "text/x-python",
    ".pyi": "text/x-python",
    ".rst": "text/x-rst",
    ".sh": "text/x-shellscript",
    ".svg": "image/svg+xml",
    ".toml": "application/toml",
    ".tsv": "text/tab-separated-values",
    ".yaml": "application/yaml",
    ".yml": "application/yaml",
}
"""Formats by the end of a name; a list of its own, since that of the system is another on every machine."""
PLAIN, PICTURES = "text/plain", (".png", ".pdf", ".svg")
SAID = {
    "CITATION.cff": "How to cite this software.",
    "LICENSE": "The licence.",
    "README.md": "What this is, how to build it, and how to run this archive.",
    "codecheck.yml": "Every figure with the command that makes it (CODECHECK).",
    "codemeta.json": "The software in the words of CodeMeta.",
    "config/config.yaml": "Everything that can be set; the results were made with it.",
    "docs/claims.yaml": "The claims of the chapter that can be checked.",
    "environment.lock": "Every package of the environment, with hashes.",
    "results/claims.json": "The claims of the chapter with their verdicts and the numbers behind them.",
    "results/claims.md": "The same claims, to read.",
}
"""Files that stand for themselves."""


@dataclass(frozen=True)
class Descriptions:
    """What is said of files: `texts` of each figure, see `report.figure_texts`; `data`, docs/data.yaml."""

    texts: dict[str, dict]
    data: dict
    _kinds: list[File] = field(init=False)

    def __post_init__(self):
        object.__setattr__(self, "_kinds", files(self.texts, self.data))

    def of(self, name: str) -> dict[str, str]:
        """Name, format and, where there is one, description of a file, by its path."""
        path = Path(name)
        said = {"name": name, "encodingFormat": FORMATS.get(path.suffix, PLAIN)}
        if path.is_relative_to(SNAKEMAKE):
            about = file_of_record(path.relative_to(SNAKEMAKE))
            return {"name": f"Record of {about}", "encodingFormat": FORMATS[".json"]} | {
                "description": f"What Snakemake made {about} of."
            }
        if path.is_relative_to(CHECKSUMS):
            return said | {"description": f"SHA-256 of {path.relative_to(CHECKSUMS).with_suffix('')}."}
        description = SAID.get(name) or self._of_data(name) or self._of_figure(path)
        return said | ({"description": description} if description else {})

    def _of_figure(self, path):
        text = self.texts.get(path.stem, {})
        said = [text.get("title"), text.get("alt") if path.suffix in PICTURES else None]
        return " ".join(f"{part.rstrip('.')}." for part in said if part) if path.parts[0] == "results" else None

    def _of_data(self, name):
        return next((kind.about for kind in self._kinds if kind.has(name)), None)
