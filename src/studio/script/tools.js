// The tools: what a click on the sheet does. Each has a letter; a tool that takes several clicks keeps its spots until it is done.

/** By tool: letter, name, what it says, and what it does with a spot. */
const TOOLS = {
  select: { key: "v", name: "Select", says: "Drag a pin to place it or a link to move the mechanism. Drag the background to turn or shift the sheet.", mark: "M4 2L4 17L8 13L11 19L13.5 18L10.5 12L16 12Z" },
  bar: { key: "b", name: "Bar", says: "Click both ends: pins, points of links or the background.", take: (spots) => (spots.length === 2 ? addLink(spots) : null), mark: "M4 16L16 4" },
  plate: { key: "p", name: "Plate", says: "Click the pins of the plate. To finish, click the first or last pin again or press Enter.", several: true, mark: "M3 16L10 3L17 13Z" },
  ground: { key: "g", name: "Frame pin", says: "Click a pin or a link to pivot it on the frame.", take: ([spot]) => ground(spot), mark: "M10 4L5 12H15ZM3 12H17M5 16L7 12M9 16L11 12M13 16L15 12" },
  slide: { key: "s", name: "Slide", says: "Click a pin, a link or the background to add a slide on the frame.", take: ([spot]) => addSlide(spot), mark: "M5 6H15V12H5ZM2 14H18" },
  screw: { key: "w", name: "Screw", says: "Click the bearing of the screw on the frame, then the pin or link that carries its nut. Its form has the lead.", take: (spots) => addScrew(spots), mark: "M2 10H18M5 6L8 14M9 6L12 14M13 6L16 14" },
  joint: { key: "j", name: "Joint", says: "Click a pin of two links, or a link and then another.", take: (spots) => joinSpots(spots), mark: "M10 10m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0" },
  drive: { key: "d", name: "Drive", says: "Click a joint to make it the drive, or to clear it.", take: ([spot]) => (spot.pin?.what === "joint" ? toggleDrive(spot.pin.id) : say("Click a joint.", true)), mark: "M10 3a7 7 0 1 1 -6 3M4 2V6H8" },
  gears: { key: "k", name: "Gears", says: "Click two joints: gears couple two hinges, a rack couples a slide and a hinge.", take: (spots) => meshJoints(spots), mark: "M7 10m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0M15 10m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0" },
  force: { key: "l", name: "Force", says: "Click where a force acts on a link; its form has the numbers.", take: ([spot]) => addForce(spot), mark: "M10 3V16M6 12L10 17L14 12" },
  output: { key: "o", name: "Output", says: "Click a link to mark or unmark it as an output. Redesigns keep the motion of outputs.", take: ([spot]) => markRole(spot, "output"), mark: "M3 10H15M10 5L15 10L10 15" },
  contact: { key: "c", name: "Clamped part", says: "Click the face of a jaw to add a contact with the clamped part.", take: ([spot]) => addContact(spot), mark: "M10 4V16M10 10H4M12 6H17V14H12" },
};
const tool = { name: "select", spots: [], at: null };

/** The link of a spot: at a pin, the one that is not the frame. */
const linkOfSpot = (spot) => spot.link ?? (spot.pin ? partnerAt(spot.pin) : null);

function markRole(spot, role) {
  const link = linkOfSpot(spot) ?? spot.plate;
  return link ? toggleRole(link, role) : say("Click a link.", true);
}

/** A joint of the chosen type between what is at two spots, at the second. */
function joinSpots(spots) {
  const [first, second] = spots;
  if (spots.length < 2) return null;
  const [a, b] = [linkOfSpot(first), linkOfSpot(second)];
  if (!a || !b || a === b) return say("Click two places of different links.", true);
  const made = newJoint([a, b], second.point, type, []);
  return change(made).then(() => select([{ what: "joint", id: made.entry.id }]));
}

function takeTool(name) {
  Object.assign(tool, { name, spots: [] });
  for (const button of document.querySelectorAll("#tools [data-tool]")) button.setAttribute("aria-pressed", button.dataset.tool === name);
  if (name !== "select") goHome();
  tellTool();
  redraw();
}

function tellTool() {
  if (byId("hint").querySelector(".note")) return;
  const { says } = TOOLS[tool.name];
  byId("hint").replaceChildren(element("p", {}, desk.file?.kind === "toml" ? says : readOnlyWords()));
}

function readOnlyWords() {
  if (!desk.file) return "";
  return desk.file.kind === "json" ? "A JSON file is changed as text; you can apply an idea to it." : "Robot descriptions are read-only here; you can apply an idea to them.";
}

/** A click of the tool that is in hand. */
async function useTool(spot) {
  const { take, several } = TOOLS[tool.name];
  if (several) {
    const same = (s) => s && apart(s.at, spot.at) < touching();
    if (tool.spots.length > 1 && (same(tool.spots[0]) || same(tool.spots.at(-1)))) return finishTool();
    tool.spots.push(spot);
    return redraw();
  }
  tool.spots.push(spot);
  const done = take(tool.spots);
  if (done !== null) tool.spots = [];
  redraw();
  await done;
}

/** Ends a tool that takes as many clicks as one likes. */
function finishTool() {
  const spots = tool.spots;
  tool.spots = [];
  redraw();
  return TOOLS[tool.name].several && spots.length > 1 ? addLink(spots) : null;
}

/** The picture of the tool: spots so far, the line to the next, and snapping guides. */
function toolPicture() {
  const out = [];
  const spots = tool.spots.map((s) => toPaper(s.at));
  const next = tool.at && tool.name !== "select" ? [toPaper(tool.at.at)] : [];
  if (spots.length) out.push(svgElement("path", { class: "drawn", d: path([...spots, ...next], false) }));
  out.push(...spots.map((p) => ring(p, 4, "drawn")));
  if (tool.at) {
    for (const [from, to] of tool.at.guides) out.push(svgElement("path", { class: "guide-line", d: path([toPaper(from), toPaper(to)], false) }));
    const at = toPaper(tool.at.at);
    if (tool.name !== "select") out.push(ring(at, tool.at.pin ? 11 : 5, "cross"), svgElement("path", { class: "cross", d: `M${at[0] - 9} ${at[1]}h18M${at[0]} ${at[1] - 9}v18` }));
    const words = `${tool.at.point.map(shown).join(", ")}${tool.at.words ? `  ${tool.at.words}` : ""}`;
    out.push(svgElement("text", { class: "small", x: Math.min(at[0] + 14, camera.size[0] - 7 * words.length), y: Math.min(at[1] + 22, camera.size[1] - 6) }, words));
  }
  return out;
}

/** The symbol of a joint type as in drawings, oblique, so that types differ. */
function typeIcon(kind) {
  const picture = svgElement("svg", { class: "ozd", viewBox: "-20 -20 40 40", width: 26, height: 26, "aria-hidden": "true" });
  const z = SLIDES.includes(kind) ? [1, 0, 0] : [0, 0, 1];
  const axes = SLIDES.includes(kind) ? [[0, 1, 0], [0, 0, 1], z] : [[1, 0, 0], [0, 1, 0], z];
  const view = ["revolute", "fixed", "prismatic", "slotted"].includes(kind) ? PLANES.xy : [[0.8, -0.6, 0], [0.3, 0.4, 0.866], [-0.52, -0.693, 0.5]];
  picture.append(...symbolAt(palette.find((t) => t.type === kind).symbol, axes, view, [0, 0]));
  return picture;
}

let palette = [];

async function makeTools() {
  const bar = byId("tools");
  for (const [name, { key, name: words, says, mark }] of Object.entries(TOOLS)) {
    const icon = svgElement("svg", { viewBox: "0 0 20 20", width: 20, height: 20, "aria-hidden": "true", class: "tool-icon" });
    icon.append(svgElement("path", { d: mark }));
    bar.append(acted(element("button", { type: "button", "data-tool": name, "aria-pressed": name === "select", title: `${words} (${key.toUpperCase()}): ${says}` }, icon, element("span", {}, words)), () => takeTool(name)));
  }
  palette = await (await fetch("palette")).json();
  const types = element("div", { id: "types", role: "group", "aria-label": "Joint types" });
  for (const { type: kind, class: word, free, about, axis } of palette) {
    const tip = `${kind}, class ${word}: ${about} Free: ${free.join(", ") || "nothing"}. Axis: ${axis}.`;
    types.append(acted(element("button", { type: "button", "data-type": kind, "aria-pressed": kind === type, "aria-label": kind, title: tip }, typeIcon(kind)), () => chooseType(kind)));
  }
  bar.append(types);
}

/** A type for what is drawn next, and with Select for the joints that are selected. */
function chooseType(kind) {
  type = kind;
  for (const button of document.querySelectorAll("#types [data-type]")) button.setAttribute("aria-pressed", button.dataset.type === kind);
  const joints = selection.filter((s) => s.what === "joint").map((s) => s.id);
  if (joints.length && tool.name === "select") return setType(joints, kind);
  say(`New joints are ${kind}.`);
  return null;
}
