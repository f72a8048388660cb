// What is wider than the window scrolls by itself: it can be reached by keyboard, too. Captions are headings of a level.
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
