// The selection in fields: names, exact positions checked while typed, axes, types, roles.

/** A field with its label; its text is tried while it is typed, and taken when it is left or Enter is pressed. */
function field(label, value, { take, trial = null, wide = false, list = null }) {
  const input = element("input", { type: "text", value, spellcheck: "false", autocomplete: "off", class: wide ? "wide-input" : null, "aria-label": label, list });
  const wrong = element("span", { class: "wrong-words", role: "status" });
  input.addEventListener("input", () => {
    const edits = trial?.(input.value);
    if (!edits) return;
    draft(edits, (answer) => {
      const told = answer.told.find((t) => t.grave);
      wrong.textContent = told ? told.words : "";
      input.setAttribute("aria-invalid", Boolean(told));
    });
  });
  const done = () => {
    if (input.value === value) return;
    value = input.value;
    endDrafts();
    take(input.value);
  };
  input.addEventListener("change", done);
  return element("label", { class: "field" }, element("span", {}, label), input, wrong);
}

/** A point or a direction: three fields. */
function triple(what, id, key, value, words) {
  const edit = (k) => (text) => {
    const now = value.map((c, i) => (i === k ? typed(text) : c));
    return key === "point" ? putPins([{ what, id, point: now }]).edits : [set(what, id, key, now)];
  };
  const one = (k) => field("xyz"[k], shown(value[k]), { trial: edit(k), take: (text) => change(...edit(k)(text)) });
  return element("fieldset", { class: "triple" }, element("legend", {}, words), ...[0, 1, 2].map(one));
}

function choice(label, options, now, take) {
  const box = element("select", {}, ...options.map(([value, words]) => element("option", { value, selected: value === now ? "" : null }, words)));
  return element("label", { class: "field" }, element("span", {}, label), acted(box, () => take(box.value), "change"));
}

/** Another name, wherever the file has it. */
const rename = (what, id) => (to) => change({ do: "rename", what, id, to: to.trim() }).then((done) => select([{ what, id: done ? to.trim() : id }]));

/** Along which axis, as a click. */
function axisButtons(id) {
  const along = (k) => () => change(set("joint", id, "axis", axisAlong(k)));
  return element("span", { class: "axes", role: "group", "aria-label": "Axis along" }, ...[0, 1, 2].map((k) => button("xyz"[k], along(k), `axis along ${"xyz"[k]}`)));
}

function aboutJoint(j) {
  const links = listOf("link").map((l) => [l.id, l.id]);
  const ends = (n) => (to) => change(set("joint", j.id, "links", j.links.map((l, i) => (i === n ? to : l))));
  const types = palette.map((t) => [t.type, `${t.type} (class ${t.class})`]);
  const states = ["", ...new Set(["clamped", ...listOf("joint").flatMap((x) => [x.state ?? []].flat())])];
  const out = [
    field("name", j.id, { take: rename("joint", j.id) }),
    choice("type", types, j.type, (to) => setType([j.id], to)),
    triple("joint", j.id, "point", j.point, "point"),
  ];
  if (j.axis) out.push(triple("joint", j.id, "axis", j.axis, "axis"), axisButtons(j.id));
  if (j.type === "helical") out.push(field("lead", shown(j.lead ?? ""), { take: (text) => change(set("joint", j.id, "lead", typed(text))) }));
  if (j.freedoms) out.push(field("freedoms", j.freedoms.join(", "), { take: (text) => change(set("joint", j.id, "freedoms", text.split(/[ ,]+/).filter(Boolean))) }));
  out.push(
    element("div", { class: "pair-fields" }, choice("between", links, j.links[0], ends(0)), choice("and", links, j.links[1], ends(1))),
    choice("there in", states.map((s) => [s, s || "all states"]), [j.state ?? ""].flat()[0], (to) => change(set("joint", j.id, "state", to || null))),
  );
  out.push(tick("drive", j.drive, () => toggleDrive(j.id)), ...couplingFields(j.id));
  return out;
}

function aboutLink(l) {
  const roles = [["", "none"], ["frame", "frame"], ["output", "output: its motion is kept"], ["object", "object: a part that is held"]];
  return [
    field("name", l.id, { take: rename("link", l.id) }),
    choice("role", roles, l.role ?? "", (to) => (to === "frame" ? toggleRole(l.id, "frame") : change(set("link", l.id, "role", to || null)))),
    ...lengthFields(l.id),
    ...(l.role === "frame" ? [] : loadFields(l)),
    element("p", { class: "help" }, `Joined by ${pinsOf(l.id).filter((p) => p.what === "joint").map((p) => p.id).join(", ") || "nothing yet"}.`),
  ];
}

function aboutPoint(p) {
  return [
    field("name", p.id, { take: rename("point", p.id) }),
    triple("point", p.id, "point", p.point, "point"),
    choice("on link", listOf("link").map((l) => [l.id, l.id]), p.link, (to) => change(set("point", p.id, "link", to))),
  ];
}

/** The actions on the selection. */
function acts() {
  const mirrors = paperAxes().map((k) => button(`Mirror ${"xyz"[k]}`, () => mirrorSelection(k), `Mirror in ${"xyz"[k]}; the two halves count as a symmetric pair`));
  return element("div", { class: "acts", role: "group", "aria-label": "Actions" },
    ...mirrors, button("Copy", copySelection, "A copy next to it (Ctrl+D)"), button("Delete", deleteSelection, "Delete (Del)"));
}

/** A button for each pin that is seen where the selected one is. */
function alsoHere() {
  const own = selection.length === 1 && sheetPins.find((p) => isSelected(p.what, p.id));
  const all = own ? seenWith(own) : [];
  if (all.length < 2) return [];
  const one = ({ what, id }) => {
    const made = button(id, () => select([{ what, id }]));
    made.setAttribute("aria-pressed", isSelected(what, id));
    return made;
  };
  return [element("div", { class: "acts", role: "group", "aria-label": "At this place" }, ...all.map(one))];
}

/** Shows what is selected. */
function inspect() {
  const room = byId("thing");
  const one = selection.length === 1 ? thing(selection[0].what, selection[0].id) : null;
  room.hidden = !selection.length;
  if (!selection.length) return room.replaceChildren();
  if (room.contains(document.activeElement) && room.dataset.of === key3() && inspect.revision === desk.revision) return null;
  [room.dataset.of, inspect.revision] = [key3(), desk.revision];
  const fixed = desk.file?.kind !== "toml";
  const about = { joint: aboutJoint, link: aboutLink, point: aboutPoint };
  const head = one ? `${selection[0].what} ${one.id}` : `${selection.length} selected`;
  const told = one ? toldOf(selection[0].what, one.id).map((t) => element("p", { class: t.grave ? "told bad" : "told" }, t.remedy ? `${t.words}; ${t.remedy}` : t.words)) : [];
  const fields = element("fieldset", { class: "fields", disabled: fixed ? "" : null }, ...(one ? about[selection[0].what](one) : []), acts());
  const joints = selection.filter((s) => s.what === "joint").map((s) => s.id);
  const types = !fixed && joints.length === selection.length ? typesAt(joints) : null;
  refill(room, element("h2", {}, head), ...alsoHere(), ...told, ...measured(), fields, types ?? "");
  // on a narrow screen the sheet would scroll away
  if (matchMedia("(min-width: 56.01rem)").matches) room.scrollIntoView({ block: "nearest" });
  return null;
}

/** Fills a room anew; who writes in one of its fields stays there. */
function refill(room, ...parts) {
  const fields = () => [...room.querySelectorAll("input,select,button,summary")];
  const at = fields().indexOf(document.activeElement);
  room.replaceChildren(...parts);
  if (at >= 0) fields()[at]?.focus();
}

const key3 = () => selection.map((s) => `${s.what} ${s.id}`).join("\n");
