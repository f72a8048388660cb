"""Convert LaTeX formulas to MathML, which browsers render without scripts.

The font is STIX Two Math 2.11 (licence in OFL.txt), reduced to the characters of formulas by
`pyftsubset --unicodes=... --layout-features=dtls --no-hinting --drop-tables+=DSIG,GPOS,GDEF,gasp --flavor=woff`.
"""

import re
from base64 import b64encode
from pathlib import Path

from math_core import LatexToMathML

FONT = Path(__file__).with_name("stix_two_math.woff")
STYLE = f"""\
@font-face {{
  font-family: "STIX Two Math";
  src: url(data:font/woff;base64,{b64encode(FONT.read_bytes()).decode()}) format("woff");
}}
math {{ font-family: "STIX Two Math", math, serif; }}
.kept {{ white-space: nowrap; }}
math[display="block"] {{ margin: 0.7rem 0; }}
"""
"""CSS of every page with formulas. It embeds the font because browsers load no fonts from local files."""
_CONVERTER = LatexToMathML(fancy_error=False)
OVERLINE = re.compile(r"(?<=<mo stretchy=\"true\">)\u0332(?=</mo></mover>)")
"""The combining low line that the converter inserts for \\overline, although browsers draw it below the letter."""
MARKED = re.compile(r'([(“]?)(<math(?![^>]*"block").*?</math>)([.,;:?!)”]*)', re.DOTALL)
"""An inline formula with the punctuation before and after it."""


def mathml(tex: str, display: bool) -> str:
    r"""Return a LaTeX formula as MathML.

    If `display` is True, the page shows the formula on a line of its own. Only such a formula may have a \tag.

    Raises
    ------
    math_core.LatexError
        If the formula cannot be converted.
    """
    if display and r"\tag" in tex:
        tex = rf"\begin{{equation}}{tex}\end{{equation}}"
    return OVERLINE.sub("\u203e", _CONVERTER.convert_with_local_state(tex, displaystyle=display))


def kept(html: str) -> str:
    """Return HTML in which no line can break between a formula and the punctuation around it."""
    return MARKED.sub(lambda m: f'<span class="kept">{m[0]}</span>' if m[1] or m[3] else m[0], html)
