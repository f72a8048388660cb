// Curves on the same axes; a button shows or hides each of them.
"use strict";

class Layers {
  constructor(root) {
    const { axes, curves } = JSON.parse(document.getElementById(root.dataset.source).textContent);
    const svg = root.querySelector("svg"), [left, bottom, top, right] = [52, 42, 12, 12];
    const width = Math.max(svg.clientWidth, 300), height = Math.max(0.4 * width, 220); // so that letters keep their size
    const x = (phase) => left + (phase / axes.end) * (width - left - right);
    const y = (W) => top + ((axes.wall * 1.08 - W) / (2.16 * axes.wall)) * (height - top - bottom);
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("font-size", 14);
    svg.setAttribute("font-family", "system-ui, sans-serif");
    shape(svg, "rect", { x: left, y: top, width: width - left - right, height: height - bottom - top, fill: "none", stroke: "#4a4a4a" });
    for (let phase = 0; phase <= axes.end; phase += 0.5) shape(svg, "text", { x: x(phase), y: height - bottom + 18, "text-anchor": "middle" }, phase);
    for (const W of [-axes.wall, 0, axes.wall]) {
      shape(svg, "line", { x1: left, x2: width - right, y1: y(W), y2: y(W), stroke: "#c9c9c9" });
      shape(svg, "text", { x: left - 8, y: y(W) + 5, "text-anchor": "end" }, W);
    }
    shape(svg, "text", { x: (left + width - right) / 2, y: height - 5, "text-anchor": "middle" }, axes.x);
    shape(svg, "text", { x: 4, y: top + 40, "font-style": "italic" }, axes.y);
    for (const button of root.querySelectorAll("button")) {
      const { name, colour, dash } = button.dataset;
      const points = curves[name].map(([phase, W]) => `${x(phase)},${y(W)}`).join(" ");
      const line = shape(svg, "polyline", { points, fill: "none", stroke: colour, "stroke-width": 2.2, "stroke-dasharray": dash, "data-name": name });
      const show = (shown) => {
        button.setAttribute("aria-pressed", shown);
        line.setAttribute("visibility", shown ? "visible" : "hidden");
      };
      button.addEventListener("click", () => show(button.getAttribute("aria-pressed") !== "true"));
      show(button.getAttribute("aria-pressed") === "true");
    }
  }
}

for (const root of document.querySelectorAll("[data-layers]")) new Layers(root);
