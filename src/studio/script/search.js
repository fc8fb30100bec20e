// Search options: joint types and limits for all joints, and types for the selected joints. They are written into the file.

/** Types that need more than their name, or that leave nothing to move. */
const NEED_MORE = ["helical", "custom", "fixed"];
/** The name of an option in a list of the file; a trade name means its type. */
const optionName = (o) => {
  const word = o.name ?? o.type ?? o;
  return palette.find((t) => t.trade.includes(word))?.type ?? word;
};
const searchOf = () => desk.look?.file?.search ?? {};
const putSearch = (key, value) => change({ do: "put", path: ["search", key], value });

/** A list of options with one more, or without it; other entries are unchanged. */
const toggled = (list, kind, on) => (on ? [...list, kind] : list.filter((o) => optionName(o) !== kind));

/** A box to tick with a joint type: its symbol, its name and what the trade calls it. */
function typeBox({ type: kind, trade, about }, on, take) {
  const box = element("input", { type: "checkbox", checked: on ? "" : null });
  box.addEventListener("change", () => take(box.checked));
  const names = trade.length ? element("small", {}, ` ${trade.join(", ").replaceAll("-", " ")}`) : "";
  return element("label", { class: "type-box", title: about }, box, typeIcon(kind), element("span", {}, kind, names));
}

function tick(words, on, take) {
  const box = element("input", { type: "checkbox", checked: on ? "" : null });
  box.addEventListener("change", () => take(box.checked));
  return element("label", { class: "check" }, box, ` ${words}`);
}

/** A field with a whole number, or nothing. */
function numberField(words, value, take) {
  const input = element("input", { type: "number", min: 0, step: 1, value: value ?? "", placeholder: "any" });
  input.addEventListener("change", () => take(input.value === "" ? null : Math.max(0, Math.round(Number(input.value)))));
  return element("label", { class: "number-field" }, element("span", {}, words), input);
}

/** The panel: types offered, and what is asked of a redesign. */
function showSearch() {
  const room = byId("search");
  room.hidden = desk.file?.kind !== "toml" || !desk.look?.file;
  if (room.hidden) return;
  const search = searchOf();
  const options = search.options ?? [];
  const offered = options.map(optionName);
  const boxes = palette.filter((t) => !NEED_MORE.includes(t.type))
    .map((t) => typeBox(t, offered.includes(t.type), (on) => putSearch("options", toggled(options, t.type, on))));
  const parts = [
    element("summary", {}, "Search options"),
    element("p", { class: "help" }, offered.length ? "A joint may become any ticked type that keeps its motion. Select a joint to allow or forbid types there." : "No type is ticked, so the usual ones are offered. Select a joint to allow or forbid types there."),
    element("div", { class: "type-boxes", role: "group", "aria-label": "Joint types offered" }, ...boxes),
    numberField("Most redundant constraints left", search.max_redundant ?? 0, (n) => putSearch("max_redundant", n || null)),
    numberField("Largest mobility W", search.max_mobility, (n) => putSearch("max_mobility", n)),
    tick("mirror-symmetric redesigns only", search.symmetric, (on) => putSearch("symmetric", on || null)),
  ];
  refill(byId("search-fold"), ...parts);
}

/** The types that a search may put at some joints; what is ticked holds for their mirror images, too. */
function typesAt(ids) {
  const joint = thing("joint", ids[0]);
  const own = palette.find((t) => t.type === joint.type);
  if (!own) return null;
  const images = (searchOf().mirror ?? []).filter((pair) => pair.some((id) => ids.includes(id))).flat();
  const all = [...new Set([...ids, ...images])];
  const stays = joint.drive || joint.type === "fixed" || joint.state;
  const offered = joint.options ?? (stays ? [] : searchOf().options ?? []).filter((o) => !(joint.forbid ?? []).includes(optionName(o)));
  const give = (key, value) => all.map((id) => set("joint", id, key, value));
  const take = (kind) => (on) => {
    const forbid = joint.forbid ?? [];
    if (joint.options) return change(...give("options", toggled(joint.options, kind, on)));
    if (!on) return change(...give("forbid", [...forbid, kind]));
    if (forbid.includes(kind)) return change(...give("forbid", forbid.length > 1 ? toggled(forbid, kind, false) : null));
    return change(...give("options", [...offered, kind]), ...give("forbid", null));
  };
  const fit = palette.filter((t) => !NEED_MORE.includes(t.type) && t.type !== joint.type && own.free.every((f) => t.free.includes(f)));
  const names = offered.map(optionName);
  const fold = element("details", { class: "wide", open: typesAt.open ? "" : null },
    element("summary", {}, "A search may put here"),
    stays && !joint.options ? element("p", { class: "help" }, "A search does not change this joint, unless a type is ticked.") : "",
    element("div", { class: "type-boxes" }, ...fit.map((t) => typeBox(t, names.includes(t.type), take(t.type)))),
    element("div", { class: "acts" },
      button("Never change it", () => change(...give("options", []), ...give("forbid", null))),
      button("As everywhere", () => change(...give("options", null), ...give("forbid", null)))));
  fold.addEventListener("toggle", () => (typesAt.open = fold.open));
  return fold;
}
