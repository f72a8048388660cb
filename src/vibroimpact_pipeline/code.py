"""Compute the fingerprint of the code of a job: its script, the imported modules, and their data files.

The `params` of a rule contain the fingerprint. If the fingerprint changes, Snakemake reruns the job. If only comments
and docstrings of modules change, Snakemake reruns only the report.
"""

import ast
import hashlib
import json
from functools import cache
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[1]
"""Folder that contains the packages, `src` of the checkout."""
ROOT = SOURCES.parent
"""Root of the checkout."""
PACKAGES = "vibroimpact", "vibroimpact_pipeline"
CODE = ".py", ".pyi", ".typed"
DOCUMENTED = ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef


def code_files(*roots: str) -> list[Path]:
    """Return the sorted list of the files on which a job depends.

    Each root is the name of a module, or the path of a file or folder in the checkout. The list contains the files of
    the roots and all modules of this project that these files import, directly or through other modules. The list also
    contains all data files in the folders of the modules.
    """
    found, pending = set(), [path for root in roots for path in _paths(root)]
    while pending:
        path = pending.pop()
        if path in found:
            continue
        found.add(path)
        if path.suffix in (".py", ".ipynb"):
            _, imported = _parsed(path, path.stat().st_ctime_ns)
            pending += [file for module in imported for file in module_files(module)]
    return sorted(found)


def fingerprint(*roots: str) -> str:
    """Return the fingerprint of the files that `code_files` returns.

    Comments and docstrings of a Python file have no effect on the fingerprint. There is one exception: if a root is a
    folder, the fingerprint depends on the full text of each file in this folder.
    """
    digest, listed = hashlib.sha256(), {path for root in roots if (ROOT / root).is_dir() for path in _paths(root)}
    for path in code_files(*roots):
        if path in listed or path.suffix != ".py":
            content = path.read_bytes()
        else:
            content = _parsed(path, path.stat().st_ctime_ns)[0].encode()
        digest.update(f"{path.relative_to(ROOT)}\n".encode() + content)
    return digest.hexdigest()[:16]


def change_times(*roots: str) -> dict[Path, int]:
    """Return the time of the last change (ctime) [ns] of each file that `code_files` returns.

    If an older version of a file is restored with its modification time (mtime), the ctime still changes.
    """
    return {path: path.stat().st_ctime_ns for path in code_files(*roots)}


def _paths(root: str) -> list[Path]:
    """Return the files of one root, without the modules that these files import."""
    if root.split(".")[0] in PACKAGES:
        return module_files(root)
    top = ROOT / root
    if not top.exists():
        raise FileNotFoundError(f"{root}: not found, expected a module of this project or a file of the checkout")
    found = [top] if top.is_file() else (path for path in top.rglob("*") if is_source(path.relative_to(top)))
    return [path for path in found if path.is_file()]


def is_source(path: Path) -> bool:
    """Return False if a part of `path` starts with a dot or is __pycache__, and else True.

    `path` is relative to a folder with source files.
    """
    return not any(name.startswith(".") or name == "__pycache__" for name in path.parts)


@cache
def modules() -> dict[str, Path]:
    """Return a mapping from the name of each module of this project to the file of the module."""
    files = [path for package in PACKAGES for path in (SOURCES / package).rglob("*.py")]
    names = {path: path.relative_to(SOURCES) for path in files}
    return {
        ".".join(name.with_suffix("").parts).removesuffix(".__init__"): path
        for path, name in names.items()
        if is_source(name)
    }


@cache
def module_files(name: str) -> list[Path]:
    """Return the files of a module and of its parent packages, and the data files in the folder of the module."""
    if name not in modules():
        return []
    parts = name.split(".")
    around = [modules()[".".join(parts[:depth])] for depth in range(1, len(parts) + 1)]
    beside = [path for path in around[-1].parent.iterdir() if path.is_file() and path.suffix not in CODE]
    return [*around, *(path for path in beside if is_source(path.relative_to(SOURCES)))]


@cache
def _parsed(path: Path, time: int) -> tuple[str, set[str]]:
    """Return the code of a file without comments and docstrings, and the project's modules that the file imports.

    `time` is the ctime of the file. If the ctime has changed since an earlier call, the file is parsed again.
    """
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    tree, names = ast.parse(text), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return ast.dump(tree), names & modules().keys()


def changed(code: dict) -> bool:
    """Return True if the code of a job has changed since `code_of` returned `code`."""
    return fingerprint(*code["of"]) != code["fingerprint"]


def code_of(*roots: str) -> dict:
    """Return the value of `params.code` of a rule: the roots (see `code_files`) and their `fingerprint`."""
    return {"of": sorted(roots), "fingerprint": fingerprint(*roots)}
