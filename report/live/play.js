// The page "Play": run the exact system with sliders, and show the prediction of the theory for the cases of the config.
"use strict";

const STEPS = 160; // steps per cycle; a frame advances by one or more steps
const SETTLED = 400, SKIPPED = 200, KEPT = 5; // cycles before the page opens, skipped by the button, drawn
const SPEED = 0.5; // initial speed of both balls in a case
const REPEATS = 2e-3; // a motion repeats if the distance between states one period apart is smaller than this
const niceAbove = (x) => [0.25, 0.5, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32].find((end) => end >= x) ?? 2 * x;

// Chart of a quantity over the last cycles: exact values, and the prediction of the theory, which also covers the next moments.
class Strip extends Chart {
  constructor(svg, height, walls) {
    super(svg, height);
    Object.assign(this, { walls, end: walls ? 1.12 : 0.5, top: walls ? 30 : 8, ahead: 0.25 });
    this.grid = mark(this.front, "g");
    this.ghost = mark(this.front, "polyline", "ghost");
    this.line = mark(this.front, "polyline", "exact");
  }

  layout() {
    super.layout();
    this.cycles = this.width > 480 ? 4 : 2.5;
    for (const tick of this.walls ? [-1, 0, 1] : [-this.end, 0, this.end]) {
      mark(this.back, "line", this.walls && tick ? "wall" : "rule", { x1: this.left, x2: this.width - this.right, y1: this.y(tick), y2: this.y(tick) });
      this.text(this.back, this.left - 6, this.y(tick) + (tick === this.end ? 10 : tick === -this.end ? 0 : 4), String(tick).replace("-", "−"), "end");
    }
  }

  y(value) { return this.top + 0.5 * (1 - value / this.end) * this.inner[1]; }

  x(time) { return this.width - this.right - ((this.now + this.ahead - time) / this.cycles) * this.inner[0]; }

  // samples: pairs [time in cycles, value]; predicted: values over one cycle, if any; impacts: times of impacts.
  show(now, samples, predicted, impacts = []) {
    const end = this.walls ? this.end : niceAbove(Math.max(0.1, ...samples.map(([, v]) => Math.abs(v)), ...(predicted ?? []).map(Math.abs)));
    if (end !== this.end) { this.end = end; this.layout(); }
    this.now = now;
    const first = now + this.ahead - this.cycles, place = ([t, v]) => `${this.x(t).toFixed(1)},${this.y(v).toFixed(1)}`;
    this.line.setAttribute("points", samples.filter(([t]) => t >= first).map(place).join(" "));
    const n = predicted?.length ?? 0, from = Math.ceil(first * n), ghost = Array.from({ length: Math.floor(this.cycles * n) }, (_, k) => from + k);
    this.ghost.setAttribute("points", ghost.map((k) => place([k / n, predicted[((k % n) + n) % n]])).join(" "));
    this.grid.replaceChildren();
    for (let cycle = Math.max(0, Math.ceil(first)); cycle <= now; cycle++) {
      mark(this.grid, "line", "rule", { x1: this.x(cycle), x2: this.x(cycle), y1: this.top, y2: this.top + this.inner[1] });
      if (this.x(cycle) > this.left + 20 && this.x(cycle) < this.width - 40) this.text(this.grid, this.x(cycle), this.height - 6, `cycle ${cycle}`);
    }
    impacts.slice(1).forEach((time, k) => this.bracket(impacts[k], time));
  }

  bracket(from, to) {
    const [a, b] = [this.x(from), this.x(to)], y = this.top - 7;
    if (a < this.left || b - a < 4) return;
    mark(this.grid, "path", "bracket", { d: `M${a + 1.5} ${y + 5}V${y}H${b - 1.5}V${y + 5}` });
    if (b - a > 30) mark(this.grid, "text", "share", { x: (a + b) / 2, y: y - 5 }, (to - from).toFixed(2));
  }
}

// Map of both forces with one cell for each point of the sweep; a click or an arrow key chooses a cell.
class RegimeMap extends Chart {
  constructor(parts, data, choose) {
    super(parts.map, 0);
    Object.assign(this, { parts, data, choose, bottom: 36, at: -1, count: Math.sqrt(data.cells.length) });
    parts.regimes.hidden = false;
    for (const [regime, name] of Object.entries(data.names)) {
      const entry = document.createElement("span"), box = document.createElement("b");
      box.className = "line hit";
      box.style.background = data.colours[regime];
      entry.append(box, name);
      parts["regime-key"].append(entry);
    }
    parts.map.addEventListener("click", ({ offsetX, offsetY }) => this.take(...this.cellOf(offsetX, offsetY)));
    parts.map.addEventListener("keydown", (event) => {
      const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
      if (!move) return;
      event.preventDefault();
      const at = Math.max(this.at, 0);
      this.take(Math.floor(at / this.count) + move[0], (at % this.count) + move[1]);
    });
  }

  get size() { return [this.inner[0] / this.count, this.inner[1] / this.count]; }

  cellOf(x, y) { return [Math.floor((x - this.left) / this.size[0]), this.count - 1 - Math.floor((y - this.top) / this.size[1])]; }

  take(column, row) {
    const [i, j] = [column, row].map((n) => Math.min(Math.max(n, 0), this.count - 1));
    this.at = i * this.count + j;
    this.show();
    this.choose(this.data.cells[this.at]);
  }

  layout() {
    super.layout();
    const { cells, colours } = this.data, [width, height] = this.size, last = cells.length - 1, end = cells[0][0] + cells[last][0];
    const corner = (n) => ({ x: this.left + Math.floor(n / this.count) * width, y: this.top + (this.count - 1 - (n % this.count)) * height, width: width + 0.5, height: height + 0.5 });
    cells.forEach(([, , regime], n) => mark(this.back, "rect", "", { ...corner(n), fill: colours[regime] }));
    for (const share of [0, 0.5, 1]) {
      this.text(this.back, this.left + share * this.inner[0], this.height - 20, (share * end).toFixed(1));
      this.text(this.back, this.left - 6, this.top + (1 - share) * this.inner[1] + 4, (share * end).toFixed(1), "end");
    }
    this.text(this.back, this.left + this.inner[0] / 2, this.height - 4, "force on box 1; upwards: on box 2");
    this.corner = corner;
    this.show();
  }

  show() {
    this.front.replaceChildren();
    if (this.at < 0) return;
    const [f10, f20, regime] = this.data.cells[this.at];
    mark(this.front, "rect", "chosen", this.corner(this.at));
    this.parts.place.textContent = `Forces ${f10.toFixed(2)} and ${f20.toFixed(2)}: most often ${this.data.names[regime]}`;
  }
}

// Compute the prediction of the theory for module 2 over one cycle, (10.9) and (10.10), from C, B and psi of a fixed point.
function predicted({ C, B, psi, ...point }, { epsilon, kappa }) {
  const rho = (2 * (1 - kappa)) / (Math.PI * (1 + kappa)), theta = Math.atan2(1 - C, rho * C);
  const U = Array.from({ length: STEPS }, (_, k) => B * Math.sin((2 * Math.PI * k) / STEPS - psi));
  const W = U.map((u, k) => u + (2 / Math.PI) * C * Math.asin(Math.cos((2 * Math.PI * k) / STEPS - psi - theta)));
  return { ...point, W, X: U.map((u, k) => (u + epsilon * W[k]) / (1 + epsilon)) };
}

class Play {
  constructor(root) {
    this.data = dataOf(root);
    this.parts = Object.fromEntries([...root.querySelectorAll("[id^=play-]")].map((part) => [part.id.slice(5), part]));
    const { parts, data } = this;
    for (const one of Object.values(data.cases)) one.points = one.points.map((point) => predicted(point, data.system));
    this.machine = new Machine(parts.machine);
    this.strips = [new Strip(parts.box, 170, false), new Strip(parts.ball, 230, true)];
    this.take(Object.values(data.cases)[0].forces, SETTLED);
    const regimes = document.getElementById("play-map-data");
    if (regimes) this.map = new RegimeMap(parts, JSON.parse(regimes.textContent), (cell) => this.take(cell, SKIPPED, cell[3]));
    new ResizeObserver(() => { for (const chart of [...this.strips, this.map]) chart?.layout(); this.show(); }).observe(root);
    this.clock = new Clock(parts.run, (seconds) => this.simulate(seconds * Number(parts.pace.value)));
    this.connect();
  }

  connect() {
    const { parts, data } = this;
    parts.step.addEventListener("click", () => { this.clock.turn(false); this.simulate(1 / 20); });
    parts.skip.addEventListener("click", () => this.simulate(SKIPPED));
    parts.again.addEventListener("click", () => this.begin(0));
    for (const [part, name] of [["f1", "f10_hat"], ["f2", "f20_hat"], ["kappa", "kappa"]]) {
      parts[part].addEventListener("input", () => {
        this.parameters = { ...this.parameters, [name]: Number(parts[part].value) };
        this.run.change(this.parameters);
        this.sections = [];
        this.changed();
      });
    }
    parts.start.addEventListener("input", () => { this.speed = Number(parts.start.value); this.begin(0); this.changed(); });
    parts.point.addEventListener("change", () => this.show());
    for (const [name, { forces }] of Object.entries(data.cases)) {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: `case ${name}` });
      button.addEventListener("click", () => this.take(forces, 0));
      parts.cases.append(button);
    }
  }

  // Set the forces and restart; `points` are the fixed points at these forces if the forces are not those of a case.
  take([f10_hat, f20_hat], cycles, points = []) {
    this.parameters = { ...this.data.system, f10_hat, f20_hat };
    this.there = { parameters: this.parameters, points: points.map((point) => predicted(point, this.parameters)) };
    this.speed = SPEED;
    this.begin(cycles);
    this.changed();
  }

  // Restart the motion and run the first `cycles` cycles at once.
  begin(cycles) {
    this.run = new VibroImpact.Run(this.parameters, [0, 0, 0, 0, 0, this.speed, 0, this.speed]);
    Object.assign(this, { steps: 0, samples: [], impacts: [], hits: [[-Infinity, -Infinity], [-Infinity, -Infinity]], rest: 0, sections: [] });
    this.simulate(cycles);
  }

  get now() { return this.steps / STEPS; }

  simulate(cycles) {
    const { period } = this.run.system;
    for (this.rest += cycles * STEPS; this.rest >= 1; this.rest--) {
      this.run.advance(period / STEPS);
      this.steps++;
      for (const { tau, module, wall, kind, state } of this.run.events.splice(0)) {
        if (kind === "impact") this.hits[module - 1][wall === 1 ? 0 : 1] = tau / period;
        if (module === 2) this.samples.push([tau / period, state[2], state[2] - state[3]]);
        if (module === 2 && kind === "impact") this.impacts.push(tau / period);
      }
      const { state } = this.run;
      this.samples.push([this.now, state[2], state[2] - state[3]]);
      if (this.steps % STEPS === 0) this.sections.push([state[2], state[6]]);
    }
    while (this.samples[0]?.[0] < this.now - KEPT) this.samples.splice(0, 200);
    this.impacts = this.impacts.filter((time) => time > this.now - KEPT);
    this.show();
  }

  // Update sliders and predictions. Predictions exist only for the cases of the config and the cells of the map.
  changed() {
    const { parts, data, parameters } = this, { f10_hat, f20_hat, kappa } = parameters;
    for (const [part, value] of [["f1", f10_hat], ["f2", f20_hat], ["kappa", kappa], ["start", this.speed]]) {
      const text = part === "start" && !value ? "0: at rest" : value.toFixed(2);
      parts[part].value = value;
      parts[part].setAttribute("aria-valuetext", text);
      parts[part].parentElement.querySelector("output").textContent = text;
    }
    const here = Object.values(data.cases).find(({ forces }) => forces[0] === f10_hat && forces[1] === f20_hat && kappa === data.system.kappa);
    this.points = here?.points ?? (this.there.parameters === parameters ? this.there.points : []);
    parts.point.replaceChildren(...this.points.map(({ label, printed }, n) => new Option(`${label}: ${printed} by the chapter`, n)), new Option("none", ""));
    parts.point.value = this.points.length ? this.points.length - 1 : "";
    this.show();
  }

  // Return the number of cycles after which the Poincaré section repeats, or 0 if it does not repeat.
  get repeats() {
    const points = this.sections, near = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) < REPEATS;
    if (points.length < 20) return 0;
    return [1, 2, 3, 4, 5, 6].find((p) => [1, 2, 3, 4, 5, 6].every((n) => near(points.at(-n), points.at(-n - p)))) ?? 0;
  }

  show() {
    if (!this.points || !this.strips[0].inner) return;
    const { parts, now, samples, strips, repeats, impacts } = this, { state, stuck } = this.run, point = this.points[parts.point.value || -1];
    this.machine.show([state[0], state[2]], [state[1], state[3]], this.hits.map((times) => times.map((time) => now - time)), stuck);
    strips[0].show(now, samples.map(([t, X]) => [t, X]), point?.X);
    strips[1].show(now, samples.map(([t, , W]) => [t, W]), point?.W, impacts);
    parts.clock.textContent = `cycle ${now.toFixed(1)}`;
    const { f10_hat, f20_hat } = this.parameters, rests = !f10_hat && !f20_hat && [0, 2, 4, 5, 6, 7].every((n) => Math.abs(state[n]) < 1e-6);
    parts.repeats.textContent = rests ? "at rest" : repeats === 1 ? "1 cycle" : repeats ? `${repeats} cycles` : this.sections.length < 20 ? "wait for some cycles" : "not periodic so far";
    const shares = impacts.slice(1).map((time, n) => (time - impacts[n]).toFixed(2)).slice(-2);
    parts.flights.textContent = shares.length === 2 ? `${shares.join(" and ")} of the period` : "no recent flights";
    parts.largest.textContent = Math.max(0, ...samples.filter(([t]) => t > now - 1).map(([, X]) => Math.abs(X))).toFixed(3);
    parts.predicted.textContent = point ? Math.max(...point.X.map(Math.abs)).toFixed(3) : "";
    parts.printed.textContent = point ? point.printed : "no prediction here";
    parts.stable.textContent = !point ? "" : point.multiplier ? `${point.exact}: each cycle multiplies a small error by ${point.multiplier}` : point.exact;
  }
}

for (const root of document.querySelectorAll("#play-live")) new Play(root);
