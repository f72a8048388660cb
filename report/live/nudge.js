// Show a periodic motion after a small perturbation. The distance from it grows by the factor |multiplier|
// in each period, until flights become asymmetric.
"use strict";

const SECONDS = 10;

class Dots extends Chart {
  // ticks: pairs [value, text] of the vertical axis; at: function that maps a value to a position between 0 and 1.
  constructor(svg, cycles, ticks, at) {
    super(svg, 200);
    Object.assign(this, { cycles, ticks, at, left: 40, bottom: 34 });
  }

  x(t) { return this.left + (t / this.cycles) * this.inner[0]; }

  y(value) { return this.top + (1 - this.at(value)) * this.inner[1]; }

  layout() {
    super.layout();
    for (const [value, words] of this.ticks) {
      mark(this.back, "line", "rule", { x1: this.left, x2: this.left + this.inner[0], y1: this.y(value), y2: this.y(value) });
      this.text(this.back, this.left - 6, this.y(value) + 4, words, "end");
    }
    for (let t = 0; t <= this.cycles; t += 10) this.text(this.back, this.x(t), this.height - 18, t);
    this.text(this.back, this.left + this.inner[0] / 2, this.height - 3, "forcing periods");
  }

  show(points, t) {
    this.front.replaceChildren(...points.filter(([time]) => time <= t).map(([time, value]) => mark(this.front, "circle", "right", { cx: this.x(time), cy: this.y(value), r: 3 })));
  }
}

class Nudge {
  constructor(root) {
    const [machine, distance, flights] = root.querySelectorAll("svg"), button = root.querySelector("button");
    this.data = dataOf(root);
    const { cycles, distance: climbs, multiplier: [multiplier] } = this.data;
    if (!cycles) return void (root.hidden = true);
    this.climbs = climbs.map((value, t) => [t, value]);
    this.machine = new Machine(machine);
    this.charts = [
      new Dots(distance, cycles, [[1e-6, "10⁻⁶"], [1e-4, "10⁻⁴"], [1e-2, "10⁻²"], [1, "1"]], (value) => (Math.log10(value) + 6.5) / 7),
      new Dots(flights, cycles, [[0.25, "¼"], [0.5, "½"], [0.75, "¾"]], (value) => (value - 0.2) / 0.6),
    ];
    const draw = () => {
      for (const chart of this.charts) chart.layout();
      const [chart] = this.charts, [first] = climbs, end = -Math.log(first) / Math.log(multiplier);
      mark(chart.back, "line", "ghost", { x1: chart.x(0), y1: chart.y(first), x2: chart.x(end), y2: chart.y(1) });
      chart.text(chart.back, chart.x(end / 2 + 2), chart.y(Math.sqrt(first)) + 10, `× ${multiplier.toFixed(2)} per period`, "start");
      this.show(this.t);
    };
    this.t = matchMedia("(prefers-reduced-motion: reduce)").matches ? cycles : 0;
    new ResizeObserver(draw).observe(root);
    draw();
    this.clock = new Clock(button, (seconds) => {
      this.show(Math.min(cycles, this.t + (seconds * cycles) / SECONDS));
      if (this.t >= cycles) this.end();
    });
    button.addEventListener("click", () => { if (this.clock.on && this.t >= cycles) this.t = 0; });
    if (this.t >= cycles) this.end();
  }

  end() {
    this.clock.turn(false);
    this.clock.button.textContent = "Play again";
  }

  // Show both boxes at time t, by linear interpolation between the rows of the motion.
  showMachine({ motion, impacts }, t) {
    const n = Math.max(0, Math.min(motion.t.findLastIndex((time) => time <= t), motion.t.length - 2));
    const part = Math.min(1, (t - motion.t[n]) / (motion.t[n + 1] - motion.t[n] || 1));
    const [X1, X2, Y1, Y2] = ["X1", "X2", "Y1", "Y2"].map((name) => motion[name][n] + part * (motion[name][n + 1] - motion[name][n]));
    const since = (module, wall) => Math.min(...impacts.filter((hit) => hit[1] === module && hit[2] === wall && hit[0] <= t).map((hit) => t - hit[0]));
    this.machine.show([X1, X2], [Y1, Y2], [1, 2].map((module) => [1, -1].map((wall) => since(module, wall))));
  }

  show(t) {
    this.t = t;
    this.showMachine(this.data, t);
    this.charts[0].show(this.climbs, t);
    this.charts[1].show(this.data.flights, t);
  }
}

for (const root of document.querySelectorAll("[data-nudge]")) new Nudge(root);
