// Buttons that leave of a table the rows of one verdict, of one section, or of both.
"use strict";

for (const root of document.querySelectorAll("[data-filter]")) {
  const buttons = [...root.querySelectorAll("button")], output = root.querySelector("output");
  const rows = [...document.getElementById(root.dataset.filter).querySelectorAll("tbody tr")];
  const chosen = {};

  const show = () => {
    for (const row of rows) {
      const said = row.querySelector(".of").dataset;
      row.hidden = Object.entries(chosen).some(([kind, value]) => value && said[kind] !== value);
    }
    for (const button of buttons) {
      const { kind, value } = button.dataset;
      button.setAttribute("aria-pressed", value === (chosen[kind] ?? ""));
    }
    output.textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} statements`;
  };

  for (const button of buttons) {
    button.addEventListener("click", () => {
      chosen[button.dataset.kind] = button.dataset.value;
      show();
    });
  }
  // A link to a statement brings it back.
  addEventListener("hashchange", () => {
    if (!rows.some((row) => row.hidden && row.querySelector(":target"))) return;
    for (const kind of Object.keys(chosen)) chosen[kind] = "";
    show();
    document.querySelector(":target").scrollIntoView();
  });
  show();
}
