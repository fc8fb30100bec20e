// The unit of length: another one converts the numbers of the file, exactly.

/** Micrometres of each unit. */
const UNITS = { mm: 1e3, cm: 1e4, m: 1e6, in: 25400, um: 1 };
/** Keys whose numbers are lengths. */
const LENGTHS = ["point", "lead", "pitch", "centre", "radius", "position", "length"];

/** A coordinate divided by a number, as a short number if it is one and else as a fraction. */
function divided(c, by) {
  const [, top, under] = /^(\(.*\)|[^()/]+)\/(\d+(?:\.\d+)?)$/.exec(c) ?? [null, String(c), 1];
  const over = Number((under * by).toPrecision(12));
  const n = numeral(top);
  if (n === null) {
    const inner = /^\((.*)\)$/.exec(top);
    const whole = inner && balanced(inner[1]);
    return over === 1 ? (whole ? inner[1] : top) : `${whole ? top : `(${top})`}/${over}`;
  }
  const x = Number((n / over).toPrecision(12));
  return String(x).length < 10 || Number.isInteger(Math.log10(over)) ? x : `${top}/${over}`;
}

/** A value of the file with its lengths divided. */
function scaled(value, key, by) {
  if (Array.isArray(value)) return value.map((v) => scaled(v, key, by));
  if (value && typeof value === "object") return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, scaled(v, k, by)]));
  return LENGTHS.includes(key) && value !== null ? divided(value, by) : value;
}

/** Writes the file in another unit; the picture stays. */
function convertTo(word) {
  const { file } = desk.look;
  const { workload = {}, coupling } = file;
  if (workload.grip || workload.drive) return say("Change the unit in the text: lengths of [workload.grip] and [workload.drive] are not converted here.", true);
  const by = UNITS[word] / UNITS[file.length_unit ?? "m"];
  const slides = (id) => SLIDES.includes(thing("joint", id.split(":")[0])?.type);
  const changed = (table, make) => Object.entries(table ?? {}).flatMap(([key, value]) => {
    const now = scaled(value, key, by);
    return JSON.stringify(now) === JSON.stringify(value) ? [] : [make(key, now)];
  });
  const edits = ["joint", "point", "link"].flatMap((what) => listOf(what).flatMap((t) => changed(t, (key, now) => set(what, t.id, key, now))));
  edits.push(...["search", "workload", "tolerances", "tolerance"].flatMap((name) => changed(file[name], (key, value) => ({ do: "put", path: [name, key], value }))));
  // positions of a slide that is driven first are lengths, and so are ratios of a rack
  const first = listOf("joint").find((j) => j.drive);
  const ends = (t) => ({ ...t, ...Object.fromEntries(["from", "to"].filter((k) => typeof t[k] === "number").map((k) => [k, divided(t[k], by)])) });
  if (first && slides(first.id)) {
    if (workload.stroke) edits.push({ do: "put", path: ["workload", "stroke"], value: ends(workload.stroke) });
    if (workload.force) edits.push({ do: "put", path: ["workload", "force"], value: scaled(workload.force, "force", by).map(ends) });
  }
  if (coupling) {
    const ratio = ({ joints: [a, b], ratio: c }) => (slides(a) === slides(b) ? c : divided(c, slides(b) ? by : 1 / by));
    edits.push({ do: "put", path: ["coupling"], value: coupling.map((c) => ({ ...c, ratio: ratio(c) })) });
  }
  camera.centre = times(camera.centre, 1 / by);
  camera.zoom *= by;
  return change({ do: "put", path: ["length_unit"], value: word }, ...edits);
}
