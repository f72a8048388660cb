"""Display results on one line."""

from collections.abc import Iterable

import numpy as np


class Representation:
    """Base class of results; its `repr` shows the texts returned by `_shown`."""

    def _shown(self) -> dict[str, str]:
        """Return a dictionary from the names of the displayed attributes to short texts of their values."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={text}' for name, text in self._shown().items())})"


class Found(list):
    """List of results that knows the column names of its table, so that an empty list gives a table with columns."""

    def __init__(self, results: Iterable, columns: Iterable[str]):
        super().__init__(results)
        self.columns = tuple(columns)


def brief(numbers) -> str:
    """Return a number or an array of shape (n,) as text, with four significant digits per number."""
    if np.ndim(numbers) == 0:
        return f"{numbers:.4g}"
    return f"({', '.join(f'{number:.4g}' for number in numbers)})"
