"""Check the parameters of a notebook: an unknown name is an error, whether a user or papermill sets it."""

import ast

FIRST = "figure = "
"""Beginning of the cell with the parameters of a notebook."""
GIVEN = "# Parameters"
"""Beginning of the cell with the parameters that papermill sets; for an unknown name, papermill itself only warns."""
OF_ALL = ("figure", "alt", "case", "inputs")


def refuse_unknown(shell, known) -> None:
    """Raise ValueError if a parameter cell of a notebook assigns an unknown name.

    shell: running IPython shell. known: names of the parameters of this notebook. The parameters in OF_ALL are also
    allowed; all notebooks have them.
    """
    cells = shell.user_ns["In"]
    last = max(number for number, source in enumerate(cells) if source.startswith(FIRST))
    given = [ast.parse(source).body for source in cells[last:] if source.startswith((FIRST, GIVEN))]
    assigned = [node.targets[0].id for body in given for node in body if isinstance(node, ast.Assign)]
    if unknown := [name for name in assigned if name not in (*OF_ALL, *known)]:
        raise ValueError(f"parameters: unknown {', '.join(unknown)}; this notebook has {', '.join(known)}")
