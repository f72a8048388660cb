"""The parameters of a notebook: a name that it does not know is an error, whoever sets it."""

import ast

FIRST = "figure = "
"""Begins the cell with the parameters of a notebook."""
GIVEN = "# Parameters"
"""Begins the cell with those that papermill sets, of which it only warns where the notebook has no such name."""
OF_ALL = ("figure", "alt", "case", "inputs")


def refuse_unknown(shell, known) -> None:
    """Check the names that the cells of parameters assign, where they were run last.

    Parameters
    ----------
    shell
        The running IPython, which keeps the sources of cells.
    known
        Names of the parameters, but for those of all notebooks.

    Raises
    ------
    ValueError
        If others are assigned.
    """
    cells = shell.user_ns["In"]
    last = max(number for number, source in enumerate(cells) if source.startswith(FIRST))
    given = [ast.parse(source).body for source in cells[last:] if source.startswith((FIRST, GIVEN))]
    assigned = [node.targets[0].id for body in given for node in body if isinstance(node, ast.Assign)]
    if unknown := [name for name in assigned if name not in (*OF_ALL, *known)]:
        raise ValueError(f"parameters: unknown {', '.join(unknown)}; this notebook has {', '.join(known)}")
