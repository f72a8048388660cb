// The two-module system (10.2), integrated exactly from event to event: impact, chatter, sticking and release.
//
// Between events the boxes obey a linear equation with a sinusoidal force. Their motion over a step is a power series that
// is exact to rounding, so that the gap between ball and wall is a polynomial. The turning points of the gap are found
// first, and then a zero between two turning points, so that even a shallow crossing is not missed. A test compares this
// program with the engine of the library (src/vibroimpact/exact/engine).
"use strict";

const VibroImpact = (() => {
  const DEGREE = 16, STEP = 0.5, ROUNDING = 4 * Number.EPSILON;
  const NEGLIGIBLE = 1e-18, LOW = 1e-12; // a chatter ends if the change of the state and the hop are below these
  const MOST_EVENTS = 100000; // maximum number of events in one call of advance

  const value = (c, t) => c.reduceRight((sum, coefficient) => sum * t + coefficient, 0);
  const derivative = (c) => c.slice(1).map((coefficient, k) => (k + 1) * coefficient);

  // Return true if a polynomial certainly has no zero on [0, T], because its first coefficient outweighs all others.
  function hasNoZero(c, T) {
    let others = 0;
    for (let k = c.length - 1; k > 0; k--) others = (others + Math.abs(c[k])) * T;
    return Math.abs(c[0]) > others;
  }

  // Find the zero of a polynomial between two places with opposite signs, by Newton's method safeguarded by bisection.
  function zeroBetween(c, a, b) {
    const slope = derivative(c), sign = Math.sign(value(c, a)) || -Math.sign(value(c, b));
    let t = 0.5 * (a + b);
    for (let n = 0; n < 100; n++) {
      const y = value(c, t);
      if (y === 0) return t;
      if (y * sign > 0) a = t; else b = t;
      const newton = t - y / value(slope, t), next = newton > a && newton < b ? newton : 0.5 * (a + b);
      if (Math.abs(next - t) <= 1e-16 * b || next === t) return next;
      t = next;
    }
    return t;
  }

  // Find all sign changes of a polynomial in (0, T), in ascending order. Between two turning points there is at
  // most one change.
  function zeros(c, T) {
    if (c.length < 2 || hasNoZero(c, T)) return [];
    const ends = [0, ...zeros(derivative(c), T), T], found = [];
    for (let n = 1; n < ends.length; n++) {
      if (value(c, ends[n - 1]) * value(c, ends[n]) < 0) found.push(zeroBetween(c, ends[n - 1], ends[n]));
    }
    return found;
  }

  // Find the first time in (0, T] at which an initially positive polynomial becomes negative, or return Infinity.
  function firstFall(c, T) {
    if (hasNoZero(c, T) && c[0] > 0) return Infinity;
    let before = 0;
    for (const end of [...zeros(derivative(c), T), T]) {
      if (value(c, end) < 0) return zeroBetween(c, before, end);
      before = end;
    }
    return Infinity;
  }

  // Compute the coefficients of (10.2) from the hatted parameters of (10.4) to (10.6).
  function coefficients({ epsilon: e, kappa, alpha12_hat, gamma1_hat, gamma2_hat, gamma12_hat, sigma20_hat, sigma_e_hat, f10_hat, f20_hat }) {
    const spring = e * alpha12_hat, damper = e * gamma12_hat, omega = 1 + e * sigma_e_hat;
    const K = [[1 + spring, -spring], [-spring, 1 + e * sigma20_hat + spring]];
    const C = [[e * gamma1_hat + damper, -damper], [-damper, e * gamma2_hat + damper]];
    const norm = (m) => Math.max(...m.map((row) => Math.abs(row[0]) + Math.abs(row[1])));
    const fastest = Math.max(1, omega, Math.sqrt(norm(K)), norm(C));
    return { e, kappa, K, C, omega, f: [e * f10_hat, e * f20_hat], step: STEP / fastest, period: 2 * Math.PI / omega };
  }

  // A run from a state [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] at tau = 0. Events are appended to `events`, which may be cleared.
  class Run {
    constructor(parameters, state) {
      this.system = coefficients(parameters);
      [this.X, this.Y] = [[state[0], state[2]], [state[1], state[3]]];
      [this.V, this.U] = [[state[4], state[6]], [state[5], state[7]]];
      this.stuck = [0, 0]; // for each ball, the wall, +1 or -1, to which it sticks; 0 if it flies
      this.touching = [0, 0]; // for each ball, the wall that it touches after an impact or a release; else 0
      this.tau = 0;
      this.phase = 0; // phase of the force, modulo 2 pi
      this.events = [];
      this.resolve(-1);
    }

    get state() {
      const { X, Y, V, U } = this;
      return [X[0], Y[0], X[1], Y[1], V[0], U[0], V[1], U[1]];
    }

    // Continue with other parameters; the forcing frequency must stay the same.
    change(parameters) {
      this.system = coefficients(parameters);
      this.resolve(-1);
    }

    // Compute the power series of X1 and X2, given the walls to which the balls stick.
    series(stuck) {
      const { e, K, C, f, omega } = this.system, a = [[this.X[0], this.V[0]], [this.X[1], this.V[1]]];
      const mass = stuck.map((wall) => (wall ? 1 + e : 1)), turn = [Math.sin(this.phase), Math.cos(this.phase)];
      for (let k = 0, scale = 1; k < DEGREE - 1; k++, scale *= omega / k) {
        const force = scale * turn[k % 2] * (k % 4 < 2 ? 1 : -1);
        for (const i of [0, 1]) {
          const pull = K[i][0] * a[0][k] + K[i][1] * a[1][k] + (k + 1) * (C[i][0] * a[0][k + 1] + C[i][1] * a[1][k + 1]);
          a[i].push((f[i] * force - pull) / (mass[i] * (k + 1) * (k + 2)));
        }
      }
      return a;
    }

    // Return the rounding error of an acceleration (tiny) or of a gap (blur) in module i.
    tiny(i) {
      const { K, C, f } = this.system, { X, V } = this;
      return ROUNDING * (Math.abs(f[i]) + [0, 1].reduce((sum, j) => sum + Math.abs(K[i][j] * X[j]) + Math.abs(C[i][j] * V[j]), 0));
    }

    blur(i) {
      return ROUNDING * (2 + [...this.X, ...this.V, this.Y[i], this.U[i]].reduce((sum, x) => sum + Math.abs(x), 0));
    }

    // Return the time until the next event of module i (impact, or release of a sticking ball); Infinity if it is after T.
    next(i, series, T) {
      const a = series[i], wall = this.stuck[i];
      if (wall) return firstFall(derivative(derivative(a)).map((force) => wall * force), T);
      let first = Infinity;
      for (const side of [1, -1]) {
        let gap = a.map((coefficient) => -side * coefficient);
        gap[0] = 1 - side * (this.X[i] - this.Y[i]);
        gap[1] = -side * (this.V[i] - this.U[i]);
        if (this.touching[i] === side) { // divide the polynomial by t, because the gap is zero at the start
          gap = gap.slice(1);
          if (gap[0] === 0) gap = gap.slice(Math.abs(2 * gap[1]) <= this.tiny(i) ? 2 : 1);
        }
        first = Math.min(first, firstFall(gap, Math.min(T, first)));
      }
      return first;
    }

    // Advance by a time dt, event by event.
    advance(dt) {
      for (let left = dt, events = 0; left > 0;) {
        const series = this.series(this.stuck);
        let t = Math.min(left, this.system.step), due = -1;
        for (const i of [0, 1]) {
          const event = this.next(i, series, t);
          if (event <= t) [t, due] = [event, i];
        }
        for (const i of [0, 1]) {
          [this.X[i], this.V[i]] = [value(series[i], t), value(derivative(series[i]), t)];
          this.Y[i] = this.stuck[i] ? this.X[i] - this.stuck[i] : this.Y[i] + t * this.U[i];
          if (this.stuck[i]) this.U[i] = this.V[i];
        }
        this.tau += t;
        this.phase = (this.phase + t * this.system.omega) % (2 * Math.PI);
        if (t > 0) this.touching = [0, 0];
        left -= t;
        if (due >= 0 && ++events > MOST_EVENTS) throw new Error(`more than ${MOST_EVENTS} events before tau = ${this.tau}`);
        this.resolve(due);
      }
    }

    note(i, wall, kind, speed = 0, tau = this.tau) {
      this.events.push({ tau, module: i + 1, wall, kind, speed, state: this.state });
    }

    // Process all events at the current time: impacts, then balls at rest on a wall, then completed chatters.
    resolve(due) {
      const hit = [0, 1].map((i) => !this.stuck[i] && this.meet(i, i === due)), pulled = due >= 0 && this.stuck[due] ? due : -1;
      for (const i of [0, 1]) this.rest(i, i === pulled);
      const completed = [0, 1].map((i) => hit[i] && this.touching[i] !== 0 && this.complete(i));
      if (completed[0] || completed[1]) for (const i of [0, 1]) if (this.stuck[i] && !completed[i]) this.rest(i, false);
    }

    // If a flying ball hits a wall, apply Newton's impact law with conserved momentum (system/restitution.py) and return true.
    meet(i, due) {
      const { e, kappa } = this.system, W = this.X[i] - this.Y[i], dW = this.V[i] - this.U[i], wall = W > 0 ? 1 : -1;
      if (!due && 1 - wall * W > this.blur(i)) return false;
      const slow = ROUNDING * (Math.abs(this.V[i]) + Math.abs(this.U[i]));
      this.touching[i] = wall;
      if (!due && wall * dW < -slow && wall * W < 1) return false;
      this.Y[i] = this.X[i] - wall;
      if (Math.abs(dW) <= slow) this.U[i] = this.V[i];
      if (Math.abs(dW) <= slow || wall * dW < 0) return false;
      this.V[i] -= (e * (1 + kappa) * dW) / (1 + e);
      this.U[i] = this.V[i] + kappa * dW;
      if (kappa * Math.abs(dW) <= ROUNDING * (Math.abs(dW) + Math.abs(this.V[i]) + Math.abs(this.U[i]))) this.join(i);
      this.note(i, wall, "impact", Math.abs(dW));
      return true;
    }

    // Give ball i the velocity of its box, with conserved momentum.
    join(i) {
      const { e } = this.system;
      this.V[i] = this.U[i] = this.V[i] - (e * (this.V[i] - this.U[i])) / (1 + e);
    }

    // Make a ball at rest on a wall stick if the force presses it to the wall; release it when the force changes sign.
    rest(i, pulled) {
      const wall = this.stuck[i] || (this.V[i] === this.U[i] ? this.touching[i] : 0);
      if (!wall) return;
      const both = [...this.stuck];
      both[i] = wall;
      const jet = this.series(both)[i].map((coefficient) => wall * coefficient), sticks = this.stuck[i] !== 0;
      const tiny = this.tiny(i), force = 2 * jet[2], change = 6 * jet[3];
      let hold = force; // its sign decides; if the force is 0 within rounding, its first nonzero derivative is used
      if (Math.abs(force) <= tiny) hold = jet.slice(3, 6).find((coefficient) => coefficient !== 0) ?? 0;
      else if (sticks && force < 0 && change > 0 && -(force ** 3) < tiny * change ** 2) hold = change; // pulled too briefly for a release
      const leaves = sticks && ((pulled && change < 0) || hold < 0);
      if (leaves || (!sticks && hold > 0)) {
        this.note(i, wall, leaves ? "release" : "stick");
        [this.stuck[i], this.touching[i]] = leaves ? [0, wall] : [wall, 0];
      }
    }

    // Complete the chatter of ball i if its remaining hops are negligible. Each hop is kappa times as long as the previous
    // hop, so that all hops together take 2 speed / (push (1 - kappa)). Return true if the chatter was completed.
    complete(i) {
      const { e, kappa, K } = this.system, series = this.series(this.stuck), jet = series[i], wall = this.touching[i];
      const push = 2 * wall * jet[2], speed = -wall * (this.V[i] - this.U[i]), height = (speed * speed) / (2 * push);
      if (push <= this.tiny(i)) return false;
      const neglected = (e * (K[0][0] + K[1][1]) * speed ** 3) / (push * push * (1 - kappa ** 3)), unresolved = height <= this.blur(i);
      if ((neglected > NEGLIGIBLE || height > LOW) && !unresolved) return false;
      const total = (2 * speed) / (push * (1 - kappa)), window = 2 * total;
      if (window > this.system.step || 24 * window * Math.abs(jet[3]) > push) return false;
      const clear = this.next(1 - i, series, window) > window;
      if (!clear && !unresolved) return false;
      this.join(i);
      [this.stuck[i], this.touching[i]] = [wall, 0];
      this.note(i, wall, "stick", 0, this.tau + (clear ? total : 0));
      return true;
    }
  }

  return { Run };
})();
