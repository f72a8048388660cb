// Figures open large: by a click or tap on the picture, or by the button below it; Escape or another click closes.
"use strict";

{
  const dialog = document.createElement("dialog"), picture = new Image(), close = document.createElement("button");
  dialog.className = "large";
  dialog.style.cssText = "width: 100vw; height: 100vh; max-width: none; max-height: none; border: 0; padding: 0.5rem; overflow: auto; background: #fff; color: #1a1a1a";
  // On a phone the picture is wider than the window, and scrolls.
  picture.style.cssText = "display: block; width: max(100%, 52rem); height: auto; cursor: zoom-out";
  close.style.cssText = "position: sticky; left: 0; top: 0; font: inherit; padding: 0.4rem 1rem; z-index: 1";
  close.type = "button";
  close.textContent = "Close";
  dialog.append(close);
  for (const part of [close, picture]) part.addEventListener("click", () => dialog.close());

  const open = (image) => {
    picture.src = image.src;
    picture.alt = image.alt;
    dialog.setAttribute("aria-label", image.closest("figure").querySelector("figcaption")?.textContent.trim().slice(0, 100) ?? image.alt);
    dialog.append(picture);
    dialog.showModal();
  };

  for (const image of document.querySelectorAll("figure img")) {
    const line = document.createElement("p"), button = document.createElement("button");
    line.className = "control enlarge";
    line.style.margin = "0.3rem 0";
    button.type = "button";
    button.textContent = "Open large";
    line.append(button);
    image.after(line);
    image.style.cursor = "zoom-in";
    image.addEventListener("click", () => open(image));
    button.addEventListener("click", () => open(image));
  }
  if (document.querySelector("figure img")) document.body.append(dialog);
}
