"""Versions that decide on pixels, known without what draws."""

import matplotlib
from matplotlib import ft2font


def drawn_with() -> dict[str, str]:
    return {"matplotlib": matplotlib.__version__, "freetype": ft2font.__freetype_version__}
