"""Event loop of the reference simulation in interval arithmetic: flights, impacts, chatter, sticking and release."""

from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from flint import arb, arb_poly, ctx

from vibroimpact.accuracy.reference.chatter import Chatter
from vibroimpact.accuracy.reference.roots import Undecidable, first_root, refine
from vibroimpact.accuracy.reference.taylor_models import ExactSystem, Flow, to_ball, to_fraction
from vibroimpact.system.state import IMPACT, RELEASE, STICK

LISTED_SPEED = Fraction(1, 10**12)  # impacts of a completed chatter are recorded only above this rebound speed |W'|
GUARD_BITS = 64  # binary digits of precision in addition to the requested digits
SEARCH_BITS = 96  # binary digits of precision that suffice to find most events


@dataclass
class _Ball:
    """Motion of one ball relative to its box: gap W, its rate W', and the wall that the ball touches, or 0.

    order: number of leading Taylor coefficients that are 0 in the contact force (stuck ball) or in the distance
    1 - wall * W (ball that leaves its wall). If the contact force stays 0, the order is None.
    """

    gap: arb
    rate: arb
    wall: int = 0
    order: int | None = 0
    stuck: bool = False


@dataclass(frozen=True)
class _Candidate:
    """Event that may end the flight: an impact or a release.

    root: time of the event. The distance to the wall (at an impact) or the contact force (at a release) is then 0.
    """

    module: int
    wall: int
    root: arb


@dataclass
class Trajectory:
    """Simulation in progress, at the working precision of the caller.

    record: list of events; an event is a tuple of tau, module (0 or 1), wall, kind and the state just after the event.
    """

    system: ExactSystem
    start: list
    tau0: Fraction
    cycles: Fraction
    bits: int
    sample_times: object
    chatters: int = 0
    record: list = field(default_factory=list)
    samples: list = field(default_factory=list)

    def __post_init__(self):
        x1, y1, x2, y2, v1, u1, v2, u2 = self.start
        self.tau = to_ball(self.tau0).mid()
        self.box = [to_ball(value).mid() for value in (x1, x2, v1, v2)]
        gaps = (x1 - y1, v1 - u1), (x2 - y2, v2 - u2)
        self.balls = [_Ball(to_ball(gap).mid(), to_ball(rate).mid()) for gap, rate in gaps]
        self.omega = to_ball(self.system.Omega)
        self.kappa = to_ball(self.system.kappa)
        self.impulse = to_ball(self.system.epsilon * (1 + self.system.kappa) / (1 + self.system.epsilon))
        self.end = (to_ball(self.tau0) + 2 * arb.pi() * to_ball(self.cycles) / self.omega).mid()
        self.tolerance = arb(2) ** -self.bits
        self.flows = {}
        self.chatter = None
        self.pending = self._sample_queue()

    def _sample_queue(self):
        times = [] if self.sample_times is None else list(self.sample_times)
        # A float is read as its binary value, because sample times such as k * period are computed as floats.
        rational = [Fraction(float(t)) if isinstance(t, float) else to_fraction("sample_times", t) for t in times]
        if any(later < earlier for earlier, later in pairwise(rational)):
            raise ValueError("sample_times: should be ascending")
        balls = [to_ball(t).mid() for t in rational]
        if balls and (balls[0] < self.tau - self.tolerance or balls[-1] > self.end + self.tolerance):
            raise ValueError(f"sample_times: should be within the run, from {float(self.tau)} to {float(self.end)}")
        return balls[::-1]

    # -- the loop ----------------------------------------------------------------------------------------

    def run(self):
        """Compute `record`, `samples` and the final state."""
        self._meet_walls_at_start()
        while self.tau < self.end:
            self._fly()
        self._settle()
        self.samples += [self.state() for _ in self.pending]

    def _fly(self):
        """Advance to the next event, to the end of the run or by `Flow.longest_step`, whichever comes first."""
        self._settle()
        flow, search_flow = self._flow(self.bits + GUARD_BITS), self._flow(SEARCH_BITS)
        vector = self._vector()
        series, search_series = flow.series(vector), search_flow.series(vector)
        longest = to_ball(flow.longest_step).mid()
        candidates = self._next_events(series, search_series, longest)
        remaining = self.end - self.tau
        if candidates and candidates[0].root < remaining + self.tolerance:
            step = candidates[0].root
        else:
            candidates, step = [], longest.min(remaining)
        self._sample(search_series, step)
        self._advance(series, step, candidates)
        impacts = [candidate for candidate in candidates if not self.balls[candidate.module].stuck]
        for candidate in impacts:
            self._impact(candidate.module)
        self._follow_chatter(tuple((candidate.module, candidate.wall) for candidate in impacts))

    # -- state -------------------------------------------------------------------------------------------

    def state(self):
        relative = *(ball.gap for ball in self.balls), *(ball.rate for ball in self.balls)
        return [one for box, W in zip(self.box, relative, strict=True) for one in (box, (box - W).mid())]

    def _vector(self):
        return [*self.box, *(self.omega * self.tau).sin_cos()]

    def _flow(self, bits):
        stuck = tuple(ball.stuck for ball in self.balls)
        if (stuck, bits) not in self.flows:
            self.flows[stuck, bits] = Flow(self.system, stuck, bits)
        return self.flows[stuck, bits]

    def _note(self, module, kind):
        self.record.append((self.tau, module, self.balls[module].wall, kind, tuple(self.state())))

    def _point(self, value):
        """Return the midpoint of an enclosure; the next flight starts from this midpoint."""
        if not value.rad() < self.tolerance:
            raise Undecidable(f"the state after a flight is known only to within {value.rad()}; use more digits")
        return value.mid()

    def _advance(self, series, step, arriving):
        walls = {candidate.module: candidate.wall for candidate in arriving}
        box = [p(step) for p in series] + [p.derivative()(step) for p in series]
        for i, ball in enumerate(self.balls):
            if ball.stuck:
                continue
            place, speed = self._free(i, step)
            ball.gap = arb(walls[i]) if i in walls else self._point(box[i] - place)
            ball.rate = self._point(box[2 + i] - speed)
            ball.wall, ball.order = walls.get(i, 0), 0
        self.box = [self._point(value) for value in box]
        self.tau = self._point(self.tau + step)

    def _free(self, i, t):
        """Return Y and Y' of ball i after a time t of free flight."""
        speed = self.box[2 + i] - self.balls[i].rate
        return self.box[i] - self.balls[i].gap + speed * t, speed

    def _sample(self, series, step):
        """Append the states at the sample times within a flight of length `step`."""
        stop = self.tau + step - self.tolerance
        if not (self.pending and self.pending[-1] < stop):
            return
        with ctx.workprec(SEARCH_BITS):
            speeds = [p.derivative() for p in series]
            while self.pending and self.pending[-1] < stop:
                t = (self.pending.pop() - self.tau).mid()
                places, rates = [], []
                for i, ball in enumerate(self.balls):
                    x, v = series[i](t), speeds[i](t)
                    y, u = (x - ball.gap, v) if ball.stuck else self._free(i, t)
                    places, rates = [*places, x, y], [*rates, v, u]
                self.samples.append(places + rates)

    # -- the next event ----------------------------------------------------------------------------------

    def _next_events(self, series, search_series, longest):
        """Return the earliest event within the time `longest`, and all events that are at most `tolerance` later."""
        try:
            with ctx.workprec(SEARCH_BITS):
                found = self._bracket(search_series, longest)
                found = [(keys, refine(self._distance(keys, search_series), ball)) for keys, ball in found]
        except Undecidable:
            found = self._bracket(series, longest)
        found = _earliest(found, arb(0))
        found = [(keys, refine(self._distance(keys, series), ball)) for keys, ball in found]
        return [_Candidate(module, wall, root.mid()) for (module, wall), root in _earliest(found, self.tolerance)]

    def _bracket(self, series, longest):
        """Return a pair (key, interval) for each event that may be the first one.

        The key is (module, wall). The interval contains the first root of the series `_distance` of this key.
        """
        keys = []
        for module, ball in enumerate(self.balls):
            if not ball.stuck:
                keys += [(module, 1), (module, -1)]
            elif ball.order is not None:  # if the order is None, the force stays 0, and the ball stays stuck
                keys.append((module, ball.wall))
        distances = [(key, self._distance(key, series)) for key in keys]
        hints = {key: _parabola_hint(distance, longest) for key, distance in distances}
        found, end = [], longest
        for key, distance in sorted(distances, key=lambda item: hints[item[0]] is None):
            hint = hints[key]
            ball = first_root(distance, end, hint if hint is not None and hint < end else None)
            if ball is not None:
                found.append((key, ball))
                end = end.min(ball.upper())
        return found

    def _distance(self, key, series):
        """Return the distance to a wall, or the contact force on a stuck ball, as a power series in time.

        If the first k coefficients are 0, the series is divided by the k-th power of time. The result is positive until
        the event.
        """
        module, wall = key
        ball = self.balls[module]
        if ball.stuck:
            return _force(ball, series[module]).right_shift(ball.order)
        relative = arb_poly(series[module])  # W = X - Y has the terms of X from t^2 on, since Y is linear
        relative[0], relative[1] = ball.gap, ball.rate
        distance = -relative if wall > 0 else relative
        if ball.wall == wall:
            return distance.right_shift(ball.order)
        distance[0] = 1 + distance[0]
        return distance

    # -- events ------------------------------------------------------------------------------------------

    def _meet_walls_at_start(self):
        gaps = (self.start[0] - self.start[1], self.start[2] - self.start[3])
        touching = [i for i in range(2) if abs(gaps[i]) == 1]
        for i in touching:
            self.balls[i].wall = int(gaps[i])
            if self.balls[i].wall * self.balls[i].rate > 0:
                self._impact(i)
            self.balls[i].order = 1
        for i in touching:
            if self.balls[i].rate.is_zero():
                self.balls[i].stuck = True
                self._settle(i, started=True)

    def _impact(self, module):
        """Apply Newton's restitution law. If the rebound speed is below `tolerance`, let the ball stick."""
        ball = self.balls[module]
        if not ball.wall * ball.rate > -self.tolerance:
            raise Undecidable("cannot decide whether a ball at a wall moves towards the wall; use more digits")
        self.box[2 + module] = self._point(self.box[2 + module] - self.impulse * ball.rate)
        ball.rate, ball.order = self._point(-self.kappa * ball.rate), 1
        self._note(module, IMPACT)
        if abs(ball.rate) < self.tolerance:
            self._stick(module)

    def _stick(self, module):
        ball = self.balls[module]
        ball.gap, ball.rate, ball.stuck, ball.order = arb(ball.wall), arb(0), True, 0
        self._note(module, STICK)

    def _settle(self, *modules, started=False):
        """Release each stuck ball whose contact force is negative just after this instant.

        The sign of the force is the sign of its first nonzero Taylor coefficient. Coefficients of absolute value up to
        `tolerance` count as 0.

        started: True at the start of a run, where a release is not recorded.
        """
        for module in modules or range(2):
            ball = self.balls[module]
            if not ball.stuck:
                continue
            series = self._flow(self.bits + GUARD_BITS).series(self._vector())
            force = _force(ball, series[module]).coeffs()
            ball.order = next((k for k, value in enumerate(force) if abs(value) > self.tolerance), None)
            if ball.order is None or force[ball.order] > 0:
                continue
            ball.stuck = False
            ball.order += 2  # in free flight the distance grows like t^2 times the force
            if not started:
                self._note(module, RELEASE)

    # -- chatter -----------------------------------------------------------------------------------------

    def _follow_chatter(self, contacts):
        """Add the simultaneous impacts `contacts` to the current chatter or to a new chatter.

        If `_is_complete` returns True, replace the chatter by its limit.
        """
        if self.chatter is None or self.chatter.contacts != contacts:
            self.chatter = Chatter(contacts, self.system.kappa) if contacts else None
        if not contacts or any(self.balls[module].stuck for module, _ in contacts):
            self.chatter = None
            return
        others = [ball for i, ball in enumerate(self.balls) if i not in dict(contacts)]
        coordinates = [self.tau, *self.box, *(value for ball in others for value in (ball.gap, ball.rate))]
        if self.chatter.add(coordinates) and self._is_complete(contacts):
            self._complete(contacts, others)

    def _is_complete(self, contacts):
        """Return True if the chatter can be replaced by its limit.

        The limit must be accurate. No sample time and no other event may precede the limit. The last rebounds must be
        slow.
        """
        if not self.chatter.change < self.tolerance:
            return False
        if any(abs(self.balls[module].rate) > to_ball(LISTED_SPEED) for module, _ in contacts):
            return False
        time = self.chatter.limit[0] - self.tau
        if abs(time) < self.tolerance:
            return True
        next_stop = self.end if not self.pending else self.end.min(self.pending[-1])
        return bool(time > 0 and self.tau + time < next_stop + self.tolerance and self._is_undisturbed(contacts, time))

    def _is_undisturbed(self, contacts, time):
        """Return True if nothing can disturb the chatter of `contacts` within `time`.

        The contact forces of chattering and stuck balls must certainly stay positive. All other balls must certainly
        stay off the walls.
        """
        flow, vector = self._flow(SEARCH_BITS), self._vector()
        acceleration = flow.size(vector) * to_ball(flow.norm)
        series = flow.series(vector)
        for i, ball in enumerate(self.balls):
            if i in dict(contacts) or ball.stuck:
                if not _force(ball, series[i])[0] > 4 * time * acceleration * to_ball(flow.norm):
                    return False
            elif not 1 - abs(ball.gap) > 2 * time * (abs(ball.rate) + 4 * time * acceleration):
                return False
        return True

    def _complete(self, contacts, others):
        self.chatters += 1
        tau, *values = [self._point(value) for value in self.chatter.limit]
        self._forget_unlisted(dict(contacts))
        self.tau, self.box = tau, values[:4]
        for ball, gap, rate in zip(others, values[4::2], values[5::2], strict=True):
            ball.gap, ball.rate = gap, rate
            if not ball.stuck:
                ball.wall, ball.order = 0, 0
        for module, _ in contacts:
            self._stick(module)
        self.chatter = None

    def _forget_unlisted(self, modules):
        while self.record:
            _, module, _, kind, state = self.record[-1]
            speed = abs(state[4 + 2 * module] - state[5 + 2 * module])
            if kind != IMPACT or module not in modules or speed > to_ball(LISTED_SPEED):
                return
            self.record.pop()


def _force(ball, motion):
    """Return the contact force per ball mass as a power series: w X'' for a ball that rests on the wall w."""
    return ball.wall * motion.derivative().derivative()


def _parabola_hint(distance, longest):
    """Return the argument `hint` of `first_root` for a series `distance`, or None if no hint is useful.

    The hint is twice the root of the linear part of `distance`.
    """
    # In a short flight of a chatter, `distance` is almost linear. The root is then between 0 and the hint.
    height, slope = distance[0], distance[1]
    if not (height > 0 and slope < 0):
        return None
    hint = (-2 * height / slope).mid()
    return hint if 4 * hint < longest else None


def _earliest(found, tolerance):
    """Return the pairs (key, interval) of `found` whose root may be the earliest.

    A pair is left out if its root is certainly more than `tolerance` later than the root of another pair.
    """
    if not found:
        return []
    first = min(ball.upper() for _, ball in found)
    return [(key, ball) for key, ball in found if ball.lower() <= first + tolerance]
