"""Representation of results: one line in a console, a small table in a notebook."""

from collections.abc import Iterable
from html import escape

import numpy as np


class Representation:
    """Base class of results; `repr` and the HTML table show the texts of `_shown`."""

    def _shown(self) -> dict[str, str]:
        """Return short texts by attribute name."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={text}' for name, text in self._shown().items())})"

    def _repr_html_(self) -> str:
        rows = (f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in self._shown().items())
        return f"<table><caption>{type(self).__name__}</caption>{''.join(rows)}</table>"


class Found(list):
    """List of results that keeps the columns of its table when it is empty (see `to_frame`)."""

    def __init__(self, results: Iterable, columns: Iterable[str]):
        super().__init__(results)
        self.columns = tuple(columns)


def brief(numbers) -> str:
    """Return a number or an array (n,) with four digits each."""
    if np.ndim(numbers) == 0:
        return f"{numbers:.4g}"
    return f"({', '.join(f'{number:.4g}' for number in numbers)})"
