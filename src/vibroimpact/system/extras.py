"""Check that optional dependencies are installed."""

from importlib.util import find_spec


def need(extra: str, *packages: str) -> None:
    """Raise an error that names the pip command for the group `extra`, unless all `packages` are installed.

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
