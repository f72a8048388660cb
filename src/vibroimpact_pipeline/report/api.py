"""Pages of the library's modules, filled by Sphinx from their docstrings."""

import re
from pathlib import Path

import vibroimpact

LIBRARY = Path(vibroimpact.__file__).parent
MODULE = """{name}
{line}

.. automodule:: {name}
   :members:
"""
IMPORTED = "   :imported-members:\n"
"""For the first module, whose names are loaded on first use."""


def documented(left_out) -> list[str]:
    """Return the names of the library's modules except those that match a pattern; nothing is imported."""
    files = (path.relative_to(LIBRARY.parent).with_suffix("") for path in sorted(LIBRARY.rglob("*.py")))
    names = [".".join(file.parts).removesuffix(".__init__") for file in files]
    return [name for name in names if not any(re.fullmatch(pattern, name) for pattern in left_out)]


def write(folder: Path, names) -> list[str]:
    """Write sources for Sphinx into folder/api, a page for each part of the library; return the names of the pages."""
    (folder / "api").mkdir()
    pages = {}
    for name in names:
        part = ".".join(name.split(".")[:2])
        text = MODULE.format(name=name, line=("-" if part in pages else "=") * len(name))
        pages[part] = pages.get(part, "") + text + IMPORTED * (name == vibroimpact.__name__) + "\n"
    for part, text in pages.items():
        (folder / f"api/{part}.rst").write_text(text, encoding="utf-8")
    return list(pages)
