"""The docstrings of the library -> HTML pages that read offline, by pdoc."""

import re
from importlib import import_module
from pathlib import Path

import vibroimpact
from vibroimpact_pipeline.report.policy import guarded

LIBRARY = Path(vibroimpact.__file__).parent


def documented(left_out) -> list[str]:
    """Names of the library's modules, but for those that a pattern describes; nothing is imported."""
    files = (path.relative_to(LIBRARY.parent).with_suffix("") for path in sorted(LIBRARY.rglob("*.py")))
    names = [".".join(file.parts).removesuffix(".__init__") for file in files]
    return [name for name in names if not any(re.fullmatch(pattern, name) for pattern in left_out)]


def write(folder, names: list[str], templates) -> None:
    """Write a page for each module; of its members those that are public.

    Args:
        names: of the modules; links lead to these alone.
        templates: a folder with what replaces parts of pdoc's pages.
    """
    from pdoc.doc import Module  # here, because reading the rules needs `documented` alone
    from pdoc.render import configure, html_module

    configure(docformat="google", search=False, show_source=False, template_directory=Path(templates))
    for name in vibroimpact.__all__:
        getattr(vibroimpact, name)  # loaded on first use; pdoc shows what is there
    modules = {name: Module(import_module(name)) for name in names}
    for name, module in modules.items():
        page = Path(folder, *name.split(".")).with_suffix(".html")
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(guarded(html_module(module, modules)), encoding="utf-8")
