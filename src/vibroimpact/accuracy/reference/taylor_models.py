"""Compute Taylor series of the motion of the boxes between events, with enclosed errors, from rational parameters."""

import math
from dataclasses import dataclass, fields
from decimal import Decimal
from fractions import Fraction

from flint import arb, arb_mat, arb_poly, ctx, fmpq

from vibroimpact.system import System

# The longest step is REACH divided by the norm of the rate matrix. In a step, cancellation can amplify rounding errors
# by e^REACH.
REACH = 4


def to_fraction(name: str, value, exact_floats: bool = False) -> Fraction:
    """Return the rational number that a value represents.

    exact_floats: True to read a float as its binary value, False to read 0.1 as 1/10.

    Raises
    ------
    ValueError
        If the value is not a finite number.
    """
    try:
        if isinstance(value, Fraction | int | str | Decimal):
            return Fraction(value)
        return Fraction(float(value) if exact_floats else repr(float(value)))
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: {value!r} is not a finite number") from None


def to_ball(value: Fraction) -> arb:
    """Return an interval (arb) that encloses a rational number, at the current precision."""
    return arb(fmpq(value.numerator, value.denominator))


@dataclass(frozen=True)
class ExactSystem:
    """Coefficients of (10.2) as rational numbers; matrices are tuples of rows."""

    epsilon: Fraction
    kappa: Fraction
    Omega: Fraction
    stiffness: tuple
    damping: tuple
    forcing: tuple

    @classmethod
    def of(cls, parameters, exact_floats: bool = False) -> "ExactSystem":
        """Return the coefficients for a System, or for a mapping of its ten parameters.

        exact_floats: as in `to_fraction`. If True, Omega is also rounded to a float, as in `simulate`.

        Raises
        ------
        ValueError
            If a parameter is missing, unknown or not admissible.
        """
        names = [field.name for field in fields(System)]
        if isinstance(parameters, System):
            parameters = {name: getattr(parameters, name) for name in names}
        if set(parameters) != set(names):
            raise ValueError(f"system_parameters: got the parameters {sorted(parameters)}, expected exactly {names}")
        rounded = System(**{name: float(value) for name, value in parameters.items()})
        q = {name: to_fraction(name, value, exact_floats) for name, value in parameters.items()}
        epsilon = q["epsilon"]
        return cls(
            epsilon=epsilon,
            kappa=q["kappa"],
            Omega=Fraction(rounded.Omega) if exact_floats else 1 + epsilon * q["sigma_e_hat"],
            stiffness=_coupled(Fraction(1), 1 + epsilon * q["sigma20_hat"], epsilon * q["alpha12_hat"]),
            damping=_coupled(epsilon * q["gamma1_hat"], epsilon * q["gamma2_hat"], epsilon * q["gamma12_hat"]),
            forcing=(epsilon * q["f10_hat"], epsilon * q["f20_hat"]),
        )


def _coupled(one, two, coupling):
    return (one + coupling, -coupling), (-coupling, two + coupling)


class Flow:
    """Power series of X1 and X2 in the time since an initial state, for a fixed set of sticking balls.

    The motion obeys s' = A s, where A is the `rate_matrix`. The k-th coefficients of X1 and X2 are therefore the first
    two entries of A^k s / k!. No eigenvalues are used, so that repeated eigenvalues need no special case. The last
    coefficient is an interval that encloses the neglected terms.
    """

    def __init__(self, system: ExactSystem, stuck, bits: int):
        self.bits = bits
        rate = rate_matrix(system, stuck)
        weights, self.norm = _weighted_norm(rate)
        self._weights = [to_ball(weight) for weight in weights]
        self.terms = 12
        while self.terms * math.log2(REACH) - math.lgamma(self.terms + 1) / math.log(2) > -bits:
            self.terms += 1
        with ctx.workprec(bits):
            A = arb_mat(6, 6, [to_ball(entry) for row in rate for entry in row])
            rows = arb_mat(2, 6, [1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0])
            table = []
            for k in range(self.terms):
                table.append(rows.entries())
                rows = rows * A / (k + 1)
            self._table = arb_mat(
                2 * self.terms, 6, [entry for start in (0, 6) for row in table for entry in row[start : start + 6]]
            )
            # Since |A^k s| <= norm^k |s|, the sum of the neglected terms is at most twice the first neglected term if
            # norm * t <= (terms - 4) / 2. The same bound holds for the first four derivatives of the series.
            self._tail = 2 * to_ball(self.norm) ** self.terms / arb.fac_ui(self.terms)

    @property
    def longest_step(self) -> Fraction:
        """Longest time after the initial state up to which the series is accurate to `bits` binary digits."""
        return Fraction(REACH) / self.norm

    def size(self, vector) -> arb:
        """Return an upper bound of the weighted norm of `vector`, which is [X1, X2, X1', X2', sin, cos].

        The bound times the attribute `norm` is a bound of |X1''| and |X2''|.
        """
        largest = arb(0)
        for weight, entry in zip(self._weights, vector, strict=True):
            largest = largest.max(abs(weight * entry))
        return largest.upper()

    def series(self, vector) -> tuple[arb_poly, arb_poly]:
        """Return X1 and X2 as power series in time, from initial values [X1, X2, X1', X2', sin, cos]."""
        with ctx.workprec(self.bits):
            entries = (self._table * arb_mat(6, 1, vector)).entries()
            tail = arb(0, (self._tail * self.size(vector)).upper())
        return arb_poly([*entries[: self.terms], tail]), arb_poly([*entries[self.terms :], tail])


def rate_matrix(system: ExactSystem, stuck) -> list:
    """Return the matrix A of s' = A s, where s = [X1, X2, X1', X2', sin(Omega tau), cos(Omega tau)].

    stuck: for each module, True if its ball sticks to a wall.
    """
    rows = [[Fraction(0)] * 6 for _ in range(6)]
    for i in range(2):
        mass = 1 + system.epsilon if stuck[i] else Fraction(1)
        rows[i][2 + i] = Fraction(1)
        for j in range(2):
            rows[2 + i][j] = -system.stiffness[i][j] / mass
            rows[2 + i][2 + j] = -system.damping[i][j] / mass
        rows[2 + i][4] = system.forcing[i] / mass
    rows[4][5], rows[5][4] = system.Omega, -system.Omega
    return rows


def _weighted_norm(rate):
    """Return six weights >= 1, one for each entry of a state, and the norm of `rate` with these weights.

    With these weights, the norm is near the highest natural frequency.
    """
    stiffness = max(sum(abs(entry) for entry in row[:2]) for row in rate[2:4])
    frequency = Fraction(max(1, math.ceil(8 * math.sqrt(stiffness)) / 8))
    weights = [frequency, frequency] + [Fraction(1)] * 4
    norm = max(sum(weights[i] * abs(entry) / weights[j] for j, entry in enumerate(row)) for i, row in enumerate(rate))
    return weights, norm
