"""Contact logic shared by the event-driven integrators: the law at a wall, where a general integrator stopped.

Without it they could not integrate the system at all: after chatter there is a ball at rest on a wall, which none of
them knows. A ball whose rebound is slower than `slow` sticks if the box presses it against the wall; the infinitely
many impacts left out shift the state by less than their third power. Nothing here checks what the integrator
returns: a ball that it lets through the wall goes on beyond it.
"""

from vibroimpact.integrators.right_hand_side import accelerations, coefficients
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import BALLS, BOXES


class Contacts:
    """The discrete part of a hybrid motion: walls (wall that each ball sticks to, or 0) and the impacts so far."""

    def __init__(self, system, slow: float):
        self.system, self.slow = system, slow
        self.numbers = coefficients(system)
        self.walls = [0, 0]
        self.impacts = []

    @property
    def stuck(self) -> tuple[float, float]:
        """1.0 for each ball that sticks, else 0.0."""
        return float(self.walls[0] != 0), float(self.walls[1] != 0)

    def start(self, tau, s):
        """Balls that rest on a wall at the start stick if they are pressed against it."""
        for i in range(2):
            gap, speed = _relative(s, i)
            if abs(gap) >= 1.0:
                wall = 1 if gap > 0 else -1
                if wall * speed > 0.0:
                    self._impact(tau, s, i, wall)
                self._rest(tau, s, i, wall)

    def resolve(self, tau, s, due):
        """Change the state (8,) in place at an event of the modules `due`: a wall is met, or a force vanishes."""
        for i in range(2):
            gap, speed = _relative(s, i)
            wall = 1 if gap > 0 else -1
            if self.walls[i]:
                if i in due:
                    self.walls[i] = 0
            elif (i in due or abs(gap) >= 1.0) and wall * speed > 0.0:
                self._impact(tau, s, i, wall)
                self._rest(tau, s, i, wall)
        for i in range(2):  # an impact in one module may pull the ball off the wall in the other
            if self.walls[i] and self.press(tau, s, i, self.walls[i]) < 0.0:
                self.walls[i] = 0

    def press(self, tau, s, i, wall):
        """Acceleration with which box i presses a ball at rest on a wall against it; negative: it leaves."""
        return wall * accelerations(tau, s, self.numbers, *self.stuck)[i]

    def shortest_hop(self, tau, s):
        """Duration of the shortest hop that has just begun on a wall, inf if there is none."""
        hops = [float("inf")]
        for i in range(2):
            gap, speed = _relative(s, i)
            wall = 1 if gap > 0 else -1
            if not self.walls[i] and abs(gap) > 1.0 - 1e-12 and wall * speed < 0.0:
                press = self.press(tau, s, i, wall)
                hops.append(-2.0 * wall * speed / press if press > 0.0 else float("inf"))
        return min(hops)

    def _impact(self, tau, s, i, wall):
        x, y = BOXES[i], BALLS[i]
        self.impacts.append((tau, i + 1, wall, wall * (s[4 + x] - s[4 + y])))
        s[y] = s[x] - wall
        s[4 + x], s[4 + y] = after_impact(self.system.epsilon, self.system.kappa, s[4 + x], s[4 + y])

    def _rest(self, tau, s, i, wall):
        x, y = 4 + BOXES[i], 4 + BALLS[i]
        if abs(s[x] - s[y]) <= self.slow and self.press(tau, s, i, wall) > 0.0:
            epsilon = self.system.epsilon
            s[x] = s[y] = (s[x] + epsilon * s[y]) / (1.0 + epsilon)
            self.walls[i] = wall


def _relative(s, i):
    """W_i and W_i'."""
    return s[BOXES[i]] - s[BALLS[i]], s[4 + BOXES[i]] - s[4 + BALLS[i]]
