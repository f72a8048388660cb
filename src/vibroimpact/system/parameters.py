"""Dimensionless parameters of the system (10.2) with two modules, scaled as in (10.4)-(10.6)."""

import math
from dataclasses import dataclass, fields, replace

import numpy as np

from vibroimpact.system.arguments import positive, real
from vibroimpact.system.matrices import dynamic_stiffness

LARGEST = 1e15
"""Largest magnitude allowed for a parameter."""


@dataclass(frozen=True, kw_only=True)
class System:
    """Parameters of two coupled vibro-impact modules under forcing f_i sin(Omega tau).

    All parameters are dimensionless. The suffix _hat stands for the hat in (10.4)-(10.6). A coefficient in (10.2)
    is epsilon times the parameter with the hat, such as gamma1 = epsilon gamma1_hat.

    Parameters
    ----------
    epsilon : float
        Mass ratio m / M, above 0.
    kappa : float
        Restitution coefficient, between 0 and 1.
    alpha12_hat : float
        Stiffness of the coupling, at least 0.
    gamma1_hat, gamma2_hat : float
        Damping of box 1 and of box 2 to ground, at least 0.
    gamma12_hat : float
        Damping of the coupling, at least 0.
    sigma20_hat : float
        Detuning of box 2: its stiffness to ground is 1 + epsilon sigma20_hat, above 0.
    sigma_e_hat : float
        Detuning of the forcing frequency: Omega = 1 + epsilon sigma_e_hat, above 0.
    f10_hat, f20_hat : float
        Forcing amplitudes; a negative amplitude means forcing in antiphase.

    Raises
    ------
    ValueError
        If a parameter is not a finite number, is out of its range or exceeds 1e15 in magnitude, or if the forces excite
        an undamped resonance of the boxes.

    Examples
    --------
    >>> system = vi.System(epsilon=0.1, kappa=0.65, alpha12_hat=1.0, gamma1_hat=0.2, gamma2_hat=0.2, gamma12_hat=0.2,
    ...                    sigma20_hat=0.5, sigma_e_hat=0.2, f10_hat=1.0, f20_hat=1.0)
    >>> system.Omega
    1.02
    """

    epsilon: float
    kappa: float
    alpha12_hat: float
    gamma1_hat: float
    gamma2_hat: float
    gamma12_hat: float
    sigma20_hat: float
    sigma_e_hat: float
    f10_hat: float
    f20_hat: float

    def __post_init__(self):
        for field in fields(self):
            number = real(field.name, getattr(self, field.name))
            if abs(number) > LARGEST:
                raise ValueError(f"{field.name}: {number} exceeds {LARGEST:g} in magnitude")
            object.__setattr__(self, field.name, number)
        positive("epsilon", self.epsilon)
        if not 0 < self.kappa < 1:
            raise ValueError(f"kappa: {self.kappa} is not between 0 and 1 (both excluded)")
        for name in ("alpha12_hat", "gamma1_hat", "gamma2_hat", "gamma12_hat"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name}: {getattr(self, name)} is below 0")
        if self.stiffness2 <= 0:
            raise ValueError(f"sigma20_hat: the stiffness 1 + epsilon sigma20_hat = {self.stiffness2} is not above 0")
        if self.Omega <= 0:
            raise ValueError(f"sigma_e_hat: the frequency 1 + epsilon sigma_e_hat = {self.Omega} is not above 0")
        if self._resonates():
            raise ValueError(
                f"sigma_e_hat: at {self.sigma_e_hat}, the forces excite an undamped resonance of the boxes, "
                f"Omega = {self.Omega}; add damping or change the frequency"
            )

    @property
    def gamma1(self) -> float:
        """Damping of box 1 to ground, (10.4)."""
        return self.epsilon * self.gamma1_hat

    @property
    def gamma2(self) -> float:
        """Damping of box 2 to ground, (10.4)."""
        return self.epsilon * self.gamma2_hat

    @property
    def gamma12(self) -> float:
        """Damping of the coupling, (10.4)."""
        return self.epsilon * self.gamma12_hat

    @property
    def alpha12(self) -> float:
        """Stiffness of the coupling, (10.4)."""
        return self.epsilon * self.alpha12_hat

    @property
    def stiffness2(self) -> float:
        """Stiffness Omega_20^2 of box 2 to ground, (10.5), with the detuning sigma_20 of (10.6)."""
        return 1.0 + self.epsilon * self.sigma20_hat

    @property
    def Omega(self) -> float:
        """Forcing frequency Omega_1 = Omega_2, (10.5), with the detuning sigma_e of (10.6)."""
        return 1.0 + self.epsilon * self.sigma_e_hat

    @property
    def period(self) -> float:
        """Forcing period 2 pi / Omega in units of tau."""
        return 2.0 * math.pi / self.Omega

    @property
    def forcing(self) -> np.ndarray:
        """Forcing amplitudes f_10 and f_20 of (10.4), as an array of shape (2,)."""
        return self.epsilon * np.array([self.f10_hat, self.f20_hat])

    @property
    def modules(self) -> tuple[int, ...]:
        """Numbers of the active modules: (1, 2), (1,), (2,) or ().

        A module is active if a force drives it, directly or through the coupling. Analyses leave out inactive
        modules, but `simulate` integrates them.
        """
        forced = [module for module, force in ((1, self.f10_hat), (2, self.f20_hat)) if force != 0]
        coupled = self.alpha12_hat != 0 or self.gamma12_hat != 0
        return (1, 2) if coupled and forced else tuple(forced)

    def with_inactive_damped(self) -> "System":
        """Return a copy of the system with a damped inactive box, which then has no undamped resonance.

        In the copy, gamma1_hat or gamma2_hat of the inactive box is 1. The results do not depend on this value, since
        the inactive box is at rest.

        Returns
        -------
        System
            The copy if exactly one module is active, else the system itself.
        """
        if len(self.modules) != 1:
            return self
        return self.with_(**{f"gamma{3 - self.modules[0]}_hat": 1.0})

    def with_(self, **changes: float) -> "System":
        """Return a copy of the system with some parameters changed.

        Parameters
        ----------
        **changes : float
            New value of each parameter to change, with the name of the parameter as keyword.

        Returns
        -------
        System
            The new system.

        Raises
        ------
        ValueError
            As for System.
        TypeError
            If a keyword is not the name of a parameter.

        Examples
        --------
        >>> system.with_(kappa=0.5).kappa
        0.5
        """
        return replace(self, **changes)

    def _resonates(self) -> bool:
        """Return True if a force drives the undamped boxes at a resonance."""
        stiffness = dynamic_stiffness(self)
        # Rounding errors are proportional to the sum of the moduli of all terms. The entries of the matrix can be much
        # smaller than this sum, since terms with opposite signs cancel.
        springs = 1.0 + self.stiffness2 + 2.0 * self.alpha12
        dampers = self.gamma1 + self.gamma2 + 2.0 * self.gamma12
        rounding = 1e-12 * (springs + self.Omega * (dampers + 2.0 * self.Omega))
        (a, b), (c, d) = stiffness.tolist()
        if abs(a * d - b * c) > rounding * 1e12 * rounding:
            return False  # both singular values are larger than `rounding`
        left, values, _ = np.linalg.svd(stiffness)
        loads = abs(left[:, values <= rounding].conj().T @ self.forcing)
        return bool((loads > 1e-12 * np.linalg.norm(self.forcing)).any())
