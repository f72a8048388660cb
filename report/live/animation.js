// Two boxes on springs, each with its ball: plays the motion that a simulation left, with a flash at each impact.
"use strict";

const SECONDS_PER_CYCLE = 2.5;
const FLASH = 0.12; // of a cycle
const BALL = 0.28, WALL = 0.12, SIDE = 1 + BALL + WALL, HALF = 0.62, EDGE = 6.2;

function spring(left, right) {
  const turns = 14, lead = 0.15 * (right - left), step = (right - left - 2 * lead) / turns;
  const inner = Array.from({ length: turns + 1 }, (_, n) => [left + lead + n * step, [0, 0.13, 0, -0.13][n % 4]]);
  return [[left, 0], ...inner, [right, 0]].map((place) => place.join(",")).join(" ");
}

// Index of the last time that is not after t.
function before(times, t) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return low;
}

function between(motion, name, t) {
  const n = before(motion.t, t), span = motion.t[n + 1] - motion.t[n];
  const part = span > 0 ? Math.min(1, (t - motion.t[n]) / span) : 0;
  return motion[name][n] + part * (motion[name][n + 1] - motion[name][n]);
}

class Animation {
  constructor(root) {
    this.data = JSON.parse(document.getElementById(root.dataset.source).textContent);
    this.button = root.querySelector("button");
    this.slider = root.querySelector("input");
    this.output = root.querySelector("output");
    this.t = 0;
    this.playing = false;
    this.draw(root.querySelector("svg"));
    this.button.addEventListener("click", () => this.play(!this.playing));
    this.slider.addEventListener("input", () => { this.play(false); this.show(Number(this.slider.value)); });
    this.show(0);
    this.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  draw(svg) {
    svg.setAttribute("viewBox", `${-EDGE} -1.1 ${2 * EDGE} 3.9`);
    for (const x of [-EDGE + 0.03, EDGE - 0.03]) shape(svg, "line", { x1: x, x2: x, y1: -0.9, y2: 0.9, stroke: "#1a1a1a", "stroke-width": 0.06 });
    this.springs = [0, 1, 2].map(() => shape(svg, "polyline", { fill: "none", stroke: "#767676", "stroke-width": 0.05 }));
    this.modules = [0, 1].map((module) => {
      const box = shape(svg, "g", {});
      shape(box, "rect", { x: -SIDE, y: -HALF, width: 2 * SIDE, height: 2 * HALF, fill: "#9fb3c4" });
      shape(box, "rect", { x: WALL - SIDE, y: WALL - HALF, width: 2 * (SIDE - WALL), height: 2 * (HALF - WALL), fill: "#fff" });
      const flashes = {};
      for (const wall of [1, -1]) {
        flashes[wall] = shape(box, "rect", { x: wall === 1 ? -SIDE : SIDE - WALL, y: -HALF, width: WALL, height: 2 * HALF, fill: "#c2410c", opacity: 0 });
      }
      const ball = shape(svg, "circle", { r: BALL, fill: "#1a1a1a" });
      const label = shape(svg, "text", { y: -0.8, "font-size": 0.3, "text-anchor": "middle" });
      label.textContent = `module ${module + 1}`;
      return { box, ball, flashes, label, name: module + 1, place: this.data.places[module] };
    });
    this.traces(svg);
  }

  // W of both modules over the whole time, with a cursor.
  traces(svg) {
    const { motion, cycles } = this.data, across = (t) => -5 + (t / cycles) * 11;
    this.across = across;
    for (const module of [0, 1]) {
      const middle = 1.35 + 0.95 * module, height = 0.36;
      for (const wall of [-1, 1]) {
        shape(svg, "line", { x1: -5, x2: 6, y1: middle + wall * height, y2: middle + wall * height, stroke: "#9a9a9a", "stroke-width": 0.015 });
      }
      const points = motion.t.map((t, n) => `${across(t).toFixed(3)},${(middle - height * (motion[`X${module + 1}`][n] - motion[`Y${module + 1}`][n])).toFixed(3)}`);
      shape(svg, "polyline", { points: points.join(" "), fill: "none", stroke: "#1a1a1a", "stroke-width": cycles > 10 ? 0.012 : 0.03 });
      const label = shape(svg, "text", { x: -5.95, y: middle + 0.1, "font-size": 0.32, "font-style": "italic" });
      label.textContent = "W";
      shape(label, "tspan", { "font-size": 0.22, dy: 0.08 }).textContent = module + 1;
    }
    this.cursor = shape(svg, "line", { y1: 0.9, y2: 2.75, stroke: "#c2410c", "stroke-width": 0.04 });
  }

  show(t) {
    this.t = t;
    const { motion, impacts } = this.data;
    const centres = this.modules.map(({ name, place }) => place + between(motion, `X${name}`, t));
    this.modules.forEach(({ box, ball, label, flashes, name, place }, module) => {
      box.setAttribute("transform", `translate(${centres[module]})`);
      ball.setAttribute("cx", place + between(motion, `Y${name}`, t));
      label.setAttribute("x", centres[module]);
      for (const wall of [1, -1]) {
        // The latest impact at this wall.
        const ages = impacts.filter((hit) => hit[1] === name && hit[2] === wall && hit[0] <= t).map((hit) => t - hit[0]);
        flashes[wall].setAttribute("opacity", ages.length ? Math.max(0, 1 - Math.min(...ages) / FLASH) : 0);
      }
    });
    const ends = [-EDGE, centres[0] - SIDE, centres[0] + SIDE, centres[1] - SIDE, centres[1] + SIDE, EDGE];
    this.springs.forEach((line, n) => line.setAttribute("points", spring(ends[2 * n], ends[2 * n + 1])));
    this.cursor.setAttribute("x1", this.across(t));
    this.cursor.setAttribute("x2", this.across(t));
    this.slider.value = t;
    const said = `cycle ${t.toFixed(2)} of ${this.data.cycles}`;
    this.slider.setAttribute("aria-valuetext", said);
    this.output.textContent = said;
  }

  play(on) {
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    if (!on) return;
    let last = null;
    const step = (now) => {
      if (!this.playing) return;
      if (last !== null) this.show((this.t + (now - last) / 1000 / SECONDS_PER_CYCLE) % this.data.cycles);
      last = now;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}

for (const root of document.querySelectorAll("[data-animation]")) new Animation(root);
