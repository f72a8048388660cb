"""Rules and times in words."""

import re

NAMES = [(r"^fig(?=\d)", "figure "), (r"(\d)_0?(\d)", r"\1.\2"), (r"_", " ")]
"""From the name of a rule to words: pattern, replacement."""


def words(rule: str) -> str:
    """The name of a rule in words: fig10_06 is figure 10.6."""
    for pattern, replacement in NAMES:
        rule = re.sub(pattern, replacement, rule)
    return rule


def duration(seconds: float) -> str:
    """A time to the second: 42 s, 2 min 5 s, 1 h 0 min 3 s."""
    minutes, s = divmod(max(0, round(seconds)), 60)
    hours, minutes = divmod(minutes, 60)
    return " ".join([*[f"{hours} h"] * (hours > 0), *[f"{minutes} min"] * (hours + minutes > 0), f"{s} s"])


def count(number: int, noun: str) -> str:
    """1 job, 2 jobs."""
    return f"{number} {noun}{'s' * (number != 1)}"
