"use strict";
// Elements of a page, of HTML and of SVG.

/** An element; null attributes are omitted, and text is never parsed as markup. */
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.filter((c) => c !== null && c !== undefined));
  return made;
}

/** A button and what it does. */
function button(words, act, title = null) {
  const made = element("button", { type: "button", title }, words);
  made.addEventListener("click", act);
  return made;
}

/** A text in which ids with hyphens stay in one piece. */
const unbroken = (words) => words.split(/( )/).map((w) => (w.includes("-") ? element("span", { class: "id" }, w) : w));

const byId = (id) => document.getElementById(id);

const SVG = "http://www.w3.org/2000/svg";

function svgElement(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** A count with groups of three: 25,761,436. */
const grouped = (digits) => String(digits).replace(/\B(?=(\d{3})+(?!\d))/g, ",");

/** Gives a file to the browser to save. */
function saveFile(name, blob) {
  const link = element("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** The changes in a line, joints with the same change together: pairs of a joint and what it becomes. */
function changesInWords(pairs) {
  const by = new Map();
  for (const [joint, to] of pairs) by.set(to, [...(by.get(to) ?? []), joint]);
  return [...by].map(([to, joints]) => `${joints.join(", ")} → ${to}`).join("; ");
}
