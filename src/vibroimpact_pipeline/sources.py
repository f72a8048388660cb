"""Which source files a piece of code depends on, and a fingerprint of their content.

A result is out of date when code that made it has changed. Imports tell which code that is, followed through the
library; content is compared, never a date, so a file that was only touched has not changed.
"""

import ast
import hashlib
import json
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import grimp

import vibroimpact
from vibroimpact_pipeline.integrity.stamps import Stamp, stamp

LIBRARY = "vibroimpact"
PACKAGES = (LIBRARY, "vibroimpact_pipeline")
NO_DATA = re.compile(r"\.pyc?$|^\.|~$")
"""Names of code, and of what editors keep beside a file that is open."""
COMPILERS = ("numba", f"{LIBRARY}.exact.engine.code_cache", f"{LIBRARY}.exact.engine.compiled")
"""What a module imports that has something to compile."""


class Sources:
    """The import graph of the library and of the pipeline's own package, read once."""

    def __init__(self):
        self._graph = grimp.build_graph(*PACKAGES, include_external_packages=True, cache_dir=None)
        self._roots = {name: Path(find_spec(name).origin).parent for name in PACKAGES}
        self._read_modules: dict[str, dict[Path, bytes]] = {}
        self.stamps: dict[str, Stamp] = {}
        """Of every file that went into a fingerprint, from just before it was first read."""
        self.files: dict[str, list[str]] = {}
        """The files that went into each fingerprint."""

    def fingerprint(self, *files, modules=()) -> str:
        """Hash of scripts or notebooks, of everything in the packages that they import, and of further modules.

        Args:
            files: Python scripts and notebooks; of a notebook only what its cells say counts. A script may import
                scripts beside it.
            modules: names of modules that are imported by a computed name.

        Raises:
            ValueError: a module does not exist.
        """
        digest = hashlib.sha256()
        codes = self._with_neighbours([Path(file) for file in files])
        read = [*codes]
        for file, code in codes.items():
            digest.update(f"{file.name}\n{code}\n".encode())
        imported = {name for code in codes.values() for name in _imports(code)}
        used = {name for name in imported if self.knows(name)} | set(modules)
        if LIBRARY in imported:
            # Names of the top level are loaded on first use, which the import graph does not show.
            used |= set(vibroimpact._PUBLIC.values())
        for name in self.modules_used(used):
            digest.update(name.encode())
            for path, content in self._contents(name).items():
                digest.update(path.name.encode() + content)
                read.append(path)
        fingerprint = digest.hexdigest()[:16]
        self.files[fingerprint] = [str(path) for path in read]
        return fingerprint

    def modules_used(self, modules) -> list[str]:
        """The given modules and all of the packages' modules that importing them runs, sorted.

        Raises:
            ValueError: a module does not exist.
        """
        for name in modules:
            if not self.knows(name):
                raise ValueError(f"modules: {name!r} is no module of {' or '.join(PACKAGES)}")
        used, asked = set(), set(modules)
        while asked:
            used |= asked | {m for name in asked for m in self._graph.find_upstream_modules(name) if self.knows(m)}
            asked = {package for name in used for package in _packages(name)} - used  # it runs before its modules
        return sorted(used)

    def compiled(self) -> str:
        """Hash of everything that Numba compiles: a compiled function is stale when any of it has changed."""
        known = (name for name in COMPILERS if name in self._graph.modules)
        compiled = {module for name in known for module in self._graph.find_modules_that_directly_import(name)}
        return self.fingerprint(modules=compiled)

    def knows(self, module: str) -> bool:
        """Whether one of the packages has this module."""
        return module.split(".")[0] in PACKAGES and module in self._graph.modules

    def _with_neighbours(self, files) -> dict[Path, str]:
        """Code of the files and of the scripts beside them that they import."""
        codes = {}
        waiting = list(files)
        while waiting:
            file = waiting.pop()
            if file not in codes:
                codes[file] = _code(file, self._read(file).decode())
                neighbours = (file.with_name(f"{name}.py") for name in _imports(codes[file]))
                waiting += [path for path in neighbours if path.is_file()]
        return dict(sorted(codes.items()))

    def _read(self, path):
        self.stamps.setdefault(str(path), stamp(path))
        return path.read_bytes()

    def _contents(self, name) -> dict[Path, bytes]:
        """What the files of a module hold, each read once: many rules depend on it."""
        if name not in self._read_modules:
            self._read_modules[name] = {path: self._read(path) for path in self._files(name)}
        return self._read_modules[name]

    def _files(self, name):
        """The file of a module; for a package also the data files beside it, such as a style sheet."""
        package, *rest = name.split(".")
        path = self._roots[package].joinpath(*rest)
        if not path.is_dir():
            return [path.with_suffix(".py")]
        data = (file for file in path.iterdir() if file.is_file() and not NO_DATA.search(file.name))
        return [path / "__init__.py", *sorted(data)]


@cache
def sources() -> Sources:
    """Those of this process: a workflow may use the pipeline as a module several times."""
    return Sources()


def _packages(module):
    """The packages that a module lies in."""
    parts = module.split(".")
    return [".".join(parts[:n]) for n in range(1, len(parts))]


def _code(file, text):
    if file.suffix != ".ipynb":
        return text
    cells = json.loads(text)["cells"]
    texts = (("".join(cell["source"]), cell["cell_type"]) for cell in cells)
    return "\n".join(text if kind == "code" else repr(text) for text, kind in texts)


@cache
def _imports(code) -> frozenset[str]:
    """Names of all modules that a Python text may import: for `from a import b` both a and a.b."""
    names = set()
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return frozenset(names)
