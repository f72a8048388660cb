"""Write texts of any origin, such as names of cases or reasons in tables, so that Markdown shows them unchanged."""

import re

ESCAPED = re.compile(r"([!-/:-@\[-`{-~])")
"""ASCII punctuation; in Markdown, a backslash makes each of these an ordinary character."""
EXACTLY = "**The exact system:**"
"""First words of the line on the exact system, on the page of a figure."""


def one_line(text) -> str:
    """Return a text on one line, in which a replacement character stands for each character that is not printable."""
    return "".join(
        letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in " ".join(str(text).split())
    )


def plain(text) -> str:
    """Return a text on one line with a backslash before each ASCII punctuation character.

    Markdown then shows this text without interpreting it, also in a cell of a table.
    """
    return ESCAPED.sub(r"\\\1", one_line(text))


def code(text) -> str:
    """Return a text as inline code; the text may contain any number of backticks."""
    text = one_line(text)
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    return f"{fence} {text} {fence}" if "`" in text else f"{fence}{text}{fence}"


WORDS = {"None": "–", "nan": "–", "inf": "∞", "True": "yes", "False": "no"}
"""Texts that replace None, NaN, infinity, True and False."""


def digits(value, number: int = 3) -> str:
    """Return a value as text; numbers have `number` significant digits.

    Numbers other than 0 are written with a power of ten if their modulus is at least 1e6 or below 1e-4. The texts in
    WORDS replace None, NaN, infinity, True and False.
    """
    try:
        value = float(value) if isinstance(value, str) else value
    except ValueError:
        return plain(value)
    if str(value) in WORDS:
        return WORDS[str(value)]
    rounded = float(f"{value:.{number}g}")
    if rounded == 0 or 1e-4 <= abs(rounded) < 1e6:
        return f"{rounded:.15g}"
    mantissa, exponent = f"{rounded:.{number - 1}e}".split("e")
    factor = "" if float(mantissa) == 1 else rf"{float(mantissa):.15g}\cdot "
    return rf"${factor}10^{{{int(exponent)}}}$"
