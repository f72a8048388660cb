"""Labels (a), (b), (c) of the fixed points, which the chapter gives in pictures only."""

from string import ascii_lowercase

import numpy as np

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.masri_printed import printed_limit


def labels(system, points) -> list[str]:
    """A label per fixed point, from "a" on: from the least to the most stable.

    First the points that (10.26) calls unstable, then by falling growth rate of the slow flow (largest real part of its
    eigenvalues). Of the orders one could think of, it is the one under which most sentences of section 10.4 hold,
    that on Figs. 10.7 and 10.8 included; docs/errata.md lists sentence by sentence.
    """
    limit = printed_limit(rho(system.kappa))
    order = sorted(
        range(len(points)),
        key=lambda k: (bool(np.min(points[k].C) > limit), -points[k].slow_eigenvalues.real.max()),
    )
    return [ascii_lowercase[order.index(k)] for k in range(len(points))]
