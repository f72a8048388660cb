"""Versions that decide on pixels, known without what draws."""

import matplotlib
from matplotlib import ft2font


def drawing_versions() -> dict[str, str]:
    return {"matplotlib": matplotlib.__version__, "freetype": ft2font.__freetype_version__}
