"""Section `machines`: machines in SI units."""

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section

Clearance = fields.real("Clearance, half of the play [m]", 1e-6, 1e3)
Hertz = fields.real("Frequency of the forces [Hz]", 1e-3, 1e6)


class Plant(Section):
    """Two machines on springs as in (10.1), in SI units. Damping is required to limit the response at resonance."""

    M: fields.real("Mass of a box [kg]", 1e-6, 1e9)
    m: fields.real("Mass of a ball [kg], 1e-6 to 10 times that of a box", 1e-6, 1e9)
    k1: fields.real("Stiffness of machine 1 to ground [N/m]", 1e-6, 1e9)
    k2: fields.real("Stiffness of machine 2 to ground [N/m]", 1e-6, 1e9)
    k12: fields.real("Stiffness of the coupling [N/m]", 0, 1e9)
    c1: fields.real("Damping of machine 1 to ground [N s/m]", 1e-6, 1e9)
    c2: fields.real("Damping of machine 2 to ground [N s/m]", 1e-6, 1e9)
    c12: fields.real("Damping of the coupling [N s/m]", 0, 1e9)
    F10: fields.real("Amplitude of the force on machine 1 [N]", 1e-6, 1e9)
    F20: fields.real("Amplitude of the force on machine 2 [N]", 0, 1e9)
    kappa: fields.real("Restitution coefficient of the balls", 0.01, 0.99)

    def conditions(self):
        if not 1e-6 <= self.m / self.M <= 10:
            yield ("m",), f"{self.m} should be 1e-6 to 10 times M"


class Band(Section):
    """Evenly spaced frequencies in a band."""

    range: fields.span(Hertz, "Lowest and highest frequency [Hz]")
    values: fields.count("Number of frequencies, endpoints included", 2, fields.MAX_VALUES)


class Shown(Section):
    """A motion that starts from rest and is drawn over time."""

    L: Clearance
    frequency: Hertz
    cycles: fields.count("Length of the motion [forcing periods]", 1, 1000)


class Machines(Section):
    """Machines in SI units. A figure shows the amplitude of the boxes against frequency, with and without balls."""

    plant: Plant
    clearances: fields.items(Clearance, 1, 6, "Clearances to compare [m]")
    frequencies: Band
    cycles: fields.count("Length of a run [forcing periods]", 1, 100_000)
    settle: fields.count("Length of the discarded transient [forcing periods]", 0, 100_000)
    shown: Shown

    def conditions(self):
        if self.settle >= self.cycles:
            yield ("settle",), f"{self.settle} should be less than cycles"
