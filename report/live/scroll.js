// What is wider than the window scrolls by itself; then it can be reached by keyboard, too.
const mayScroll = document.querySelectorAll("article p, article ul, article ol, article pre, article .scroll");

function reachable() {
  for (const part of mayScroll) {
    if (part.scrollWidth > part.clientWidth && getComputedStyle(part).overflowX === "auto") part.tabIndex = 0;
    else part.removeAttribute("tabindex");
  }
}

reachable();
addEventListener("resize", reachable);
document.addEventListener("toggle", reachable, true);
