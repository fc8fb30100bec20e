// Files that a reader can save: pictures as SVG or PNG, tables as CSV on the clipboard.

/** Pixels of a saved picture for each of the drawing's. */
const FINE = 2;
/** The style properties written into a picture whose rules are in the page. */
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "font-size", "font-family", "font-weight", "text-anchor"];

/** A whole picture in its own size: what the stage shows a part of, too. */
function wholeOf(svg) {
  const whole = svg.cloneNode(true);
  whole.setAttribute("viewBox", svg.dataset.whole ?? svg.getAttribute("viewBox"));
  const [, , width, height] = whole.getAttribute("viewBox").split(" ").map(Number);
  whole.setAttribute("width", width);
  whole.setAttribute("height", height);
  whole.querySelector('[data-home="scale"]')?.removeAttribute("transform");
  return whole;
}

/** Runs `use` with a whole picture in a hidden part of the page, so that styles apply to it. */
function staged(svg, use) {
  const room = element("div", { class: "offstage", "aria-hidden": "true" });
  const whole = wholeOf(svg);
  room.append(whole);
  byId("stage").after(room);
  try {
    return use(whole);
  } finally {
    room.remove();
  }
}

/** A picture as a separate file: with its rules, or with each style property written where it applies. */
function saveSvg(svg, name) {
  const text = staged(svg, (whole) => {
    if (!whole.querySelector("style")) {
      for (const part of whole.querySelectorAll("path,circle,rect,text")) {
        const look = getComputedStyle(part);
        for (const key of LOOKS) part.setAttribute(key, look.getPropertyValue(key));
      }
    }
    return new XMLSerializer().serializeToString(whole);
  });
  saveFile(`${name}.svg`, new Blob([text], { type: "image/svg+xml" }));
}

/** The outline of an element, and the position of its text. */
function outline(part) {
  const n = (key) => Number(part.getAttribute(key) ?? 0);
  const way = new Path2D(part.localName === "path" ? part.getAttribute("d") : undefined);
  if (part.localName === "circle") way.arc(n("cx"), n("cy"), n("r"), 0, 2 * Math.PI);
  if (part.localName === "rect") way.rect(n("x"), n("y"), n("width"), n("height"));
  return { way, at: [n("x"), n("y")] };
}

/** Paints one element; a picture cannot be loaded as one here, since the page's policy allows no images. */
function paint(on, part) {
  const look = getComputedStyle(part);
  if (look.visibility === "hidden" || look.display === "none") return;
  const { a, b, c, d, e, f } = part.getCTM();
  on.setTransform(FINE * a, FINE * b, FINE * c, FINE * d, FINE * e, FINE * f);
  on.lineWidth = parseFloat(look.strokeWidth);
  on.lineCap = look.strokeLinecap;
  on.lineJoin = look.strokeLinejoin;
  on.setLineDash(look.strokeDasharray === "none" ? [] : look.strokeDasharray.split(/[ ,]+/).map(parseFloat));
  on.font = `${look.fontWeight} ${look.fontSize} ${look.fontFamily}`;
  on.textAlign = look.textAnchor === "middle" ? "center" : look.textAnchor;
  const { way, at } = outline(part);
  const text = part.localName === "text" ? [part.textContent, ...at] : null;
  const steps = {
    fill: () => {
      on.fillStyle = look.fill;
      if (text) on.fillText(...text);
      else on.fill(way);
    },
    stroke: () => {
      on.strokeStyle = look.stroke;
      if (text) on.strokeText(...text);
      else on.stroke(way);
    },
  };
  for (const step of look.paintOrder.startsWith("stroke") ? ["stroke", "fill"] : ["fill", "stroke"]) {
    if (look[step] === "none") continue;
    on.globalAlpha = parseFloat(look.opacity) * parseFloat(look[`${step}Opacity`]);
    steps[step]();
  }
}

/** Saves a picture on the page's ground. */
function savePng(svg, name) {
  staged(svg, (whole) => {
    const canvas = document.createElement("canvas");
    for (const side of ["width", "height"]) canvas[side] = Math.ceil(FINE * Number(whole.getAttribute(side)));
    const on = canvas.getContext("2d");
    on.fillStyle = getComputedStyle(document.body).backgroundColor;
    on.fillRect(0, 0, canvas.width, canvas.height);
    for (const part of whole.querySelectorAll("path,circle,rect,text")) if (!part.closest("defs")) paint(on, part);
    canvas.toBlob((blob) => saveFile(`${name}.png`, blob));
  });
}

/** Buttons that save the picture of a figure. */
function keepButtons(svgOf, nameOf, whole) {
  const button = (words, label, act) => {
    const made = element("button", { type: "button", class: "keep", "aria-label": label }, words);
    made.addEventListener("click", act);
    return made;
  };
  return element("span", { class: "keeps" },
    whole ? button("Full size", "The drawing in full size", () => showWhole(svgOf())) : null,
    button("SVG", "Save the picture as SVG", () => saveSvg(svgOf(), nameOf())),
    button("PNG", "Save the picture as PNG", () => savePng(svgOf(), nameOf())));
}

/** Rows of cells as CSV, as RFC 4180 has it. */
const csv = (rows) => rows.map((cells) => cells.map((c) => (/[",\r\n]/.test(c) ? `"${c.replaceAll('"', '""')}"` : c)).join(",")).join("\r\n") + "\r\n";
const cellText = (cell) => cell.innerText.replace(/\s+/g, " ").trim();
/** The rows of a table as texts. */
const rowsOf = (made) => [...made.rows].map((row) => [...row.cells].map(cellText));

/** Puts text on the clipboard; by the old way where a browser keeps the new one from files. */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = element("textarea", { class: "offstage" });
    field.value = text;
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
  }
}

/** A button that copies rows. */
function copyButton(rows) {
  const button = element("button", { type: "button", class: "keep", "aria-live": "polite" }, "Copy as CSV");
  button.addEventListener("click", async () => {
    await copy(csv(rows()));
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = "Copy as CSV"), 1500);
  });
  return button;
}

/** The name of a picture's file: the mechanism's, with what is shown. */
const fileName = (...words) => [page.mechanism, ...words].join("-").replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^[.-]+|-+$/g, "") || "mechanism";

function listenToKeepers() {
  for (const pane of document.querySelectorAll(".pane")) {
    const what = () => (pane.id === "built" ? "as-built" : `${noun().toLowerCase()}-${view.chosen + 1}`);
    const lines = () => pane.querySelector(".turn svg");
    pane.querySelector("figcaption").append(keepButtons(lines, () => fileName(what(), stage.kind), true));
  }
  for (const figure of document.querySelectorAll("#mechanism figure.drawing")) {
    const { kind, state } = figure.dataset;
    const name = () => fileName(page.states[Number(state)].name, kind);
    figure.append(element("figcaption", {}, keepButtons(() => figure.querySelector("svg"), name, true)));
  }
  for (const made of document.querySelectorAll("#mechanism table")) made.caption.append(" ", copyButton(() => rowsOf(made)));
  if (!found) return;
  byId("chart").querySelector("figcaption").append(keepButtons(() => document.querySelector("#chart-room svg"), () => fileName("chart"), false));
  byId("variants").caption.append(" ", copyButton(listRows));
}
