"""Section `machines`: machines in SI units."""

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section

Clearance = fields.real("Half of the play [m]", 1e-6, 1e3)
Hertz = fields.real("Frequency of the forces [Hz]", 1e-3, 1e6)


class Plant(Section):
    """Machines on their springs, as in (10.1), in SI units; without dampers they could not be driven at resonance."""

    M: fields.real("Mass of a box [kg]", 1e-6, 1e9)
    m: fields.real("Mass of a ball [kg], 1e-6 to 10 times that of a box", 1e-6, 1e9)
    k1: fields.real("Stiffness of machine 1 to ground [N/m]", 1e-6, 1e9)
    k2: fields.real("Stiffness of machine 2 to ground [N/m]", 1e-6, 1e9)
    k12: fields.real("Stiffness between them [N/m]", 0, 1e9)
    c1: fields.real("Damping of machine 1 to ground [N s/m]", 1e-6, 1e9)
    c2: fields.real("Damping of machine 2 to ground [N s/m]", 1e-6, 1e9)
    c12: fields.real("Damping between them [N s/m]", 0, 1e9)
    F10: fields.real("Amplitude of the force on machine 1 [N]", 1e-6, 1e9)
    F20: fields.real("Amplitude of the force on machine 2 [N]", 0, 1e9)
    kappa: fields.real("Restitution coefficient", 0.01, 0.99)

    def conditions(self):
        if not 1e-6 <= self.m / self.M <= 10:
            yield ("m",), f"{self.m} should be 1e-6 to 10 times M"


class Band(Section):
    """Frequencies, evenly spaced."""

    range: fields.span(Hertz, "Its ends [Hz]")
    values: fields.count("So many, both ends included", 2, fields.MOST)


class Shown(Section):
    """A motion from rest, drawn over time."""

    L: Clearance
    frequency: Hertz
    cycles: fields.count("Its length [forcing periods]", 1, 1000)


class Machines(Section):
    """Machines in SI units: amplitude over frequency, without and with balls."""

    plant: Plant
    clearances: fields.items(Clearance, 1, 6, "Clearances, half of the play [m]")
    frequencies: Band
    cycles: fields.count("Length of a run [forcing periods]", 1, 100_000)
    settle: fields.count("Cycles of it that are left out [forcing periods]", 0, 100_000)
    shown: Shown

    def conditions(self):
        if self.settle >= self.cycles:
            yield ("settle",), f"{self.settle} should be less than cycles"
