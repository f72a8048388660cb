"""Optional dependencies: packages of an extra, needed by parts of the library only."""

from importlib.util import find_spec


def need(extra: str, *packages: str) -> None:
    """Raise an error that names the install command if packages of an extra are missing.

    Raises
    ------
    ModuleNotFoundError
        If some are not; the message names them and the command that brings them.
    """
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ModuleNotFoundError(
            f"this part of vibroimpact needs {' and '.join(missing)}: pip install '.[{extra}]'",
            name=missing[0],
        )
