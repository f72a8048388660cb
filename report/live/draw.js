// Drawing tools for the interactive pages: marks, charts, the two boxes on springs, and a clock.
"use strict";

function mark(parent, kind, name, attributes = {}, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", kind);
  if (name) made.setAttribute("class", name);
  set(made, attributes);
  made.textContent = text;
  parent.append(made);
  return made;
}

const set = (element, attributes) => { for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value); };
const dataOf = (root) => JSON.parse(document.getElementById(root.dataset.source).textContent);

// A chart with coordinates in page pixels, so that text has the same size at any width.
class Chart {
  constructor(svg, height) {
    Object.assign(this, { svg, fixed: height, left: 46, right: 14, top: 8, bottom: 22 });
    this.back = mark(svg, "g");
    this.front = mark(svg, "g");
  }

  layout() {
    this.width = Math.max(this.svg.clientWidth, 240);
    this.height = this.fixed || this.width - this.left - this.right + this.top + this.bottom; // default: square inside
    set(this.svg, { viewBox: `0 0 ${this.width} ${this.height}`, height: this.height });
    this.back.replaceChildren();
    this.inner = [this.width - this.left - this.right, this.height - this.top - this.bottom];
    mark(this.back, "rect", "frame", { x: this.left, y: this.top, width: this.inner[0], height: this.inner[1] });
  }

  text(layer, x, y, words, anchor = "middle") {
    return mark(layer, "text", "", { x, y, "text-anchor": anchor }, words);
  }
}

const FLASH = 0.12; // time for which a wall flashes after an impact [cycles]

// Two boxes on springs, each with its ball.
class Machine {
  static BALL = 0.28; static WALL = 0.14; static HALF = 0.62; static PLACES = [-3, 3]; static EDGE = 6.9; static SIDE = 1 + 0.28 + 0.14;

  constructor(svg) {
    const { BALL, WALL, HALF, EDGE, SIDE } = Machine;
    svg.setAttribute("viewBox", `${-EDGE} -1.15 ${2 * EDGE} 2`);
    for (const x of [-EDGE + 0.04, EDGE - 0.04]) mark(svg, "line", "ground", { x1: x, x2: x, y1: -0.8, y2: 0.8, "stroke-width": 0.08 });
    this.springs = [0, 1, 2].map(() => mark(svg, "polyline", "spring", { "stroke-width": 0.06 }));
    this.modules = [0, 1].map((i) => {
      const box = mark(svg, "g");
      mark(box, "rect", "side", { x: -SIDE, y: -HALF, width: 2 * SIDE, height: 2 * HALF });
      mark(box, "rect", "hole", { x: WALL - SIDE, y: WALL - HALF, width: 2 * (SIDE - WALL), height: 2 * (HALF - WALL) });
      const lights = [1, -1].map((wall) => mark(box, "rect", "hit", { x: wall === 1 ? -SIDE : SIDE - WALL, y: -HALF, width: WALL, height: 2 * HALF }));
      mark(box, "text", "", { y: -0.74, "text-anchor": "middle", "font-size": 0.42 }, `box ${i + 1}`);
      return { box, lights, ball: mark(svg, "circle", "ball", { r: BALL }) };
    });
  }

  // X, Y: displacements of both boxes and of both balls; ages: for each module, cycles since the last impacts
  // at wall +1 and at wall -1.
  show(X, Y, ages, stuck = [0, 0]) {
    const { PLACES, EDGE, SIDE } = Machine, at = X.map((x, i) => PLACES[i] + x);
    this.modules.forEach(({ box, lights, ball }, i) => {
      box.setAttribute("transform", `translate(${at[i]})`);
      set(ball, { cx: PLACES[i] + Y[i], "data-stuck": stuck[i] !== 0 });
      lights.forEach((light, k) => light.setAttribute("opacity", Math.max(0, 1 - ages[i][k] / FLASH)));
    });
    const ends = [-EDGE, at[0] - SIDE, at[0] + SIDE, at[1] - SIDE, at[1] + SIDE, EDGE];
    this.springs.forEach((line, n) => line.setAttribute("points", Machine.spring(ends[2 * n], ends[2 * n + 1])));
  }

  static spring(left, right) {
    const turns = 14, lead = 0.15 * (right - left), step = (right - left - 2 * lead) / turns;
    const inner = Array.from({ length: turns + 1 }, (_, n) => `${left + lead + n * step},${[0, 0.14, 0, -0.14][n % 4]}`);
    return [`${left},0`, ...inner, `${right},0`].join(" ");
  }
}

// A clock that calls `passed` with the time between two frames [s] while it runs; `button` starts and stops the clock.
class Clock {
  constructor(button, passed) {
    Object.assign(this, { button, passed });
    button.addEventListener("click", () => this.turn(!this.on));
    this.turn(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  turn(on) {
    this.on = on;
    this.button.textContent = on ? "Pause" : "Play";
    let last = null;
    const frame = (time) => {
      if (!this.on) return;
      if (last !== null) this.passed(Math.min(time - last, 100) / 1000);
      last = time;
      requestAnimationFrame(frame);
    };
    if (on) requestAnimationFrame(frame);
  }
}
