// Show a simulated motion as an animation, with W of both modules against time.
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

  show(t) {
    const { cycles } = this.data;
    this.machine.showFrame(this.data, t);
    set(this.cursor, { x1: this.x(t), x2: this.x(t) });
    const text = `cycle ${t.toFixed(2)} of ${cycles}`;
    Object.assign(this, { t });
    this.slider.value = t;
    this.slider.setAttribute("aria-valuetext", text);
    this.output.textContent = text;
  }
}

for (const root of document.querySelectorAll("[data-motion]")) new Motion(root);
