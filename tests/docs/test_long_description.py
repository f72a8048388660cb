"""Test the long description that a package index shows. An independent Markdown parser finds its links."""

import runpy
import subprocess
import sys
import zipfile
from email.parser import Parser

from markdown_it import MarkdownIt

from pipeline_trees import ROOT, copied

long_description = runpy.run_path(str(ROOT / "hatch_build.py"))["long_description"]
README = (ROOT / "README.md").read_text(encoding="utf-8")
REPOSITORY = "https://code.example.org/somebody/vibroimpact"


def targets(markdown) -> list[tuple[str, str]]:
    """Return kind and target of each link and picture."""
    tokens = [inner for token in MarkdownIt().enable("table").parse(markdown) for inner in token.children or ()]
    attributes = {"link_open": "href", "image": "src"}
    return [(token.type, token.attrs[attributes[token.type]]) for token in tokens if token.type in attributes]


def test_a_wheel_takes_the_address_of_the_repository_from_the_citation(tmp_path):
    tree = copied(ROOT, tmp_path / "tree")
    (tree / "LICENSE").write_bytes((ROOT / "LICENSE").read_bytes())
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert "\nrepository-code:" not in citation, "use the address of CITATION.cff in this test"
    (tree / "CITATION.cff").write_text(f'{citation}repository-code: "{REPOSITORY}"\n', encoding="utf-8")
    subprocess.run([sys.executable, "-m", "hatchling", "build", "-t", "wheel"], cwd=tree.path, check=True)
    with zipfile.ZipFile(next((tree / "dist").glob("*.whl"))) as archive:
        name = next(name for name in archive.namelist() if name.endswith("METADATA"))
        described = Parser().parsestr(archive.read(name).decode())
    assert described["Description-Content-Type"] == "text/markdown"
    assert described.get_payload() == long_description(README, REPOSITORY, described["Version"])
    assert f"Repository, {REPOSITORY}" in described.get_all("Project-URL")


def test_without_a_repository_relative_links_become_plain_text():
    """Relative pictures are removed; absolute links, links within the page and code are kept."""
    readme = "[a](docs/a.md) ![b](b.png) [c](https://example.org) [d](#e) `[f]` `'.[g]'`"
    assert long_description(readme, None, "1") == "a b [c](https://example.org) [d](#e) `[f]` `'.[g]'`"


def test_relative_links_become_addresses_of_files_of_the_version():
    """Pictures are addressed as raw files. All other links are kept."""
    relative = 0
    text = long_description(README, REPOSITORY, "1.2.3")
    for (kind, before), (_, after) in zip(targets(README), targets(text), strict=True):
        if "://" in before:
            assert after == before
        else:
            relative += 1
            assert after == f"{REPOSITORY}/{'raw' if kind == 'image' else 'blob'}/v1.2.3/{before}"
            assert "studies" in before or (ROOT / before.partition("#")[0]).exists()
    assert relative > 15
