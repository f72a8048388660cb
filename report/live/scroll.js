// Make elements that scroll horizontally focusable by keyboard, and give captions a heading level.
const mayScroll = document.querySelectorAll(".table-wrapper, .math-wrapper, .scroll, pre");

function reachable() {
  for (const part of mayScroll) {
    if (part.scrollWidth > part.clientWidth && getComputedStyle(part).overflowX === "auto") part.tabIndex = 0;
    else part.removeAttribute("tabindex");
  }
}

for (const caption of document.querySelectorAll("p[role=heading]")) caption.ariaLevel = 2;
reachable();
addEventListener("resize", reachable);
