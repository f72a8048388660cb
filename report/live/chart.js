// What the live pages draw with.
"use strict";

const SVG = "http://www.w3.org/2000/svg";

function mark(parent, kind, name, attributes = {}, text = "") {
  const made = document.createElementNS(SVG, kind);
  if (name) made.setAttribute("class", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  parent.append(made);
  return made;
}

const set = (element, attributes) => { for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value); };

// A chart whose letters keep their size: its unit is the pixel of the page.
class Chart {
  constructor(svg, height) {
    Object.assign(this, { svg, fixed: height, left: 46, right: 14, top: 8, bottom: 22 });
    this.back = mark(svg, "g");
    this.front = mark(svg, "g");
  }

  layout() {
    this.width = Math.max(this.svg.clientWidth, 240);
    this.height = this.fixed || this.width - this.left - this.right + this.top + this.bottom; // a square inside
    set(this.svg, { viewBox: `0 0 ${this.width} ${this.height}`, height: this.height });
    this.back.replaceChildren();
    this.inner = [this.width - this.left - this.right, this.height - this.top - this.bottom];
    mark(this.back, "rect", "frame", { x: this.left, y: this.top, width: this.inner[0], height: this.inner[1] });
  }

  text(layer, x, y, words, anchor = "middle") {
    return mark(layer, "text", "", { x, y, "text-anchor": anchor }, words);
  }
}
