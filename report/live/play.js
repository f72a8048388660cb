// The page "Play": the exact system runs, with sliders, the map of regimes, and the theory's prediction beside it.
"use strict";

const STEPS = 160; // of a cycle: what is simulated between two pictures, or several of it
const SETTLED = 400, SKIPPED = 200, KEPT = 600, FIRST = 30; // cycles before the page opens; of the button; dots kept
const REPEATS = 2e-3, FLASHES = 0.12; // nearness in the section; how long a wall is lit, in cycles
const LOOKS = { // of the regimes, after Paul Tol's schemes for colour-blind readers; the letters say which is which
  "symmetric": ["S", "#004488", "every cycle, both flights alike"],
  "asymmetric": ["A", "#6699cc", "every cycle, flights lopsided"],
  "other periodic": ["P", "#bbddee", "repeats in another way"],
  "strongly modulated": ["M", "#eecc66", "bursts and gaps"],
  "chaotic": ["C", "#994455", "never repeats"],
  "hopping": ["H", "#ee99aa", "stray impacts"],
  "quasi-periodic": ["Q", "#117733", "beats"],
  "one ball idle": ["I", "#dddddd", ""],
  "no impacts": ["N", "#ffffff", ""],
  "unsettled": ["U", "#888888", "not decided"],
};
const niceAbove = (x) => [0.25, 0.5, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32].find((end) => end >= x) ?? 2 * x;
const dark = (colour) => [1, 3, 5].reduce((sum, n, k) => sum + parseInt(colour.slice(n, n + 2), 16) * [0.3, 0.59, 0.11][k], 0) < 128;

// Two boxes on springs, each with its ball.
class Machine {
  static BALL = 0.28; static WALL = 0.14; static HALF = 0.62; static PLACES = [-3, 3]; static EDGE = 6.9;

  constructor(svg) {
    const { BALL, WALL, HALF, EDGE } = Machine, side = 1 + BALL + WALL;
    this.side = side;
    svg.setAttribute("viewBox", `${-EDGE} -1.15 ${2 * EDGE} 2`);
    for (const x of [-EDGE + 0.04, EDGE - 0.04]) mark(svg, "line", "ground", { x1: x, x2: x, y1: -0.8, y2: 0.8, "stroke-width": 0.08 });
    this.springs = [0, 1, 2].map(() => mark(svg, "polyline", "spring", { "stroke-width": 0.06 }));
    this.modules = [0, 1].map((i) => {
      const box = mark(svg, "g");
      mark(box, "rect", "side", { x: -side, y: -HALF, width: 2 * side, height: 2 * HALF });
      mark(box, "rect", "hole", { x: WALL - side, y: WALL - HALF, width: 2 * (side - WALL), height: 2 * (HALF - WALL) });
      const lights = [1, -1].map((wall) => mark(box, "rect", "hit", { x: wall === 1 ? -side : side - WALL, y: -HALF, width: WALL, height: 2 * HALF }));
      const name = mark(svg, "text", "", { y: -0.74, "text-anchor": "middle", }, `box ${i + 1}`);
      return { box, lights, name, ball: mark(svg, "circle", "ball", { r: BALL }) };
    });
  }

  // Letters of 15 pixels, whatever the width of the page.
  layout(svg) {
    for (const { name } of this.modules) name.style.fontSize = `${Math.min(0.6, (15 * 2 * Machine.EDGE) / Math.max(svg.clientWidth, 240))}px`;
  }

  // The state of a run; hits: for each module the time in cycles since the last impact at wall +1 and -1.
  show({ state: [X1, Y1, X2, Y2], stuck }, hits) {
    const { PLACES, EDGE } = Machine, X = [X1 + PLACES[0], X2 + PLACES[1]], Y = [Y1 + PLACES[0], Y2 + PLACES[1]];
    this.modules.forEach(({ box, lights, name, ball }, i) => {
      box.setAttribute("transform", `translate(${X[i]})`);
      name.setAttribute("x", X[i]);
      set(ball, { cx: Y[i], "data-stuck": stuck[i] !== 0 });
      lights.forEach((light, k) => light.setAttribute("opacity", Math.max(0, 1 - hits[i][k] / FLASHES)));
    });
    const ends = [-EDGE, X[0] - this.side, X[0] + this.side, X[1] - this.side, X[1] + this.side, EDGE];
    this.springs.forEach((line, n) => line.setAttribute("points", Machine.spring(ends[2 * n], ends[2 * n + 1])));
  }

  static spring(left, right) {
    const turns = 14, lead = 0.15 * (right - left), step = (right - left - 2 * lead) / turns;
    const inner = Array.from({ length: turns + 1 }, (_, n) => `${left + lead + n * step},${[0, 0.14, 0, -0.14][n % 4]}`);
    return [`${left},0`, ...inner, `${right},0`].join(" ");
  }
}

// A quantity over the last cycles, the exact one and the theory's, which reaches a little beyond the present.
class Strip extends Chart {
  constructor(svg, height, walls) {
    super(svg, height);
    Object.assign(this, { walls, end: walls ? 1.12 : 0.5, top: walls ? 30 : 8, ahead: 0.25 });
    this.grid = mark(this.front, "g");
    this.ghost = mark(this.front, "polyline", "ghost");
    this.line = mark(this.front, "polyline", "exact");
    this.flights = mark(this.front, "g");
  }

  layout() {
    super.layout();
    this.cycles = this.width > 480 ? 4 : 2.5;
    this.axis();
  }

  axis() {
    const ticks = this.walls ? [-1, 0, 1] : [-this.end, 0, this.end];
    this.back.querySelectorAll(".tick").forEach((old) => old.remove());
    const layer = mark(this.back, "g", "tick");
    for (const tick of ticks) {
      mark(layer, "line", this.walls && tick ? "wall" : "rule", { x1: this.left, x2: this.width - this.right, y1: this.y(tick), y2: this.y(tick) });
      this.text(layer, this.left - 6, this.y(tick) + (tick === this.end ? 10 : tick === -this.end ? 0 : 4), tick ? String(tick).replace("-", "−") : "0", "end");
    }
  }

  y(value) { return this.top + 0.5 * (1 - value / this.end) * this.inner[1]; }

  x(time) { return this.width - this.right - ((this.now + this.ahead - time) / this.cycles) * this.inner[0]; }

  // samples: [time in cycles, value]; predicted: the theory's value at a time, or null; impacts: times with their walls.
  show(now, samples, predicted, impacts = []) {
    this.now = now;
    const first = now + this.ahead - this.cycles, place = ([t, v]) => `${this.x(t).toFixed(1)},${this.y(v).toFixed(1)}`;
    const shown = samples.filter(([t]) => t >= first);
    this.line.setAttribute("points", shown.map(place).join(" "));
    const times = Array.from({ length: Math.round(100 * this.cycles) + 1 }, (_, n) => first + n / 100);
    this.ghost.setAttribute("points", predicted ? times.map((t) => place([t, predicted(t)])).join(" ") : "");
    this.grid.replaceChildren();
    for (let n = Math.ceil(first); n <= now + this.ahead; n++) {
      if (n < 0) continue;
      mark(this.grid, "line", "rule", { x1: this.x(n), x2: this.x(n), y1: this.top, y2: this.top + this.inner[1] });
      const middle = this.x(n);
      if (middle < this.width - 40 && middle > this.left + 20) this.text(this.grid, middle, this.height - 6, `cycle ${n}`);
    }
    this.flights.replaceChildren();
    for (let n = 1; n < impacts.length; n++) this.bracket(impacts[n - 1], impacts[n]);
  }

  bracket(from, to) {
    const [a, b] = [this.x(from.time), this.x(to.time)], y = this.top - 7;
    if (a < this.left || b - a < 4) return;
    mark(this.flights, "path", "bracket", { d: `M${a + 1.5} ${y + 5}V${y}H${b - 1.5}V${y + 5}` });
    if (b - a > 30) mark(this.flights, "text", "share", { x: (a + b) / 2, y: y - 5 }, (to.time - from.time).toFixed(2));
  }
}

// Displacement and velocity of box 2 once per cycle.
class Section extends Chart {
  constructor(svg) {
    super(svg, 0);
    Object.assign(this, { end: [0.5, 0.5], bottom: 36, left: 52 });
    this.dots = mark(this.front, "path", "dot");
    this.latest = mark(this.front, "circle", "latest", { r: 5 });
    this.cross = mark(this.front, "path", "cross");
  }

  layout() {
    super.layout();
    const layer = this.back, middle = this.top + this.inner[1] / 2;
    const [x, y] = this.place([0, 0]);
    mark(layer, "line", "rule", { x1: x, x2: x, y1: this.top, y2: this.top + this.inner[1] });
    mark(layer, "line", "rule", { x1: this.left, x2: this.left + this.inner[0], y1: y, y2: y });
    for (const sign of [-1, 0, 1]) {
      const [a, b] = this.end.map((end) => String(sign * end).replace("-", "−"));
      this.text(layer, this.place([sign * this.end[0], 0])[0], this.height - 20, a, sign < 0 ? "start" : sign ? "end" : "middle");
      if (sign) this.text(layer, this.left - 6, this.place([0, sign * this.end[1]])[1] + (sign > 0 ? 10 : 0), b, "end");
    }
    this.text(layer, this.left + this.inner[0] / 2, this.height - 4, "displacement X₂");
    const name = this.text(layer, 0, 0, "velocity X₂′");
    name.setAttribute("transform", `translate(14 ${middle}) rotate(-90)`);
  }

  place([x, v]) {
    return [this.left + 0.5 * (1 + x / this.end[0]) * this.inner[0], this.top + 0.5 * (1 - v / this.end[1]) * this.inner[1]];
  }

  show(points, predicted) {
    const all = predicted ? [...points, predicted] : points;
    const end = [0, 1].map((k) => niceAbove(1.1 * Math.max(0.1, ...all.map((point) => Math.abs(point[k])))));
    if (end.some((value, k) => value !== this.end[k])) { this.end = end; this.layout(); }
    this.dots.setAttribute("d", points.map((point) => `M${this.place(point).map((x) => x.toFixed(1)).join(" ")}h0`).join(""));
    const last = points.at(-1), [cx, cy] = last ? this.place(last) : [-9, -9], [x, y] = predicted ? this.place(predicted) : [-20, -20];
    set(this.latest, { cx, cy });
    this.cross.setAttribute("d", `M${x - 7} ${y - 7}l14 14m0 -14l-14 14`);
  }
}

// The map of regimes over both forces; `chosen` is called with the forces of a cell that is clicked.
class RegimeMap extends Chart {
  constructor(svg, map, cases, chosen) {
    super(svg, 0);
    Object.assign(this, { map, cases, bottom: 36, forces: [1, 1] });
    this.marker = mark(this.front, "g");
    svg.addEventListener("click", (event) => {
      const { left, top, width } = svg.getBoundingClientRect(), scale = this.width / width;
      const across = ((event.clientX - left) * scale - this.left) / this.inner[0], up = 1 - ((event.clientY - top) * scale - this.top) / this.inner[1];
      chosen([this.cell(across, map.f10), this.cell(up, map.f20)]);
    });
    svg.addEventListener("keydown", (event) => {
      const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!move) return;
      event.preventDefault();
      chosen([map.f10, map.f20].map((list, k) => list[Math.min(list.length - 1, Math.max(0, this.nearest(list, this.forces[k]) + move[k]))]));
    });
  }

  cell(share, list) { return list[Math.min(list.length - 1, Math.max(0, Math.floor(share * list.length)))]; }

  nearest(list, force) { return list.reduce((best, value, n) => (Math.abs(value - force) < Math.abs(list[best] - force) ? n : best), 0); }

  regime([f1, f2]) { return this.map.regimes[this.map.cells[this.nearest(this.map.f20, f2)][this.nearest(this.map.f10, f1)]]; }

  place([f1, f2]) {
    const { f10, f20 } = this.map, share = (list, f) => (f - list[0]) / (list[1] - list[0]) + 0.5;
    return [this.left + (share(f10, f1) / f10.length) * this.inner[0], this.top + (1 - share(f20, f2) / f20.length) * this.inner[1]];
  }

  layout() {
    super.layout();
    const { f10, f20, cells, regimes } = this.map, [w, h] = [this.inner[0] / f10.length, this.inner[1] / f20.length], layer = this.back;
    cells.forEach((row, j) => row.forEach((regime, i) => {
      const colour = LOOKS[regimes[regime]]?.[1] ?? "#888888";
      mark(layer, "rect", "cell", { x: this.left + i * w, y: this.top + (f20.length - 1 - j) * h, width: w + 0.5, height: h + 0.5, fill: colour });
    }));
    for (const [j, i] of this.deepest()) {
      const [letter, colour] = LOOKS[regimes[cells[j][i]]] ?? ["?", "#888888"], [x, y] = this.place([f10[i], f20[j]]);
      mark(layer, "text", "letter", { x, y: y + 4, style: `fill: ${dark(colour) ? "#fff" : "#000"}` }, letter);
    }
    for (const [name, forces] of Object.entries(this.cases)) {
      const [x, y] = this.place(forces);
      mark(layer, "path", "halo", { d: `M${x - 5} ${y - 5}l10 10m0 -10l-10 10` });
      mark(layer, "path", "here", { d: `M${x - 5} ${y - 5}l10 10m0 -10l-10 10` });
      mark(layer, "text", "case", { x: x + 9, y: y + 4 }, name);
    }
    for (let f = 0; f <= 1.6; f += 0.4) {
      const [x, y] = this.place([f, f]);
      this.text(layer, x, this.height - 20, f.toFixed(1));
      this.text(layer, this.left - 6, y + 4, f.toFixed(1), "end");
    }
    this.text(layer, this.left + this.inner[0] / 2, this.height - 4, "force on box 1");
    const name = this.text(layer, 0, 0, "force on box 2");
    name.setAttribute("transform", `translate(14 ${this.top + this.inner[1] / 2}) rotate(-90)`);
    this.show(this.forces);
  }

  // Cells deep inside a patch of one regime, apart from each other: where letters stand.
  deepest() {
    const { cells } = this.map, found = [];
    const depth = (j, i) => {
      for (let d = 1; ; d++) {
        for (let a = -d; a <= d; a++) for (const [y, x] of [[j - d, i + a], [j + d, i + a], [j + a, i - d], [j + a, i + d]]) if (cells[y]?.[x] !== cells[j][i]) return d;
      }
    };
    const deep = cells.flatMap((row, j) => row.map((_, i) => [j, i, depth(j, i)])).filter(([, , d]) => d > 1).sort((a, b) => b[2] - a[2]);
    for (const [j, i] of deep) {
      if (!found.some(([y, x]) => cells[y][x] === cells[j][i] && Math.hypot(y - j, x - i) < 9)) found.push([j, i]);
    }
    return found;
  }

  show(forces) {
    this.forces = forces;
    if (!this.inner) return;
    const [cx, cy] = this.place(forces);
    this.marker.replaceChildren();
    for (const name of ["halo", "here"]) mark(this.marker, "circle", name, { cx, cy, r: 7, "data-forces": forces.join() });
  }
}

class Play {
  constructor(root) {
    this.data = JSON.parse(document.getElementById(root.dataset.source).textContent);
    this.parts = Object.fromEntries([...root.querySelectorAll("[id^=play-]")].map((part) => [part.id.slice(5), part]));
    const { parts, data } = this;
    this.parameters = { ...data.system, f10_hat: data.cases[data.first][0], f20_hat: data.cases[data.first][1] };
    this.speed = 0.5;
    this.machine = new Machine(parts.machine);
    this.strips = [new Strip(parts.box, 170, false), new Strip(parts.ball, 230, true)];
    this.section = new Section(parts.section);
    this.charts = [...this.strips, this.section];
    parts.regimes.hidden = !data.map;
    if (data.map) this.charts.push((this.map = new RegimeMap(parts.map, data.map, data.cases, (forces) => this.goTo(forces))));
    this.connect();
    this.begin(SETTLED);
    this.section.points.splice(0, SETTLED - FIRST);
    const layout = () => { this.machine.layout(parts.machine); for (const chart of this.charts) chart.layout(); };
    layout();
    this.parametersChanged();
    new ResizeObserver(() => { layout(); this.show(); }).observe(root);
    this.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  connect() {
    const { parts, data } = this;
    parts.run.addEventListener("click", () => this.play(!this.playing));
    parts.step.addEventListener("click", () => { this.play(false); this.simulate(STEPS / 20); this.show(); });
    parts.skip.addEventListener("click", () => { this.simulate(SKIPPED * STEPS); this.show(); });
    parts.again.addEventListener("click", () => { this.begin(0); this.show(); });
    for (const [part, name] of [["f1", "f10_hat"], ["f2", "f20_hat"], ["kappa", "kappa"]]) {
      parts[part].addEventListener("input", () => {
        this.parameters[name] = Number(parts[part].value);
        this.run.change(this.parameters);
        this.section.points = [];
        this.parametersChanged();
      });
    }
    parts.start.addEventListener("input", () => { this.speed = Number(parts.start.value); this.begin(0); this.parametersChanged(); });
    parts.point.addEventListener("change", () => this.choose(parts.point.value));
    for (const [name, forces] of Object.entries(data.cases)) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `case ${name}`;
      button.addEventListener("click", () => this.goTo(forces));
      parts.cases.append(button);
    }
    for (const [regime, count] of Object.entries(data.map?.counts ?? {})) {
      const [letter, colour, words] = LOOKS[regime] ?? ["?", "#888888", ""], entry = document.createElement("li"), patch = document.createElement("b");
      Object.assign(patch, { textContent: letter, title: `${count} cells` });
      Object.assign(patch.style, { background: colour, color: dark(colour) ? "#fff" : "#000" });
      const said = document.createElement("span");
      said.textContent = words ? `${regime}: ${words}` : regime;
      entry.append(patch, said);
      parts.legend.append(entry);
    }
  }

  // Start anew, with the first so many cycles run at once.
  begin(cycles) {
    this.run = new VibroImpact.Run(this.parameters, [0, 0, 0, 0, 0, this.speed, 0, this.speed]);
    Object.assign(this, { steps: 0, samples: [], impacts: [], hits: [[Infinity, Infinity], [Infinity, Infinity]], rest: 0 });
    this.section.points = [];
    this.simulate(cycles * STEPS);
  }

  goTo([f10_hat, f20_hat]) {
    Object.assign(this.parameters, { f10_hat, f20_hat });
    this.begin(0);
    this.parametersChanged();
  }

  get now() { return this.steps / STEPS; }

  simulate(steps) {
    const { period } = this.run.system;
    for (let n = 0; n < steps; n++) {
      this.run.advance(period / STEPS);
      this.steps++;
      for (const { tau, module, wall, kind, state } of this.run.events.splice(0)) {
        const time = tau / period;
        if (kind === "impact") this.hits[module - 1][wall === 1 ? 0 : 1] = time;
        if (module === 2) {
          this.samples.push([time, state[2], state[2] - state[3]]);
          if (kind === "impact") this.impacts.push({ time, wall });
        }
      }
      const { state } = this.run;
      this.samples.push([this.now, state[2], state[2] - state[3]]);
      if (this.steps % STEPS === 0) this.section.points.push([state[2], state[6]]);
    }
    while (this.samples.length && this.samples[0][0] < this.now - 5) this.samples.splice(0, 200);
    this.impacts = this.impacts.filter(({ time }) => time > this.now - 5);
    this.section.points.splice(0, this.section.points.length - KEPT);
  }

  parametersChanged() {
    const { parts, parameters, data } = this, { f10_hat, f20_hat, kappa } = parameters;
    for (const [part, value, words] of [["f1", f10_hat], ["f2", f20_hat], ["kappa", kappa], ["start", this.speed, this.speed ? "" : "0: at rest"]]) {
      const said = words || value.toFixed(2);
      parts[part].value = value;
      parts[part].setAttribute("aria-valuetext", said);
      parts[part].parentElement.querySelector("output").textContent = said;
    }
    const before = this.point?.label;
    this.points = SlowFlow.fixedPoints(parameters);
    parts.point.replaceChildren(...this.points.map((point) => new Option(`${point.label}: the chapter says ${point.printed ? "stable" : "unstable"}`, point.label)), new Option("none", ""));
    const kept = this.points.find(({ label }) => label === before && before !== this.best) ?? this.points.at(-1);
    this.best = this.points.at(-1)?.label;
    this.choose(kept?.label ?? "");
    const same = Math.abs(kappa - data.system.kappa) < 1e-9;
    if (this.map) {
      this.map.show([f10_hat, f20_hat]);
      const where = same ? `At ${f10_hat.toFixed(2)}, ${f20_hat.toFixed(2)}` : `At these forces, but κ = ${data.system.kappa}, which the map is for,`;
      parts.here.textContent = `${where} most starts end in: ${this.map.regime([f10_hat, f20_hat])}.`;
    }
    this.show();
  }

  choose(label) {
    const { parts, parameters } = this, point = this.points.find((other) => other.label === label);
    this.point = point;
    parts.point.value = label;
    parts.theory.textContent = point ? `theory, point ${label}` : "theory: none";
    const at = (cycle) => SlowFlow.response(parameters, point, 1, 2 * Math.PI * cycle), cycle = Array.from({ length: 200 }, (_, n) => n / 200);
    this.predicted = point && [(t) => at(t).X, (t) => at(t).W];
    const h = 1e-4;
    this.crossed = point && [at(0).X, ((at(h).X - at(-h).X) / (4 * Math.PI * h)) * this.run.system.omega];
    parts.predicted.textContent = point ? Math.max(...cycle.map((t) => Math.abs(at(t).X))).toFixed(3) : "";
    parts.said.replaceChildren(...(point ? [badge("the chapter says", point.printed)] : []));
    this.show();
  }

  // Cycles after which the section repeats, or 0.
  get repeats() {
    const points = this.section.points, near = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) < REPEATS;
    if (points.length < 20) return 0;
    return [1, 2, 3, 4, 5, 6].find((p) => [1, 2, 3, 4, 5, 6].every((n) => near(points.at(-n), points.at(-n - p)))) ?? 0;
  }

  show() {
    if (!this.points) return;
    const { parts, now, samples, predicted, strips } = this;
    this.machine.show(this.run, this.hits.map((times) => times.map((time) => now - time)));
    const largest = samples.reduce((most, [, X]) => Math.max(most, Math.abs(X)), Number(parts.predicted.textContent)), end = niceAbove(largest);
    if (end !== strips[0].end) { strips[0].end = end; strips[0].axis(); }
    strips[0].show(now, samples.map(([t, X]) => [t, X]), predicted?.[0]);
    strips[1].show(now, samples.map(([t, , W]) => [t, W]), predicted?.[1], this.impacts);
    this.section.show(this.section.points, this.crossed);
    parts.clock.textContent = `cycle ${now.toFixed(1)}`;
    this.tell();
  }

  tell() {
    const { parts, now, samples, impacts, repeats } = this, count = this.section.points.length;
    const said = repeats === 1 ? "every cycle" : repeats ? `every ${repeats} cycles` : count < 20 ? "wait for some cycles" : "not so far";
    const shares = impacts.slice(1).map(({ time }, n) => (time - impacts[n].time).toFixed(2)).slice(-2);
    const recent = samples.filter(([t]) => t > now - 1);
    parts.repeats.textContent = said;
    parts.flights.textContent = shares.length === 2 ? `${shares.join(" and ")} of the period` : "none lately";
    parts.largest.textContent = recent.reduce((most, [, X]) => Math.max(most, Math.abs(X)), 0).toFixed(3);
    const alike = shares.length === 2 && Math.abs(shares[0] - shares[1]) < 0.015;
    const found = count < 20 ? "" : repeats > 1 ? `a motion of ${repeats} cycles` : repeats ? `a motion with ${alike ? "equal" : "unequal"} flights` : "no periodic motion so far";
    if (parts.exact.textContent !== found) parts.exact.textContent = found;
  }

  play(on) {
    this.playing = on;
    this.parts.run.textContent = on ? "Pause" : "Play";
    if (!on) return;
    let last = null;
    const frame = (time) => {
      if (!this.playing) return;
      if (last !== null) {
        this.rest += (Math.min(time - last, 100) / 1000) * Number(this.parts.pace.value) * STEPS;
        const whole = Math.floor(this.rest);
        this.rest -= whole;
        this.simulate(whole);
        this.show();
      }
      last = time;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

function badge(words, stable) {
  const made = document.createElement("span");
  made.className = `badge ${stable ? "yes" : "no"}`;
  made.textContent = `${words}: ${stable ? "stable" : "unstable"}`;
  return made;
}

for (const root of document.querySelectorAll("#play-live")) new Play(root);
