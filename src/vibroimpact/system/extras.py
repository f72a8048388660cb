"""What only parts of the library need beside NumPy, SciPy and Numba: packages installed by an extra."""

from importlib.util import find_spec


def need(extra: str, *packages: str) -> None:
    """Make sure that the packages of an extra are there.

    Raises:
        ModuleNotFoundError: some are not; the message names them and the command that brings them.
    """
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ModuleNotFoundError(
            f"this part of vibroimpact needs {' and '.join(missing)}: pip install '.[{extra}]'",
            name=missing[0],
        )
