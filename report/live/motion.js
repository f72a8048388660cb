// The motion that a simulation left, with W of both modules over the whole time.
"use strict";

class Motion extends Chart {
  constructor(root) {
    const [machine, chart] = root.querySelectorAll("svg");
    super(chart, 190);
    Object.assign(this, { data: dataOf(root), machine: new Machine(machine), t: 0 });
    [this.slider, this.output] = ["input", "output"].map((name) => root.querySelector(name));
    this.slider.addEventListener("input", () => { this.clock.turn(false); this.show(Number(this.slider.value)); });
    new ResizeObserver(() => { this.layout(); this.show(this.t); }).observe(root);
    this.layout();
    this.show(0);
    this.clock = new Clock(root.querySelector("button"), (seconds) => this.show((this.t + seconds / 2.5) % this.data.cycles));
  }

  x(t) { return this.left + (t / this.data.cycles) * this.inner[0]; }

  layout() {
    super.layout();
    const { motion, cycles } = this.data, half = this.inner[1] / 4;
    for (const i of [0, 1]) {
      const middle = this.top + half * (1 + 2 * i), y = (W) => (middle - 0.8 * half * W).toFixed(1);
      for (const wall of [-1, 1]) mark(this.back, "line", "wall", { x1: this.left, x2: this.left + this.inner[0], y1: y(wall), y2: y(wall) });
      const points = motion.t.map((t, n) => `${this.x(t).toFixed(1)},${y(motion[`X${i + 1}`][n] - motion[`Y${i + 1}`][n])}`);
      mark(this.back, "polyline", "exact", { points: points.join(" "), style: `stroke-width: ${cycles > 10 ? 0.6 : 2}` });
      this.text(this.back, this.left - 8, middle + 4, `W${"₁₂"[i]}`, "end");
    }
    this.front.replaceChildren();
    this.cursor = mark(this.front, "line", "cross", { y1: this.top, y2: this.top + this.inner[1] });
  }

  // Between two rows every ball flies straight, and the rows of a box are close.
  at(t) {
    const { motion } = this.data, n = Math.max(0, Math.min(motion.t.findLastIndex((time) => time <= t), motion.t.length - 2));
    const span = motion.t[n + 1] - motion.t[n], part = span > 0 ? Math.min(1, (t - motion.t[n]) / span) : 0;
    return ["X1", "X2", "Y1", "Y2"].map((name) => motion[name][n] + part * (motion[name][n + 1] - motion[name][n]));
  }

  show(t) {
    const [X1, X2, Y1, Y2] = this.at(t), { impacts, cycles } = this.data;
    const since = (module, wall) => Math.min(...impacts.filter((hit) => hit[1] === module && hit[2] === wall && hit[0] <= t).map((hit) => t - hit[0]));
    this.machine.show([X1, X2], [Y1, Y2], [1, 2].map((module) => [1, -1].map((wall) => since(module, wall))));
    set(this.cursor, { x1: this.x(t), x2: this.x(t) });
    const said = `cycle ${t.toFixed(2)} of ${cycles}`;
    Object.assign(this, { t });
    this.slider.value = t;
    this.slider.setAttribute("aria-valuetext", said);
    this.output.textContent = said;
  }
}

for (const root of document.querySelectorAll("[data-motion]")) new Motion(root);
