// For each epsilon, show the points in the plane of forces that a criterion calls stable, and their exact stability.
"use strict";

class Verdicts extends Chart {
  constructor(root) {
    super(root.querySelector("svg"), 0);
    Object.assign(this, { data: dataOf(root), bottom: 36, criterion: "theory" });
    [this.slider, this.output, this.count] = ["input", "output", "#verdicts-count"].map((name) => root.querySelector(name));
    this.buttons = [...root.querySelectorAll("[data-criterion]")];
    this.slider.max = this.data.epsilon.length - 1;
    this.slider.addEventListener("input", () => this.show());
    for (const button of this.buttons) button.addEventListener("click", () => { this.criterion = button.dataset.criterion; this.show(); });
    new ResizeObserver(() => { this.layout(); this.show(); }).observe(root);
    this.layout();
    this.show();
  }

  place(f1, f2) {
    const ends = this.data.ends, share = (f) => (f - ends[0]) / (ends[1] - ends[0]);
    return [this.left + share(f1) * this.inner[0], this.top + (1 - share(f2)) * this.inner[1]];
  }

  layout() {
    super.layout();
    const [low, high] = this.data.ends;
    for (let n = 0; n <= 4; n++) {
      const f = low + (n / 4) * (high - low), [x, y] = this.place(f, f);
      this.text(this.back, x, this.height - 20, f.toFixed(1));
      this.text(this.back, this.left - 6, y + 4, f.toFixed(1), "end");
    }
    this.text(this.back, this.left + this.inner[0] / 2, this.height - 4, "force on box 1");
    const name = this.text(this.back, 0, 0, "force on box 2");
    name.setAttribute("transform", `translate(14 ${this.top + this.inner[1] / 2}) rotate(-90)`);
  }

  show() {
    const index = Number(this.slider.value), points = this.data[this.criterion][index], epsilon = String(this.data.epsilon[index]);
    this.front.replaceChildren();
    const size = (0.36 * this.inner[0]) / this.data.points; // small enough to draw the marks of one cell side by side
    const seen = {}, is = (verdict) => points.filter((point) => point[2] === verdict).length;
    for (const [f1, f2, verdict] of points) {
      const nth = (seen[`${f1},${f2}`] = (seen[`${f1},${f2}`] ?? -1) + 1), [x, y] = this.place(f1, f2), at = x + (nth - 0.25) * 0.8 * size;
      if (verdict === "stable") mark(this.front, "circle", "right", { cx: at, cy: y, r: size, "data-stable": true });
      else mark(this.front, "path", "wrong", { d: `M${at - size / 2} ${y - size / 2}l${size} ${size}m0 ${-size}l${-size} ${size}`, "data-stable": false });
    }
    this.output.textContent = epsilon;
    this.slider.setAttribute("aria-valuetext", epsilon);
    this.count.textContent = `At ε = ${epsilon}, ${points.length} points are called stable. ${is("stable")} of them have a stable exact orbit, and ${is("no orbit")} have no exact orbit.`;
    for (const button of this.buttons) button.setAttribute("aria-pressed", button.dataset.criterion === this.criterion);
  }
}

for (const root of document.querySelectorAll("#verdicts")) new Verdicts(root);
