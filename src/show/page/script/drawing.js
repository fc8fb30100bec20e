// A still drawing of the original mechanism, with the symbols of a variant.

/** The swap of a change in the scene of a state, or undefined. */
function swapOf(state, { variable, choice, joint }) {
  const n = page.swaps[state].findIndex((r) => r[0] === variable && r[1] === choice && r[2] === joint);
  return page.scenes[state]?.swaps[n];
}

/** The symbol of a swap as the first view has it. */
function symbolOf(state, swap) {
  const { symbols, view } = page.scenes[state];
  return symbolAt(symbols[swap.symbol], swap.axes, view, [0, 0]);
}

/** Puts another class into a joint of a structural scheme. */
function reclass(place, { classes, unloading }) {
  for (const circle of place.querySelectorAll("circle")) circle.classList.add("changed");
  place.querySelector("text").textContent = classes[1];
  if (unloading) place.append(svgElement("circle", { class: "line new", r: 19.5 }));
}

const childNamed = (node, name) => [...node.children].find((c) => c.localName === name);

/** Tints the contours by their redundant constraints; without tint if these are unknown. */
function tint(svg, state, i) {
  const { contours } = page.states[state];
  const left = state === 0 ? (found.redundant[i] === 0 ? contours.map(() => 0) : found.contours[i]) : null;
  contours.forEach((contour, n) => {
    const known = left ? `, σ = ${left[n]}` : "";
    const look = `s s${left ? Math.min(left[n], 6) : 0}`;
    for (const group of svg.querySelectorAll(`[data-contour="${n + 1}"]`)) {
      const path = group.firstElementChild;
      path.setAttribute("class", look);
      childNamed(path, "title").textContent = `contour ${n + 1}: ${contour.name}${known}`;
    }
    for (const key of svg.querySelectorAll(`[data-contour-key="${n + 1}"]`)) {
      key.firstElementChild.setAttribute("class", look);
      key.nextElementSibling.textContent = `${contour.name}${known}`;
    }
  });
}

/** W and σ of a variant in a state. */
function figures(i, state) {
  if (state === 0) return { mobility: found.mobility[i], redundant: found.redundant[i] };
  const of = found.states[state - 1];
  return { mobility: of.mobility[i], redundant: of.redundant[i] };
}

/** Puts title and figures of a variant into a drawing. */
function entitle(svg, state, i, changes) {
  const now = page.states[state];
  const { mobility, redundant } = figures(i, state);
  const name = `${page.mechanism}, ${noun().toLowerCase()} ${i + 1}`;
  const added = changes.filter((c) => c.unloading).length;
  const freedoms = mobility - redundant + now.rows;
  const line = `n = ${now.links + added}, p = ${now.joints + added}, k = ${now.contours.length}, f = ${freedoms}, W = ${mobility}, σ = ${redundant}`;
  svg.querySelector("text.title").textContent = name;
  const subtitles = svg.querySelectorAll("text.sub");
  if (subtitles.length > 1) subtitles[1].textContent = line;
  childNamed(svg, "title").textContent = name;
  const what = subtitles.length ? subtitles[0].textContent : "Drawing";
  const list = changes.map((c) => `${c.id}: ${c.from} becomes ${c.to}`).join("; ");
  childNamed(svg, "desc").textContent = `${what}: ${line}. Changed: ${list || "nothing"}.`;
}

/** Puts the symbols of a variant into a still drawing. */
function dress(svg, state, kind, i) {
  const changes = changesOf(i);
  const groups = (name) => new Map([...svg.querySelectorAll(`[${name}]`)].map((g) => [g.getAttribute(name), g]));
  const [symbols, names] = [groups("data-joint"), groups("data-joint-name")];
  for (const change of changes) {
    const swap = swapOf(state, change);
    const place = symbols.get(change.id);
    if (!place) continue;
    if (kind === "scheme") reclass(place, change);
    else if (swap) place.replaceChildren(...symbolOf(state, swap));
    const label = names.get(change.id);
    if (label) label.firstElementChild.classList.add("changed");
  }
  if (kind === "scheme") tint(svg, state, i);
  entitle(svg, state, i, changes);
}
