"""Judge each claim of the chapter by a computed check; no verdict is written by hand.

docs/studies/claims.yaml lists the claims. Each claim has these keys:

- id: name of the claim,
- place: equation, figure or passage of the chapter that contains the claim,
- statement: text of the claim,
- check: name of a function in one of the `MODULES`,
- refuted_by: a result that would refute the claim.

A claim may also have these keys:

- arguments: arguments of the check,
- central: true for an important claim,
- fact: the reason why the claim does not hold; claims that fail for the same reason have the same text here.

A check takes the Evidence and the arguments, and returns a Finding.
"""

from inspect import isfunction

from vibroimpact.studies.claims import equation_checks, manifold_checks, motion_checks, point_checks
from vibroimpact.studies.claims.evidence import Evidence

MODULES = equation_checks, manifold_checks, point_checks, motion_checks
CHECKS = {
    name: found
    for module in MODULES
    for name, found in vars(module).items()
    if isfunction(found) and found.__module__ == module.__name__ and not name.startswith("_")
}
"""Checks by name: all public functions of `MODULES`."""
NOT_JUDGED = "not judged"
FIELDS = ("id", "place", "statement", "check", "refuted_by")
OPTIONAL = ("arguments", "central", "fact")


def problems(claims: list[dict]) -> list[str]:
    """Return one line of text for each problem in a list of claims.

    A problem is a missing or unknown field, a repeated id, or an unknown check.
    """
    found = []
    ids = [claim.get("id") for claim in claims]
    for place, claim in enumerate(claims, start=1):
        name = claim.get("id") or f"claim {place}"
        found += [f"{name}: {field} is missing" for field in FIELDS if not claim.get(field)]
        found += [f"{name}: unknown field {field!r}" for field in claim.keys() - {*FIELDS, *OPTIONAL}]
        if ids.index(claim.get("id")) < place - 1:
            found.append(f"{name}: id given twice")
        if claim.get("check") and claim["check"] not in CHECKS:
            found.append(f"{name}: no check is called {claim['check']!r}")
    return found


def judge(claims: list[dict], evidence: Evidence) -> list[dict]:
    """Return the claims, each with its verdict, parts and numbers; raise ValueError if `problems` finds a problem."""
    found = problems(claims)
    if found:
        raise ValueError("claims: " + "; ".join(found))
    judged = []
    for claim in claims:
        finding = CHECKS[claim["check"]](evidence, **claim.get("arguments", {}))
        judged.append(claim | {"verdict": finding.verdict, "parts": finding.parts, "numbers": finding.numbers})
    return judged
