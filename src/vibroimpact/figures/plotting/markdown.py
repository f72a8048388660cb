"""Texts from elsewhere, names of cases or reasons in tables say, in Markdown that shows them and does nothing else."""

import re

ESCAPED = re.compile(r"([!-/:-@\[-`{-~])")
"""ASCII punctuation, each of which a backslash makes an ordinary character."""
EXACTLY = "**The exact system:**"
"""Begins the one line on the page of a figure that says what the exact system does."""


def one_line(text) -> str:
    """Return a text on one line, without characters that cannot be seen."""
    return "".join(
        letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in " ".join(str(text).split())
    )


def plain(text) -> str:
    """Return a text as it is: no markup, formula, link or entity begins in it, and a cell of a table ends behind it."""
    return ESCAPED.sub(r"\\\1", one_line(text))


def code(text) -> str:
    """Return a text in the letters of code, however many backticks are in it."""
    text = one_line(text)
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    return f"{fence} {text} {fence}" if "`" in text else f"{fence}{text}{fence}"
