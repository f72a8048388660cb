"""Markdown for the names of numbers and parts behind claims, with formulas."""

import re

from vibroimpact.figures.kit.markdown import plain

GREEK = {"kappa": r"\kappa", "epsilon": r"\varepsilon", "tau": r"\tau", "Omega": r"\Omega"}
WHOLE = {
    "printed_10_26": "by (10.26)",
    "M / m": "$M/m$",
    "m / M": "$m/M$",
    "k12 / k": "$k_{12}/k$",
    "c12 / c": "$c_{12}/c$",
    "-(1 + kappa) W' in W": r"$-(1 + \kappa) W'$ in $W$",
    "8 C / (pi n)^2 for odd n, 0 for even n": r"$8C/(\pi n)^2$ for odd $n$, 0 for even $n$",
    "S1 by sin^2 + cos^2 = 1": r"$S_1$ by $\sin^2 + \cos^2 = 1$",
}
SYMBOL = re.compile(
    r"\b(?:(?P<greek>kappa|epsilon|tau|Omega)|(?P<hatted>alpha|gamma|sigma|f)_?(?P<of>\d+|e)_hat|(?P<least>[BC])_min|(?P<letter>[BCPSUWck])(?P<index>\d+)"
    r"|f(?P<force>[12]0)|(?P<alone>[BCSWY]))\b|(?P<sign>>=)"
)


def named(text) -> str:
    """Return the Markdown of a name; symbols of the chapter in it become formulas."""
    text = str(text)
    if text in WHOLE:
        return WHOLE[text]
    parts, end = [], 0
    for symbol in SYMBOL.finditer(text):
        parts += [_plain(text[end : symbol.start()]), f"${_formula(symbol)}$"]
        end = symbol.end()
    return "".join([*parts, _plain(text[end:])])


def _plain(text):
    """Return `plain` of a text, with the blanks at both ends."""
    return " " * text.startswith(" ") + plain(text.replace("_", " ")) + " " * (text.endswith(" ") and text != " ")


def _formula(symbol):
    found = symbol.groupdict()
    if found["greek"]:
        return GREEK[found["greek"]]
    if found["hatted"]:
        return rf"\hat {'f' if found['hatted'] == 'f' else chr(92) + found['hatted']}_{{{found['of']}}}"
    if found["least"]:
        return rf"{found['least']}_{{\min}}"
    if found["letter"]:
        return f"{found['letter']}_{{{found['index']}}}"
    if found["force"]:
        return rf"\hat f_{{{found['force']}}}"
    return found["alone"] or r"\ge"
