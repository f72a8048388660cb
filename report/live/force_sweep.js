// For the value of f20 at the slider, show fixed points on the slow invariant manifold, exact orbits and their multipliers.
"use strict";

const WIDTH = 360, HEIGHT = 290, LEFT = 44, BOTTOM = 38, TOP = 30, RIGHT = 10;
const INK = "var(--play-ink)", SOFT = "var(--play-soft)", BACK = "var(--play-back)", FAR = 1.35; // the colours of play.css
const RINGS = { stable: "none", unstable: "3 3", undecided: "1 4" };

const colour = (track) => (track ? `var(--track-${(track - 1) % 4 + 1})` : INK);

function frame(svg, title) {
  svg.setAttribute("viewBox", `0 0 ${WIDTH} ${HEIGHT}`);
  svg.setAttribute("font-size", 13);
  svg.setAttribute("font-family", "system-ui, sans-serif");
  mark(svg, "text", "", { x: LEFT, y: TOP - 11, "font-weight": 600 }, title);
  mark(svg, "rect", "", { x: LEFT, y: TOP, width: WIDTH - LEFT - RIGHT, height: HEIGHT - BOTTOM - TOP, fill: "none", stroke: SOFT });
}

class Plane {
  constructor(svg, module, manifold) {
    this.svg = svg;
    const all = Object.values(manifold).flat();
    const ends = [Math.max(...all.map(([C]) => C)), 1.05 * Math.max(...all.map(([, B]) => B))];
    this.x = (C) => LEFT + (C / ends[0]) * (WIDTH - LEFT - RIGHT);
    this.y = (B) => HEIGHT - BOTTOM - (B / ends[1]) * (HEIGHT - BOTTOM - TOP);
    frame(svg, `Fixed points, module ${module + 1}`);
    for (let C = 0; C <= ends[0]; C += 0.5) mark(svg, "text", "", { x: this.x(C), y: HEIGHT - BOTTOM + 16, "text-anchor": "middle" }, C);
    for (let B = 0; B <= ends[1]; B += 0.5) mark(svg, "text", "", { x: LEFT - 6, y: this.y(B) + 4, "text-anchor": "end" }, B);
    mark(svg, "text", "", { x: WIDTH - 60, y: HEIGHT - 4, "font-style": "italic" }, `C${"₁₂"[module]}`);
    mark(svg, "text", "", { x: 2, y: TOP + 30, "font-style": "italic" }, `B${"₁₂"[module]}`);
    for (const [series, line] of Object.entries(manifold)) {
      const stable = series === "SIM stable";
      mark(svg, "polyline", "", {
        points: line.map(([C, B]) => `${this.x(C)},${this.y(B)}`).join(" "), fill: "none", stroke: INK,
        "stroke-width": stable ? 2.4 : 1.3, "stroke-dasharray": stable ? "none" : "6 4",
      });
    }
    this.layer = mark(svg, "g", "", {});
  }

  // Place each letter below the curve, outside the bend; if two letters would overlap, place the second above the curve.
  show(points, module) {
    this.layer.replaceChildren();
    let last = -Infinity;
    for (const { name, track, C, B, verdicts } of [...points].sort((a, b) => a.C[module] - b.C[module])) {
      const hue = colour(track), [x, y] = [this.x(C[module]), this.y(B[module])];
      const fill = verdicts.theory === "stable" ? hue : BACK, side = C[module] < 1 ? -1 : 1;
      mark(this.layer, "circle", "", { cx: x, cy: y, r: 5, fill, stroke: hue, "stroke-width": 2, "data-label": name });
      if (verdicts.exact in RINGS) {
        mark(this.layer, "circle", "", { cx: x, cy: y, r: 9, fill: "none", stroke: hue, "stroke-width": 1.5, "stroke-dasharray": RINGS[verdicts.exact], "data-exact": verdicts.exact });
      }
      const below = x - last > 20;
      last = x;
      mark(this.layer, "text", "", { x: x + (below ? 11 : -11) * side, y: y + (below ? 18 : -11), "text-anchor": "middle", fill: hue, "font-weight": 600 }, name);
    }
  }
}

// Chart of the branches of exact orbits: C of module 2 against the force, with a line at the value of the slider.
class Branches {
  constructor(svg, { values, orbits }) {
    const all = orbits.flatMap((list, index) => list.map((orbit) => ({ ...orbit, value: values[index] })));
    const [low, high] = [values[0], values.at(-1)], top = 1.05 * Math.max(1, ...all.map(({ C }) => C[1]));
    this.values = values;
    this.x = (value) => LEFT + ((value - low) / (high - low)) * (WIDTH - LEFT - RIGHT);
    const y = (C) => HEIGHT - BOTTOM - (C / top) * (HEIGHT - BOTTOM - TOP);
    frame(svg, "Exact orbits over the force");
    for (let value = Math.ceil(5 * low); value <= 5 * high; value++) mark(svg, "text", "", { x: this.x(value / 5), y: HEIGHT - BOTTOM + 16, "text-anchor": "middle" }, (value / 5).toFixed(1));
    for (let C = 0; C <= top; C += 0.5) mark(svg, "text", "", { x: LEFT - 6, y: y(C) + 4, "text-anchor": "end" }, C);
    mark(svg, "text", "", { x: WIDTH - 60, y: HEIGHT - 4, "font-style": "italic" }, "f̂₂₀");
    mark(svg, "text", "", { x: 2, y: TOP + 30, "font-style": "italic" }, "C₂");
    for (const { track, C, value, exact } of all) {
      const stable = exact === "stable";
      mark(svg, "circle", "", { cx: this.x(value), cy: y(C[1]), r: stable ? 3 : 1.4, fill: stable ? colour(track) : "none", stroke: colour(track), "stroke-width": 1, "data-orbit": exact });
    }
    this.cursor = mark(svg, "line", "", { y1: TOP, y2: HEIGHT - BOTTOM, stroke: SOFT, "stroke-width": 1.2 });
  }

  show(index) {
    for (const end of ["x1", "x2"]) this.cursor.setAttribute(end, this.x(this.values[index]));
  }
}

// Chart of the unit circle and the multipliers of exact orbits. A multiplier beyond the frame is
// drawn at its edge, with its modulus.
class Circle {
  constructor(svg, { orbits }) {
    this.orbits = orbits;
    frame(svg, "Multipliers of the exact orbits");
    this.unit = (HEIGHT - BOTTOM - TOP) / 2 / FAR;
    this.centre = [LEFT + 8 + FAR * this.unit, (TOP + HEIGHT - BOTTOM) / 2];
    const [cx, cy] = this.centre;
    for (const x of [-1, 0, 1]) mark(svg, "text", "", { x: cx + x * this.unit, y: HEIGHT - BOTTOM + 16, "text-anchor": "middle" }, x);
    mark(svg, "circle", "", { cx, cy, r: this.unit, fill: "none", stroke: INK, "stroke-width": 1.3 });
    this.layer = mark(svg, "g", "", {});
  }

  show(index, points) {
    this.layer.replaceChildren();
    const names = Object.fromEntries(points.map(({ track, name }) => [track, name])), far = [];
    for (const { track, exact, multipliers } of this.orbits[index]) {
      for (const [real, imaginary] of multipliers) {
        const modulus = Math.hypot(real, imaginary), inside = Math.min(1, (FAR - 0.1) / modulus);
        const [x, y] = [this.centre[0] + real * inside * this.unit, this.centre[1] - imaginary * inside * this.unit];
        const style = { stroke: colour(track), "stroke-width": 1.6, fill: modulus < 1 ? colour(track) : BACK, "data-multiplier": exact };
        if (track) mark(this.layer, "circle", "", { cx: x, cy: y, r: 3.6, ...style });
        else mark(this.layer, "rect", "", { x: x - 3.4, y: y - 3.4, width: 6.8, height: 6.8, ...style });
        if (inside < 1) far.push([`${names[track] ?? "pair"}: ${modulus.toPrecision(3)}`, colour(track)]);
      }
    }
    const place = { x: WIDTH - RIGHT - 6, "text-anchor": "end" };
    if (far.length) mark(this.layer, "text", "", { ...place, y: TOP + 18 }, "beyond the frame:");
    far.sort().forEach(([text, fill], n) => mark(this.layer, "text", "", { ...place, y: TOP + 35 + 16 * n, fill, "data-far": "" }, text));
  }
}

class ForceSweep {
  constructor(root) {
    this.data = dataOf(root);
    this.slider = root.querySelector("input");
    this.output = root.querySelector("output");
    this.rows = root.querySelector("tbody");
    const [first, second, third, fourth] = root.querySelectorAll(".planes svg");
    this.planes = [first, second].map((svg, module) => new Plane(svg, module, this.data.manifold));
    this.branches = new Branches(third, this.data);
    this.circle = new Circle(fourth, this.data);
    this.names = this.branchNames(this.nearest(Number(root.dataset.start)));
    this.slider.max = this.data.values.length - 1;
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    for (const button of root.querySelectorAll("button")) {
      button.addEventListener("click", () => this.show(this.nearest(Number(button.dataset.value))));
    }
    this.show(this.nearest(Number(root.dataset.start)));
  }

  nearest(value) {
    const gaps = this.data.values.map((other) => Math.abs(other - value));
    return gaps.indexOf(Math.min(...gaps));
  }

  // Assign a letter to each branch (track): the letter of its fixed point at the initial force, or else the next free letter.
  branchNames(start) {
    const names = new Map(this.data.points[start].map(({ track, label }) => [track, label]));
    for (const { track } of this.data.points.flat()) {
      if (!names.has(track)) names.set(track, [..."abcdefghijklmnopqrstuvwxyz"].find((letter) => ![...names.values()].includes(letter)) ?? track);
    }
    return names;
  }

  show(index) {
    const named = this.data.points[index].map((point) => ({ ...point, name: this.names.get(point.track) }));
    const points = named.sort((one, other) => (one.name < other.name ? -1 : 1)), value = this.data.values[index].toFixed(2);
    this.slider.value = index;
    this.slider.setAttribute("aria-valuetext", `${value}, ${points.length} fixed points`);
    this.output.textContent = value;
    this.planes.forEach((plane, module) => plane.show(points, module));
    this.branches.show(index);
    this.circle.show(index, points);
    this.rows.replaceChildren(...points.map(({ name, label, C, B, verdicts }) => {
      const row = document.createElement("tr");
      const places = [C[0], B[0], C[1], B[1]].map((number) => number.toFixed(3));
      for (const text of [name, label, ...places, ...Object.values(verdicts)]) row.insertCell().textContent = text;
      return row;
    }));
  }
}

for (const root of document.querySelectorAll("[data-force-sweep]")) new ForceSweep(root);
