"""Verdicts of the figure check as Markdown, for the summary that continuous integration shows with a job."""

from vibroimpact.figures.kit.markdown import code, plain
from vibroimpact_pipeline.figure_check.verdicts import OTHER_VERSIONS, PASSED, by_distance, command, lines


def markdown(verdicts: list[dict]) -> str:
    """What sums up, and a row for each figure that has not passed, with the command that accepts it."""
    rows = [
        [plain(verdict["figure"]), verdict["status"], _first(verdict), code(command([verdict["figure"]]))]
        for verdict in by_distance(verdicts)
        if verdict["status"] != PASSED
    ]
    heads = ["figure", "verdict", "why", "to accept it"]
    table = [heads, ["---"] * len(heads), *rows] if rows else []
    said = [f"### Figure check\n\n{lines(verdicts)[-1]}.\n", *(f"| {' | '.join(row)} |" for row in table)]
    return "\n".join(said) + "\n"


def _first(verdict):
    first, *more = verdict["reasons"] or [OTHER_VERSIONS]
    return plain(first) + (f" (and {len(more)} more)" if more else "")
