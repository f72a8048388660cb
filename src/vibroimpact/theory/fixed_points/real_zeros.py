"""All real common zeros, in a square, of polynomials of degree 2 in each of two variables.

Boxes are discarded by the convex hull property of Bernstein coefficients, or settled (no zero, or exactly one) by the
Krawczyk test; what neither test settles is divided. Every comparison allows for rounding, so no zero is lost;
zeros that rounding cannot separate come back as one, marked multiple.
(Bernstein exclusion: Garloff & Smith 2001; Krawczyk test: Neumaier 1990, Interval Methods for Systems of Equations.)
"""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

# Coefficients t of t0 + t1 x + t2 x^2 to its Bernstein coefficients on [-1, 1].
_TO_BERNSTEIN = np.array([[1.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 1.0, 1.0]])
# Rounding in the shifts and sums below, relative to the sum of moduli: far above the some 50 operations each takes.
_ROUNDING = 100 * np.finfo(float).eps
# Half-width, relative to max(1, |centre|), at which a double zero drowns in rounding.
_RESOLUTION = 1e-8
_REACH = 2.0  # the Krawczyk test looks at a box this many times as wide, so that zeros on an edge are settled
_CROWD = 20_000  # more boxes than this hold a curve of zeros
_DEPTH = 200


def real_zeros(coefficients, magnitudes, radius) -> tuple[np.ndarray, np.ndarray]:
    """Common zeros in [-radius, radius]^2 of the polynomials; the first two determine, the others help to exclude.

    Args:
        coefficients: shape (m, 3, 3), of x^j y^k; the common zeros of the first two are zeros of all.
        magnitudes: shape (m, 3, 3), the coefficients formed with moduli throughout: the scale of their rounding.

    Returns:
        Zeros, shape (n, 2), in ascending order of x, and for each whether it is multiple (shape (n,), bool).

    Raises:
        ArithmeticError: the zeros are not isolated.
    """
    centres, half = np.zeros((1, 2)), float(radius)
    found, unsettled = [], []
    for _ in range(_DEPTH):
        local, noise = _expand(coefficients, magnitudes, centres, half)
        keep = _may_vanish(local, noise)
        centres, local, noise = centres[keep], local[keep], noise[keep]
        empty, single, newton = _krawczyk(local[:, :2], noise[:, :2])
        found += [(pair, half) for pair in zip(centres[single], newton[single], strict=True)]
        settled = empty | single
        rest = centres[~settled]
        fine = (_drowned(local, noise) | (half <= _RESOLUTION * np.maximum(1, np.abs(centres).max(axis=1))))[~settled]
        unsettled += [(centre, half) for centre in rest[fine]]
        rest = rest[~fine]
        if not len(rest):
            return _gather(coefficients, found, unsettled)
        if len(rest) > _CROWD:
            break
        half /= 2
        corners = half * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])
        centres = (rest[:, None, :] + corners).reshape(-1, 2)
    raise ArithmeticError("the polynomials have no isolated zeros")


def _powers(x):
    """Matrices S (..., 3, 3) with coefficients about x = S @ coefficients about 0."""
    matrices = np.empty((*x.shape, 3, 3))
    matrices[...] = np.eye(3)
    matrices[..., 0, 1], matrices[..., 0, 2], matrices[..., 1, 2] = x, x * x, 2 * x
    return matrices


def _expand(coefficients, magnitudes, centres, half):
    """Coefficients (n, m, 3, 3) in box coordinates in [-1, 1]^2 and a bound (n, m) on their rounding."""
    scale = half ** np.arange(3)
    left = scale[:, None] * _powers(centres[:, 0])
    right = scale[:, None] * _powers(centres[:, 1])
    local = np.einsum("nij,mjk,nlk->nmil", left, coefficients, right)
    reach = (np.abs(centres) + _REACH * half)[..., None] ** np.arange(3)
    noise = _ROUNDING * np.einsum("nj,mjk,nk->nm", reach[:, 0], magnitudes, reach[:, 1])
    return local, noise


def _may_vanish(local, noise):
    """Whether a box may hold a zero, judged by the polynomials and by the adjugate Jacobian times the pair.

    The latter separates the two curves where they cross, and where they nearly touch, without dividing.
    """
    adjugate = _adjugate(_gradient(local))
    separated = np.einsum("nab,nbjk->najk", adjugate, local[:, :2])
    blur = np.einsum("nab,nb->na", np.abs(adjugate), noise[:, :2]) * (1 + _ROUNDING)
    bernstein = _TO_BERNSTEIN @ np.concatenate([local, separated], axis=1) @ _TO_BERNSTEIN.T
    noise = np.concatenate([noise, blur], axis=1)
    lowest, highest = bernstein.min(axis=(2, 3)), bernstein.max(axis=(2, 3))
    return np.all((lowest <= noise) & (highest >= -noise), axis=1)


def _gradient(local):
    """Jacobian (n, 2, 2) of the pair at the centres, in box coordinates."""
    return np.stack([local[:, :2, 1, 0], local[:, :2, 0, 1]], -1)


def _adjugate(matrix):
    rows = [
        np.stack([matrix[:, 1, 1], -matrix[:, 0, 1]], -1),
        np.stack([-matrix[:, 1, 0], matrix[:, 0, 0]], -1),
    ]
    return np.stack(rows, -2)


def _drowned(local, noise):
    """Whether the polynomials change by less than their rounding over the box: dividing it teaches nothing more."""
    size = np.abs(local)
    return np.all(size.sum(axis=(2, 3)) - size[..., 0, 0] <= noise, axis=1)


def _krawczyk(local, noise):
    """Per box: no zero in it; exactly one zero within _REACH times it; and the Newton step to that zero.

    With Y the inverse of the Jacobian at the centre, x - Y F(x) maps the box of half-width s into
    -Y F(0) + [-q s, q s], where q bounds the change of Y DF over the wide box.
    """
    constant, gradient = local[..., 0, 0], _gradient(local)
    size = np.abs(local)
    s = _REACH ** np.arange(3)
    change = np.stack(
        [
            np.einsum("nmj,j->nm", size[..., 1, 1:], s[1:]) + 2 * np.einsum("nmj,j->nm", size[..., 2, :], s) * _REACH,
            np.einsum("nmj,j->nm", size[..., 1:, 1], s[1:]) + 2 * np.einsum("nmj,j->nm", size[..., :, 2], s) * _REACH,
        ],
        -1,
    )
    change += noise[..., None]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        inverse = _adjugate(gradient) / np.linalg.det(gradient)[:, None, None]
        q = (np.abs(inverse) @ change).sum(axis=2)
        step = -np.einsum("nij,nj->ni", inverse, constant)
        blur = np.einsum("nij,nj->ni", np.abs(inverse), noise) + _ROUNDING
        contracts = np.all(q < 1, axis=1)
        empty = contracts & np.any(np.abs(step) > 1 + q + blur, axis=1)
        single = contracts & ~empty & np.all(np.abs(step) + q * _REACH + blur < _REACH, axis=1)
    return empty, single, step


def _gather(coefficients, found, unsettled):
    """One entry per zero: neighbouring boxes may have found the same one."""
    zeros, boxes = np.empty((0, 2)), []
    polished = _polish(coefficients[:2], np.reshape([centre + half * step for (centre, step), half in found], (-1, 2)))
    for zero, ((centre, _), half) in zip(polished, found, strict=True):
        # Within the reach of a box there is one zero only.
        if not _within(zeros, centre, half):
            zeros = np.vstack([zeros, zero])
            boxes.append((centre, half))
    loose = [(point, size) for point, size in unsettled if not any(_within(point, *box) for box in boxes)]
    clusters = _clusters(loose)
    points = np.vstack([zeros, *clusters])
    multiple = np.arange(len(points)) >= len(zeros)
    order = np.lexsort(points.T[::-1])
    return points[order], multiple[order]


def _within(points, centre, half):
    return bool(np.any(np.all(np.abs(points - centre) < _REACH * half, axis=-1)))


def _clusters(boxes):
    """Centres of the groups of touching boxes."""
    if not boxes:
        return []
    centres = np.array([centre for centre, _ in boxes])
    halves = np.array([half for _, half in boxes])
    pairs = np.concatenate([_touching(centres, halves, half) for half in np.unique(halves)])
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(boxes), len(boxes)))
    count, label = connected_components(graph, directed=False)
    return [centres[label == k].mean(axis=0) for k in range(count)]


def _touching(centres, halves, half):
    """Pairs (n, 2) of a box of this half-width and a box no larger that touches it."""
    wide, others = np.flatnonzero(halves == half), np.flatnonzero(halves <= half)
    found = cKDTree(centres[wide]).sparse_distance_matrix(
        cKDTree(centres[others]), 4 * half, p=np.inf, output_type="ndarray"
    )
    return np.stack([wide[found["i"]], others[found["j"]]], axis=1)


def _polish(pair, zeros):
    """Newton's method from points (n, 2), to the last digits."""
    for _ in range(6):
        value, gradient = _value_and_gradient(pair, zeros)
        zeros = zeros - np.linalg.solve(gradient, value[..., None])[..., 0]
    return zeros


def _value_and_gradient(pair, points):
    left, right = _powers(points.T[..., None])
    local = left @ pair @ right.swapaxes(-1, -2)
    return local[..., 0, 0], _gradient(local)
