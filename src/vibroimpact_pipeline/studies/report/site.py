"""Build the site of the report with Sphinx, and its article as PDF with pandoc and Typst, without network access."""

import io
import re
import shutil
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml
from docutils import nodes

import vibroimpact
from vibroimpact.system.extras import need
from vibroimpact_pipeline.code import is_source
from vibroimpact_pipeline.html.mathematics import STYLE, mathml
from vibroimpact_pipeline.html.policy import policy
from vibroimpact_pipeline.studies.report.pages import anchor

need("report", "pypandoc", "sphinx", "typst")

import pypandoc  # noqa: E402 (after the dependency check)
import typst  # noqa: E402
from sphinx import addnodes  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402
from sphinx.util.docutils import docutils_namespace  # noqa: E402

ARTICLE = "findings"
NOTICE = (
    "The parameters of this build differ from those of the chapter. Figures and tables show this build; claims that "
    "depend on the parameters were not judged, and the texts refer to the parameters of the chapter. Differences: "
)
THEME_SCRIPT = '\n      document.body.dataset.theme = localStorage.getItem("theme") || "auto";\n    '
"""Inline script of the theme, which the content security policy must allow."""
DOCUMENTS = "docs", "docs/studies"
"""Folders of documents; on the site all documents are in one folder."""
ELSEWHERE = re.compile(r"(?<=\]\()(?:studies|\.\.|(?:\.\./)+report/pages)/(?=\w+\.md)")
"""Matches the path to another folder in a link between documents."""
EQUATION = re.compile(r"\((10\.\d+)\)")
NAMES = (nodes.title, nodes.reference, nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.raw)
"""Types of nodes in which equation numbers are not linked to their explanations."""
OF_PAGE = re.compile(r"^(?!.*docstring of|.*<unknown>|.*more than one target).*(WARNING|ERROR)")
"""Matches Sphinx warnings and errors, except those about docstrings and about names that are documented twice."""
SPHINX = {
    "extensions": ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", __name__],
    "myst_enable_extensions": ["dollarmath"],
    "myst_disable_syntax": ["html_block", "html_inline"],  # HTML in documents is shown as text
    "myst_heading_anchors": 4,
    "myst_url_schemes": {"beside": "{{path}}"},  # links to files of the site begin with "beside:"
    "html_math_renderer": "mathml",
    "html_theme": "furo",
    "html_css_files": ["mathematics.css", "style.css", "play.css"],
    "html_js_files": [("scroll.js", {"defer": "defer"})],
    "html_show_search_summary": False,  # browsers cannot load the texts of summaries from local files
    "html_show_sourcelink": False,
    "html_copy_source": False,
    "html_use_index": False,
    "html_domain_indices": False,
    "html_permalinks": False,
    "default_role": "literal",
    "smartquotes": False,  # quotation marks are shown as they are written
    "autodoc_member_order": "bysource",
    "python_use_unqualified_type_names": True,
}


def write(folder, root, pages, built: str, departures=()) -> None:
    """Write the site and the PDF into a folder that already contains figures, data and notebooks.

    `built` is a text that names the commit of the build. Every page shows `departures`, the differences from the
    chapter's parameters.

    Raises
    ------
    RuntimeError
        If Sphinx reports a warning on a page. Warnings on docstrings are ignored.
    """
    notice = NOTICE + "; ".join(departures) if departures else ""
    write_site(Path(folder), Path(root), pages, built, notice)
    write_article(Path(folder), Path(root), pages, built, notice)


def write_site(folder: Path, root: Path, pages, built: str, notice: str = "") -> None:
    """Write the documents, the pages of report/pages and the API pages as HTML."""
    settings, warnings = yaml.safe_load((root / "report/report.yaml").read_text(encoding="utf-8")), io.StringIO()
    with TemporaryDirectory() as scratch:
        scratch, static = Path(scratch), Path(scratch) / "static"
        for path in (path for folder in DOCUMENTS for path in (root / folder).glob("[!.]*.*")):
            shutil.copy(path, scratch)
        for name in pages.names:
            (scratch / f"{name}.md").touch()
        (scratch / "figures").symlink_to(folder.resolve() / "figures")
        shutil.copytree(root / "report/live", static, ignore=shutil.ignore_patterns(".*"))
        (static / "mathematics.css").write_text(STYLE, encoding="utf-8")
        write_library(scratch / "api", settings["left_out"])
        options = SPHINX | {
            "project": settings["title"],
            "html_title": settings["title"],
            "html_static_path": [str(static)],
            "templates_path": [str(root / "report/templates")],
            "html_context": {"built": escape(built)},
            "html_theme_options": {"announcement": escape(notice), "top_of_page_buttons": []},
        }
        with docutils_namespace():
            app = Sphinx(
                scratch, None, folder, scratch / "doctrees", "html", options, status=None, warning=warnings, parallel=2
            )
            app.connect("source-read", lambda app, name, source: fill(pages, name, source))
            app.connect("doctree-read", lambda app, tree: explain(app, tree, settings["equations"]))
            app.build()
    if of_pages := [line for line in warnings.getvalue().splitlines() if OF_PAGE.search(line)]:
        raise RuntimeError(f"Sphinx: {of_pages[0]}")


def write_library(folder: Path, left_out) -> None:
    """Write a Sphinx source for each part of the library, without modules that match a pattern in `left_out`."""
    library, parts = Path(vibroimpact.__file__).parent, {}
    for path in sorted(path for path in library.rglob("*.py") if is_source(path.relative_to(library))):
        name = ".".join(path.relative_to(library.parent).with_suffix("").parts).removesuffix(".__init__")
        if not any(re.fullmatch(pattern, name) for pattern in left_out):
            parts.setdefault(".".join(name.split(".")[:2]), []).append(name)
    folder.mkdir()
    for part, names in parts.items():
        sections = (
            f"{name}\n{('-' if n else '=') * len(name)}\n\n.. automodule:: {name}\n   :members:\n"
            for n, name in enumerate(names)
        )
        (folder / f"{part}.rst").write_text("\n".join(sections), encoding="utf-8")


def fill(pages, name: str, source: list[str]) -> None:
    """Insert numbers and figures of this build into the source of a page when Sphinx reads the page.

    `source` is a list with one entry, the source. The new source replaces this entry.
    """
    if name in pages.names:
        source[0] = pages.filled(name)
    elif not name.startswith("api/"):
        source[0] = pages.with_numbers(ELSEWHERE.sub("", source[0]))


def explain(app, tree, equations: dict) -> None:
    """Link equation numbers on a page to their explanations, and add the numbers to the search index."""
    named, page = set(), app.builder.get_relative_uri(app.env.docname, "numbers")
    for text in list(tree.findall(nodes.Text)):
        if EQUATION.search(text) and not any(isinstance(node, NAMES) for node in _ancestors(text)):
            parts = EQUATION.split(text)
            named |= set(parts[1::2])
            links = [
                nodes.reference("", f"({part})", refuri=f"{page}#equation-{anchor(part)}", reftitle=equations[part])
                for part in parts[1::2]
            ]
            text.parent.replace(text, [links[n // 2] if n % 2 else nodes.Text(part) for n, part in enumerate(parts)])
    tree.append(addnodes.index(entries=[("single", f"({part})", "", "", None) for part in sorted(named)]))


def _ancestors(node):
    """Yield the nodes that contain a node, from the inside out."""
    while node := node.parent:
        yield node


def write_article(folder: Path, root: Path, pages, built: str, notice: str = "") -> None:
    """Write docs/studies/findings.md as PDF, with links to the pages of the site."""
    article = ELSEWHERE.sub("", (root / f"docs/studies/{ARTICLE}.md").read_text(encoding="utf-8"))
    text = pages.with_numbers(article + pages.plates(), paper=True)
    metadata = {"date": f"Built from {built}."} | ({"abstract": notice} if notice else {})
    options = ["--standalone", "--shift-heading-level-by=-1", "--variable=papersize=a4", "--variable=fontsize=10pt"]
    options += [f"--metadata={name}={value}" for name, value in metadata.items()]
    text = re.sub(r"\]\((\w+)\.md", r"](\1.html", text)
    source = pypandoc.convert_text(text, "typst", "markdown+gfm_auto_identifiers-fancy_lists", options)
    source = "#set figure(numbering: none)\n" + source  # captions of the chapter's figures already have numbers
    typst.compile(source.encode(), output=folder / f"{ARTICLE}.pdf", root=folder, ignore_system_fonts=True)


def setup(app) -> dict:
    """Set up this module as a Sphinx extension.

    The extension renders formulas as MathML, escapes vertical bars in docstrings, and adds the content security policy.
    """
    app.add_html_math_renderer("mathml", (_formula, None), (_formula, None))
    app.connect("autodoc-process-docstring", _with_bars)
    app.connect("html-page-context", _with_policy)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _formula(writer, node):
    writer.body.append(mathml(node.astext(), display=isinstance(node, nodes.math_block)))
    raise nodes.SkipNode


def _with_bars(app, what, name, obj, options, lines):
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _with_policy(app, page, template, context, tree):
    context["metatags"] = (context.get("metatags") or "") + policy(THEME_SCRIPT)
