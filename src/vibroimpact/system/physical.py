"""Physical parameters of (10.1), and their conversion to the dimensionless parameters of (10.2)."""

import math
from dataclasses import dataclass, fields

import numpy as np

from vibroimpact.system.arguments import positive, real
from vibroimpact.system.parameters import System


@dataclass(frozen=True, kw_only=True)
class PhysicalSystem:
    """Parameters of (10.1) in consistent units, such as SI units.

    Parameters
    ----------
    M, m : float
        Mass of a box and of a ball, above 0.
    k1, k2, k12 : float
        Stiffness of box 1 to ground, of box 2 to ground, and of the coupling. k1 and k2 are above 0, k12 is at least 0.
    c1, c2, c12 : float
        Damping of box 1 to ground, of box 2 to ground, and of the coupling. All are at least 0.
    F10, F20 : float
        Force amplitudes.
    omega1, omega2 : float
        Circular frequencies of the forces, above 0.
    L : float
        Clearance, above 0: a ball at y hits a wall of its box at x if |x - y| = L.
    kappa : float
        Restitution coefficient.
    base, unbalance : float, default 0.0
        Amplitude of a ground motion, and unbalance of a rotor, as in `single`. Both are at least 0, and at most one of
        them is above 0. If one is above 0, the amplitude of the resulting force at omega1 replaces F10.

    Raises
    ------
    ValueError
        If a parameter is not a finite number or is out of range, or if base and unbalance are both given.

    Notes
    -----
    With omega10 = sqrt(k1 / M), the units of the dimensionless quantities are 1 / omega10 (time), omega10 (frequency),
    L (displacement), L omega10 (velocity), k1 L (force) and k1 L^2 (energy).

    Examples
    --------
    >>> machine = vi.PhysicalSystem.single(M=100.0, m=5.0, k=4e4, c=40.0, F=20.0, L=0.01)
    >>> system = machine.dimensionless()
    """

    M: float
    m: float
    k1: float
    k2: float
    k12: float
    c1: float
    c2: float
    c12: float
    F10: float
    F20: float
    omega1: float
    omega2: float
    L: float
    kappa: float
    base: float = 0.0
    unbalance: float = 0.0

    def __post_init__(self):
        for field in fields(self):
            object.__setattr__(self, field.name, real(field.name, getattr(self, field.name)))
        for name in ("M", "m", "k1", "k2", "omega1", "omega2", "L"):
            positive(name, getattr(self, name))
        for name in ("k12", "c1", "c2", "c12", "base", "unbalance"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name}: {getattr(self, name)} is below 0")
        if self.base and self.unbalance:
            raise ValueError(f"base, unbalance: got {self.base} and {self.unbalance}; give one of them")
        object.__setattr__(self, "F10", float(self.force(self.omega1)))

    def force(self, omega):
        """Return the amplitude of the force on box 1 at a circular frequency omega (number or array)."""
        if self.base:
            return self.base * np.hypot(self.k1, self.c1 * omega)
        return self.unbalance * omega**2 if self.unbalance else self.F10

    @classmethod
    def single(
        cls,
        *,
        M: float,
        m: float,
        k: float,
        c: float,
        F: float = 0.0,
        L: float = 1.0,
        kappa: float = 0.65,
        omega: float | None = None,
        base: float = 0.0,
        unbalance: float = 0.0,
    ) -> "PhysicalSystem":
        """Return the parameters of one machine with a ball in its box.

        The machine is module 1. Module 2 is a copy of module 1. No force drives the copy, and it is not coupled to
        module 1. Therefore module 2 is inactive (`System.modules`). Results describe module 1 only, with 4 multipliers,
        4 Lyapunov exponents or 2 slow eigenvalues. In arrays with one entry per module, the entry of module 2 is NaN.
        In states, the components of module 2 are 0.

        Parameters
        ----------
        M, m : float
            Mass of the machine with its box [kg], and of the ball [kg].
        k : float
            Stiffness to ground [N/m].
        c : float
            Damping to ground [N s/m].
        F : float, default 0.0
            Amplitude of a force that does not depend on the frequency [N].
        L : float, default 1.0
            Clearance, half of the play of the ball [m].
        kappa : float, default 0.65
            Restitution coefficient.
        omega : float, optional
            Circular frequency of the force [rad/s]. The default is the natural frequency of the machine.
        base : float, default 0.0
            Amplitude G of a ground motion [m], in place of F. The force amplitude is G sqrt(k^2 + c^2 omega^2); the
            ground lags behind the force by arctan(c omega / k). Displacements are absolute.
        unbalance : float, default 0.0
            Mass times eccentricity of a rotor, u [kg m], in place of F. The force amplitude is u omega^2; M includes
            the rotor.

        Returns
        -------
        PhysicalSystem
            Parameters with an inactive second module.

        Raises
        ------
        ValueError
            As for PhysicalSystem, or if several of F, base and unbalance are given.
        """
        drives = {name: real(name, value) for name, value in (("F", F), ("base", base), ("unbalance", unbalance))}
        if len(given := {name: value for name, value in drives.items() if value}) > 1:
            raise ValueError(f"{', '.join(given)}: got {' and '.join(map(str, given.values()))}; give one of them")
        k, M = positive("k", k), positive("M", M)
        omega = math.sqrt(k / M) if omega is None else omega
        return cls(
            M=M,
            m=m,
            k1=k,
            k2=k,
            k12=0.0,
            c1=c,
            c2=c,
            c12=0.0,
            F10=F,
            F20=0.0,
            omega1=omega,
            omega2=omega,
            L=L,
            kappa=kappa,
            base=base,
            unbalance=unbalance,
        )

    @property
    def omega10(self) -> float:
        """Natural circular frequency sqrt(k1 / M) of box 1, the unit of frequency in section 10.2."""
        return math.sqrt(self.k1 / self.M)

    def dimensionless(self) -> System:
        """Return the dimensionless system, as defined by (10.4)-(10.6) and in the text after (10.2).

        Returns
        -------
        System
            The system, with time tau = omega10 t and lengths in units of L.

        Raises
        ------
        ValueError
            If the two forcing frequencies differ, (10.5), or if System does not accept a parameter.
        """
        if self.omega1 != self.omega2:
            raise ValueError(f"omega2: {self.omega2} differs from omega1 = {self.omega1}; both must be equal, (10.5)")
        epsilon = self.m / self.M
        force = self.M * self.L * self.omega10**2 * epsilon
        damping = self.M * self.omega10 * epsilon
        return System(
            epsilon=epsilon,
            kappa=self.kappa,
            alpha12_hat=self.k12 / (self.k1 * epsilon),
            gamma1_hat=self.c1 / damping,
            gamma2_hat=self.c2 / damping,
            gamma12_hat=self.c12 / damping,
            sigma20_hat=(self.k2 / self.k1 - 1.0) / epsilon,
            sigma_e_hat=(self.omega1 / self.omega10 - 1.0) / epsilon,
            f10_hat=self.F10 / force,
            f20_hat=self.F20 / force,
        )
