"""Judge the claims of the chapter, each by a check that computes; no verdict is written by hand.

A claim is a mapping with id, place, statement, check (name of a function of the modules below), arguments (optional,
of that function), refuted_by (what would refute it) and fact (optional: why it does not hold, the same text for claims
that fail for the same reason); docs/studies/claims.yaml holds them all. A check takes the Evidence and the arguments,
and returns a Finding.
"""

from vibroimpact.studies.claims import (
    absorber_checks,
    coupling_checks,
    equation_checks,
    manifold_checks,
    motion_checks,
    point_checks,
)
from vibroimpact.studies.claims.evidence import Evidence, NotOfTheChapter
from vibroimpact.studies.claims.finding import REFUTED, VERDICTS

MODULES = (equation_checks, manifold_checks, point_checks, motion_checks, absorber_checks, coupling_checks)
CHECKS = {name: getattr(module, name) for module in MODULES for name in module.CHECKS}
NOT_JUDGED = "not judged"
NOT_ABOUT = "Not judged are claims that depend on what is not as in the chapter, or not as they were written for:"
FIELDS = ("id", "place", "statement", "check", "refuted_by")


def problems(claims: list[dict]) -> list[str]:
    """Return problems of a list of claims, a line each.

    Problems are missing or unknown fields, repeated ids and unknown checks.
    """
    found = []
    ids = [claim.get("id") for claim in claims]
    for place, claim in enumerate(claims, start=1):
        name = claim.get("id") or f"claim {place}"
        found += [f"{name}: {field} is missing" for field in FIELDS if not claim.get(field)]
        found += [f"{name}: unknown field {field!r}" for field in claim.keys() - {*FIELDS, "arguments", "fact"}]
        if ids.index(claim.get("id")) < place - 1:
            found.append(f"{name}: id given twice")
        if claim.get("check") and claim["check"] not in CHECKS:
            found.append(f"{name}: no check is called {claim['check']!r}")
    return found


def judge(claims: list[dict], evidence: Evidence) -> list[dict]:
    """Return the claims, each with its verdict, its parts and the supporting numbers.

    One that reads evidence which is not about the chapter is not judged, and has the reason.

    Raises
    ------
    ValueError
        If the list of claims has problems.
    """
    found = problems(claims)
    if found:
        raise ValueError("claims: " + "; ".join(found))
    judged = []
    for claim in claims:
        try:
            finding = CHECKS[claim["check"]](evidence, **claim.get("arguments", {}))
        except NotOfTheChapter as unlike:
            judged.append({**claim, "verdict": NOT_JUDGED, "reason": str(unlike), "parts": {}, "numbers": {}})
        else:
            found = {"verdict": finding.verdict, "reason": "", "parts": finding.parts, "numbers": finding.numbers}
            judged.append(claim | found)
    return judged


def to_markdown(judged: list[dict], unlike=()) -> str:
    """Return a table of judged claims in Markdown, with counts of verdicts and facts.

    Reasons are given for claims that were not judged.
    """
    verdicts = (*VERDICTS, NOT_JUDGED) if unlike else VERDICTS
    counts = {verdict: sum(claim["verdict"] == verdict for claim in judged) for verdict in verdicts}
    lines = [
        "# The claims of the chapter",
        "",
        f"{len(judged)} claims of sections 10.2 to 10.5: "
        + ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
        + ".",
        "",
        *([NOT_ABOUT, "", *(f"- {line}" for line in unlike), ""] if unlike else []),
        *_facts(judged),
        "| claim | place | what it says | verdict | parts and numbers | would be refuted by |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    return "\n".join(lines + [_row(claim) for claim in judged]) + "\n"


def facts(judged: list[dict]) -> dict[str, list[dict]]:
    """Return the facts that refute claims, in order, each with all claims that it refutes.

    A refuted claim that names none counts as a fact of its own: what would refute it does.
    """
    of_claims = [claim.get("fact") or claim.get("refuted_by") for claim in judged]
    refuting = dict.fromkeys(fact for fact, claim in zip(of_claims, judged, strict=True) if claim["verdict"] == REFUTED)
    return {fact: [claim for other, claim in zip(of_claims, judged, strict=True) if other == fact] for fact in refuting}


def _facts(judged):
    found = facts(judged)
    lines = [
        f"- {fact} " + ", ".join(f"`{claim['id']}` ({claim['verdict']})" for claim in claims)
        for fact, claims in found.items()
    ]
    return [f"Facts that refute claims, {len(found)} in all:", "", *lines, ""] if found else []


def _row(claim):
    parts = [f"{part}: {_WORDS[holds]}" for part, holds in claim["parts"].items()]
    numbers = [f"{name} = {_shown(value)}" for name, value in claim["numbers"].items()]
    cells = [claim["id"], claim["place"], claim["statement"], f"**{claim['verdict']}**"]
    cells += [claim.get("reason") or "; ".join(parts) + (". " if numbers else "") + ", ".join(numbers)]
    cells.append(claim["refuted_by"])
    return "| " + " | ".join(" ".join(cell.split()).replace("|", "\\|") for cell in cells) + " |"


_WORDS = {True: "yes", False: "no", None: "open"}


def _shown(value):
    if isinstance(value, float):
        return f"{value:.5g}"
    if isinstance(value, list):
        return "(" + ", ".join(_shown(item) for item in value) + ")"
    return str(value)
