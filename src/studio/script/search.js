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

/** Parts that are not joint types: a name, freedoms in the joint's frame, and words. The first two are seats, the others go in series. */
const PARTS = [
  ["ball-in-v-groove-x", ["rx", "ry", "rz", "tx"], "ball in a groove along x"],
  ["ball-in-v-groove-y", ["rx", "ry", "rz", "ty"], "ball in a groove along y"],
  ["gimbal-z", ["rx", "ry"], "tilts both ways"],
  ["sliding-gimbal-x", ["rx", "ry", "tx"], "tilts both ways, slides along x"],
  ["sliding-gimbal-y", ["rx", "ry", "ty"], "tilts both ways, slides along y"],
  ["floating-nut-z", ["rx", "ry", "tx", "ty"], "tilts and slides both ways"],
].map(([kind, free, words]) => ({ type: kind, free, trade: [words], icon: "custom", about: `${words}, in the joint's own frame` }));
/** The entry of a file for a type or a part. */
const entryOf = (kind) => {
  const part = PARTS.find((p) => p.type === kind);
  return part ? { name: kind, freedoms: part.free } : kind;
};

/** A list of options with one more, or without it; other entries are unchanged. */
const toggled = (list, kind, on) => (on ? [...list, entryOf(kind)] : list.filter((o) => optionName(o) !== kind));

/** A box to tick with a joint type: its symbol, its name and what the trade calls it. */
function typeBox({ type: kind, trade, about, icon }, on, take) {
  const names = trade.length ? element("small", {}, ` ${trade.join(", ").replaceAll("-", " ")}`) : "";
  return element("label", { class: "type-box", title: about }, tickBox(on, take, kind), typeIcon(icon ?? kind), element("span", {}, kind, names));
}

const tickBox = (on, take, kind = null) => acted(element("input", { type: "checkbox", checked: on ? "" : null, "data-type": kind }), ({ target }) => take(target.checked), "change");
const tick = (words, on, take) => element("label", { class: "check" }, tickBox(on, take), ` ${words}`);

/** A field with a number that is not negative, or nothing. */
function numberField(words, value, take, step = 1) {
  const input = element("input", { type: "number", min: 0, step, value: value ?? "", placeholder: step === 1 ? "any" : "none" });
  const whole = (x) => Math.max(0, step === 1 ? Math.round(x) : x);
  const done = () => take(input.value === "" ? null : whole(Number(input.value)));
  return element("label", { class: "number-field" }, element("span", {}, words), acted(input, done, "change"));
}

/** A row of boxes to tick for the links that a list names. */
function linkTicks(words, list, take) {
  const all = listOf("link").filter((l) => l.role !== "frame" && l.role !== "object");
  const box = (l) => tick(l.id, list.includes(l.id), (on) => take(on ? [...list, l.id] : list.filter((id) => id !== l.id)));
  return element("fieldset", { class: "ticks" }, element("legend", {}, words), ...all.map(box));
}

/** The terms of a ranking, each with its weight; without any, ideas come by cost. */
function rankingFields() {
  const ranking = desk.look.file.ranking ?? {};
  const terms = ranking.terms ?? [];
  const field = ([term, words]) => {
    const now = terms.find((t) => t.term === term);
    return numberField(words, now ? now.weight ?? 1 : null, (weight) => {
      const others = terms.filter((t) => t.term !== term);
      const all = weight === null ? others : now ? terms.map((t) => (t === now ? { ...t, weight } : t)) : [...others, { term, weight }];
      change({ do: "put", path: ["ranking"].concat(all.length ? "terms" : []), value: all.length ? all : null });
    }, "any");
  };
  return element("details", { open: rankingFields.open ? "" : null }, element("summary", {}, "Ranking"),
    element("p", { class: "help" }, "Give a weight to what counts. Without weights the ideas come by cost; forces need loads: select a link to add one."),
    ...TERMS.map(field));
}

/** Terms of a ranking: the word of the file, and a name. */
const TERMS = [["peak-force", "largest joint force"], ["peak-moment", "largest joint moment"], ["conditioning", "distance from a singular pose"], ["output-error", "output error by clearance"], ["changes", "changed joints"], ["cost", "cost"], ["idle", "idle motions"]];

/** The joints that a search may add in series at a joint. */
const seriesAt = (joint) => (joint.unloading === true ? searchOf().unloading ?? [] : joint.unloading || []);

/** Boxes for the joints in series that a search may add at a joint. */
function seriesBoxes(joint) {
  const list = seriesAt(joint);
  const take = (kind) => (on) => {
    const all = toggled(list, kind, on);
    return change(set("joint", joint.id, "unloading", all.length ? all : null));
  };
  const boxes = [palette.find((t) => t.type === "spherical"), ...PARTS.slice(2)].map((t) => typeBox(t, list.some((o) => optionName(o) === t.type), take(t.type)));
  return element("details", { open: list.length || seriesBoxes.open ? "" : null }, element("summary", {}, "And in series with it"), element("div", { class: "type-boxes" }, ...boxes));
}

/** Conditions on the drives: the word of the file, and what it means. */
const DRIVES = [["kept", "move the outputs as now"], ["independent", "independent: one for each degree of freedom"], ["free", "may lose their effect"]];

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
    choice("Drives", DRIVES, search.drives ?? "kept", (to) => putSearch("drives", to === "kept" ? null : to)),
    tick("keep the motion in the drawn pose only", search.pose_only, (on) => putSearch("pose_only", on || null)),
    tick("symmetric redesigns only", search.symmetric, (on) => putSearch("symmetric", on || null)),
    linkTicks("Links that keep their motion, besides the outputs", search.hold ?? [], (list) => putSearch("hold", list.length ? list : null)),
    rankingFields(),
  ];
  refill(byId("search-fold"), ...parts);
}

/** Whether a search leaves a joint unchanged unless options are listed at it. */
const stays = (joint) => joint.drive || joint.type === "fixed" || joint.state;
/** Whether a type or part, by its palette entry, has all freedoms of a joint's type. */
const fitsAt = (joint, made) => palette.find((t) => t.type === joint.type)?.free.every((f) => made.free.includes(f));
/** The options that a search has at a joint. Those of the common list that do not fit are skipped, as the search does. */
function offeredAt(joint) {
  const common = stays(joint) ? [] : searchOf().options ?? [];
  const kept = (o) => {
    const made = palette.find((t) => t.type === optionName(o));
    return (!made || fitsAt(joint, made)) && !(joint.forbid ?? []).includes(optionName(o));
  };
  return joint.options ?? common.filter(kept);
}

/** The types that a search may put at some joints; what is ticked holds for their mirror images, too. */
function typesAt(ids) {
  const joint = thing("joint", ids[0]);
  const images = (searchOf().mirror ?? []).filter((pair) => pair.some((id) => ids.includes(id))).flat();
  const all = [...new Set([...ids, ...images])];
  const offered = offeredAt(joint);
  const give = (key, value) => all.map((id) => set("joint", id, key, value));
  const take = (kind) => (on) => {
    const forbid = joint.forbid ?? [];
    if (joint.options) return change(...give("options", toggled(joint.options, kind, on)));
    if (!on) return change(...give("forbid", [...forbid, kind]));
    if (forbid.includes(kind)) return change(...give("forbid", forbid.length > 1 ? toggled(forbid, kind, false) : null));
    return change(...give("options", toggled(offered, kind, true)), ...give("forbid", null));
  };
  const fit = [...palette, ...PARTS].filter((t) => !NEED_MORE.includes(t.type) && t.type !== joint.type && fitsAt(joint, t));
  const names = offered.map(optionName);
  const fold = element("details", { class: "wide", open: typesAt.open ? "" : null },
    element("summary", {}, "A search may put here"),
    stays(joint) && !joint.options ? element("p", { class: "help" }, "A search does not change this joint, unless a type is ticked.") : "",
    fit.length ? "" : element("p", { class: "help" }, "No other joint type keeps its motion."),
    element("div", { class: "type-boxes" }, ...fit.map((t) => typeBox(t, names.includes(t.type), take(t.type)))),
    element("div", { class: "acts" },
      button("Never change it", () => change(...give("options", []), ...give("forbid", null))),
      button("As everywhere", () => change(...give("options", null), ...give("forbid", null)))),
    ids.length === 1 ? seriesBoxes(joint) : "");
  fold.addEventListener("toggle", () => (typesAt.open = fold.open));
  return fold;
}
