"""Check that optional dependencies are installed."""

from importlib.util import find_spec


def need(extra: str, *packages: str) -> None:
    """Raise an error unless all `packages` are installed.

    The message gives the pip command that installs `extra`, one of the groups of optional dependencies in
    pyproject.toml.

    Raises
    ------
    ModuleNotFoundError
        If a package is missing.
    """
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ModuleNotFoundError(
            f"this part of vibroimpact needs {' and '.join(missing)}: pip install '.[{extra}]'",
            name=missing[0],
        )
