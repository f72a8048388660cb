// What the theory predicts: the fixed points of the slow flow on the invariant manifold, (10.16) and (10.23), their
// labels, and the response (10.9), (10.10) of each. The library's search (src/vibroimpact/theory) proves that none is
// missing; this one looks at the cells of a grid, and a test holds its points against the library's.
"use strict";

const SlowFlow = (() => {
  const HARMONIC = 8 / Math.PI ** 2, SYMMETRY_BREAKING_C = Math.PI ** 2 / (Math.PI ** 2 - 4);
  const LARGEST_C = 6, CELLS = 100, SETTLED = 1e-11, SAME = 1e-6;

  const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
  const plus = ([a, b], [c, d]) => [a + c, b + d];
  const minus = ([a, b], [c, d]) => [a - c, b - d];
  const scaled = ([a, b], factor) => [a * factor, b * factor];
  const square = ([a, b]) => a * a + b * b;
  const over = (a, b) => scaled(times(a, [b[0], -b[1]]), 1 / square(b));
  const turned = (angle) => [Math.cos(angle), Math.sin(angle)];

  const rho = (kappa) => (2 * (1 - kappa)) / (Math.PI * (1 + kappa));
  const amplitude = (C, r) => Math.hypot(1 - C, r * C);

  // Impedance of a module with its ball, times B: what multiplies exp(-i psi) in the balance of forces.
  function own(p, i, C, r) {
    const B = amplitude(C, r), impedance = [(i ? p.sigma20_hat : 0) - 2 * p.sigma_e_hat + p.alpha12_hat, p[`gamma${i + 1}_hat`] + p.gamma12_hat];
    return plus(scaled(impedance, B), scaled([C * (1 - C), r * C * C], HARMONIC / B));
  }

  // Numerators n1, n2 and denominator of exp(-i psi_i), linear in the balance of forces of both modules.
  function balance(p, C, r) {
    const q = [0, 1].map((i) => own(p, i, C[i], r)), K = [p.alpha12_hat, p.gamma12_hat], B = C.map((c) => amplitude(c, r));
    const f = [p.f10_hat, p.f20_hat], numerators = [0, 1].map((i) => plus(scaled(q[1 - i], f[i]), scaled(K, B[1 - i] * f[1 - i])));
    return { numerators, denominator: minus(times(q[0], q[1]), scaled(times(K, K), B[0] * B[1])) };
  }

  // Zero where both phases exist: the moduli of both phase factors are one.
  function excess(p, C, r) {
    const { numerators, denominator } = balance(p, C, r);
    return numerators.map((n) => square(n) - square(denominator));
  }

  function newton(p, C, r) {
    const h = 1e-7;
    for (let n = 0; n < 40; n++) {
      const [a, b] = excess(p, C, r), columns = [0, 1].map((k) => {
        const moved = [1, -1].map((sign) => excess(p, C.map((c, i) => c + (i === k ? sign * h : 0)), r));
        return [0, 1].map((i) => (moved[0][i] - moved[1][i]) / (2 * h));
      });
      const D = columns[0][0] * columns[1][1] - columns[1][0] * columns[0][1];
      const step = [(a * columns[1][1] - b * columns[1][0]) / D, (b * columns[0][0] - a * columns[0][1]) / D];
      C = C.map((c, i) => c - step[i]);
      if (!C.every((c) => c > 0 && c < 2 * LARGEST_C)) return null;
      if (Math.max(...step.map(Math.abs)) < SETTLED) return C;
    }
    return null;
  }

  // (D_1 B_1, D_1 psi_1, D_1 B_2, D_1 psi_2), (10.22).
  function rates(p, C, psi, r) {
    const B = C.map((c) => amplitude(c, r)), K = [p.alpha12_hat, p.gamma12_hat];
    return [0, 1].flatMap((i) => {
      const force = scaled(turned(psi[i]), p[`f${i + 1}0_hat`]), other = scaled(times(K, turned(psi[i] - psi[1 - i])), B[1 - i]);
      const drive = minus(plus(force, other), own(p, i, C[i], r));
      return [drive[1] / 2, drive[0] / (2 * B[i])];
    });
  }

  // Largest real part of the eigenvalues of the slow flow, per unit of tau_1.
  function growth(p, C, psi, r) {
    const h = 1e-6, slope = (k) => ((1 + r * r) * C[k] - 1) / amplitude(C[k], r);
    const columns = [0, 1, 2, 3].map((k) => {
      const at = (sign) => rates(p, C.map((c, i) => c + (2 * i === k ? sign * h : 0)), psi.map((s, i) => s + (2 * i + 1 === k ? sign * h : 0)), r);
      const [ahead, behind] = [at(1), at(-1)];
      return ahead.map((rate, i) => (rate - behind[i]) / (2 * h));
    });
    const J = [0, 1, 2, 3].map((i) => columns.map((column) => column[i] / (i % 2 ? 1 : slope(i / 2))));
    return Math.max(...eigenvalues(J).map(([real]) => real));
  }

  // Of a real matrix: Faddeev and LeVerrier's characteristic polynomial, its zeros by Durand and Kerner's iteration.
  function eigenvalues(A) {
    const n = A.length, c = [1], product = (M) => A.map((row) => A.map((_, j) => row.reduce((sum, x, k) => sum + x * M[k][j], 0)));
    let M = A.map((row) => row.map(() => 0));
    for (let k = 1; k <= n; k++) {
      M = product(M).map((row, i) => row.map((x, j) => x + (i === j ? c[k - 1] : 0)));
      c.push(-product(M).reduce((sum, row, i) => sum + row[i], 0) / k);
    }
    const size = Math.max(...c.map((x, k) => (k ? Math.abs(x) ** (1 / k) : 0))) || 1;
    let zeros = A.map((_, k) => scaled(turned(0.4 + (2 * Math.PI * k) / n), size));
    for (let step = 0; step < 300; step++) {
      zeros = zeros.map((z, i) => {
        const value = c.reduce((sum, x) => plus(times(sum, z), [x, 0]), [0, 0]);
        return minus(z, over(value, zeros.reduce((all, other, j) => (j === i ? all : times(all, minus(z, other))), [1, 0])));
      });
    }
    return zeros;
  }

  // Every fixed point with C_1, C_2 > 0, by its label: {label, C, B, psi, printed, both}; printed: (10.26) calls it stable,
  // both: so do Masri's analysis, derived anew, and the slow flow together.
  function fixedPoints(p) {
    const r = rho(p.kappa), h = LARGEST_C / CELLS, place = (n) => (n + 0.37) * h, found = [];
    const signs = Array.from({ length: CELLS + 1 }, (_, i) => Array.from({ length: CELLS + 1 }, (_, j) => excess(p, [place(i), place(j)], r).map((x) => x > 0)));
    // Two zeros next to each other may share a cell, or hide on both sides of an edge: the cells around are looked at, too.
    const mixed = (i, j, k) => {
      const around = signs.slice(Math.max(i - 1, 0), i + 3).flatMap((row) => row.slice(Math.max(j - 1, 0), j + 3));
      return around.some((at) => at[k]) && around.some((at) => !at[k]);
    };
    for (let i = 0; i < CELLS; i++) {
      for (let j = 0; j < CELLS; j++) {
        if (!mixed(i, j, 0) || !mixed(i, j, 1)) continue;
        const C = newton(p, [place(i) + h / 2, place(j) + h / 2], r);
        if (C && !found.some((other) => Math.hypot(C[0] - other[0], C[1] - other[1]) < SAME)) found.push(C);
      }
    }
    const limit = 4 / (4 + Math.PI * r), points = found.map((C) => {
      const { numerators, denominator } = balance(p, C, r), psi = numerators.map((n) => { const z = over(n, denominator); return Math.atan2(-z[1], z[0]); });
      const rate = growth(p, C, psi, r), fast = C.every((c) => c > 1 / (1 + r * r) && c < SYMMETRY_BREAKING_C);
      return { C, B: C.map((c) => amplitude(c, r)), psi, growth: rate, printed: C.every((c) => c > limit), both: fast && rate < 0 };
    });
    points.sort((a, b) => a.printed - b.printed || b.growth - a.growth); // as the chapter's pictures label them
    return points.map((point, n) => ({ label: "abcdefgh"[n], ...point }));
  }

  // (X_i, W_i) of module i (0, 1) of a fixed point at a phase of the force, (10.9) to (10.12).
  function response(p, { C, B, psi }, i, phase) {
    const angle = phase - psi[i], theta = Math.atan2(1 - C[i], rho(p.kappa) * C[i]), U = B[i] * Math.sin(angle);
    const round = 2 * Math.PI, fromPeak = Math.abs(((((angle - theta + Math.PI) % round) + round) % round) - Math.PI);
    const W = U + C[i] * (1 - (2 * fromPeak) / Math.PI);
    return { X: (U + p.epsilon * W) / (1 + p.epsilon), W };
  }

  return { fixedPoints, response };
})();
