// Curves over the stroke of the drive for what is selected, limits of the stroke, and a short tutorial.

/** The positions of the drive in the motion that is played, in the words of a file: a number, or degrees. */
const drivePlaces = () => {
  const move = desk.motion?.scenes?.[desk.state]?.moves[0];
  return move?.at?.length > 1 && !move.name.startsWith("idle") ? move : null;
};
const inFile = (x, unitWord) => (unitWord === "rad" ? `${Number(((x * 180) / Math.PI).toFixed(3))}deg` : Number(x.toPrecision(6)));

/** The stroke begins or ends where the slider is; null gives the whole one back. */
function limitStroke(end) {
  const move = drivePlaces();
  if (!move) return say("The mechanism has no motion of a drive.", true);
  if (end === null) return change({ do: "put", path: ["workload", "stroke"], value: null });
  const places = [move.at[0], move.at.at(-1)];
  places[end] = move.at[player.now];
  if (!(places[0] < places[1])) return say("Move the slider first: the stroke needs a start and an end.", true);
  const [from, to] = places.map((x) => inFile(x, move.unit));
  return change({ do: "put", path: ["workload", "stroke"], value: { from, to, steps: desk.look.file.workload?.stroke?.steps ?? 24 } });
}

/** The buttons that limit the stroke: shown if a motion of the drive is known. */
function strokeButtons() {
  const all = [["Start here", 0, "The stroke starts at the position of the slider"], ["End here", 1, "The stroke ends at the position of the slider"], ["Whole stroke", null, "The stroke goes as far as the drive does"]];
  return element("div", { id: "limits", class: "acts" }, ...all.map(([words, end, tip]) => button(words, () => limitStroke(end), tip)));
}

/** Angles that go on past half a turn. */
const unwound = (all) => all.reduce((out, x) => [...out, out.length ? x - 2 * Math.PI * Math.round((x - out.at(-1)) / (2 * Math.PI)) : x], []);

/** Slopes of a curve over another, by differences. */
const slopesOf = (x, y) => y.map((_, i) => {
  const [a, b] = [Math.max(0, i - 1), Math.min(y.length - 1, i + 1)];
  return x[b] === x[a] ? 0 : (y[b] - y[a]) / (x[b] - x[a]);
});

/** The motion of the selected thing over the stroke: a name, a unit and values. */
function seriesOf({ what, id }, scene) {
  const { poses } = scene.moves[0];
  const lengths = desk.look.file.length_unit ?? "m";
  const name = (l) => scene.names.indexOf(l);
  const turnOf = (pose, l) => (pose[l]?.length ? dot(pose[l].slice(0, 3), scene.view[2]) : 0);
  if (what === "link") {
    const l = name(id);
    return l < 0 ? [] : [["turn", "°", unwound(poses.map((p) => turnOf(p, l))).map((x) => (x * 180) / Math.PI)]];
  }
  const j = scene.joints.find((s) => s.id === id && Boolean(s.pair) === (what === "joint"));
  if (!j) return [];
  const ends = thing(what, id).links ?? [thing(what, id).link];
  const moving = ends.map(name).find((l) => l >= 0 && scene.names[l] !== frameOf()) ?? j.links[0];
  const places = poses.map((p) => times(carried(p, moving, j.at), 1 / scene.scale));
  const out = [0, 1, 2].map((k) => ["xyz"[k], lengths, places.map((p) => p[k] + scene.middle[k])]).filter(([, , y]) => Math.max(...y) - Math.min(...y) > touching());
  if (what === "joint" && !SLIDES.includes(thing("joint", id).type)) {
    const [a, b] = ends.map(name);
    const turns = unwound(poses.map((p) => turnOf(p, b) - turnOf(p, a)));
    if (Math.max(...turns) - Math.min(...turns) > 1e-5) out.push(["turn", "°", turns.map((x) => (x * 180) / Math.PI)]);
  }
  return out;
}

/** A curve with its range; a line marks the position of the slider. */
function curve(words, x, y, now = x[Math.min(player.now, x.length - 1)]) {
  const [w, h] = [330, 56];
  const [low, high] = [Math.min(...y), Math.max(...y)];
  const [from, to] = [Math.min(...x), Math.max(...x)];
  const across = (place) => 4 + ((w - 8) * (place - from)) / (to - from || 1);
  const at = (i) => [across(x[i]), h - 4 - ((h - 8) * (y[i] - low)) / (high - low || 1)];
  const picture = svgElement("svg", { class: "ozd curve", viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": `${words}, from ${shortly(low)} to ${shortly(high)}` });
  picture.append(svgElement("path", { class: "grid-line", d: `M${across(now).toFixed(1)} 0V${h}` }), svgElement("path", { class: "drawn", d: path(y.map((_, i) => at(i)), false) }));
  return element("figure", {}, element("figcaption", {}, `${words}: ${shortly(low)} to ${shortly(high)}`), picture);
}
const shortly = (x) => String(Number(x.toPrecision(4)));

/** The curves of the one thing that is selected: its position, and its first and second slope over the drive. */
function showCurves() {
  const room = byId("curves");
  const move = drivePlaces();
  const scene = desk.motion?.scenes?.[desk.state];
  const all = move && selection.length === 1 && desk.motion.revision === desk.revision ? seriesOf(selection[0], scene) : [];
  room.hidden = !move;
  if (!move) return;
  const one = ([name, unitWord, y]) => {
    const v = slopesOf(move.at, y);
    return [curve(`${name}, ${unitWord}`, move.at, y), curve(`velocity of ${name}, ${unitWord} per ${move.unit} of the drive`, move.at, v), curve(`acceleration of ${name}, ${unitWord} per ${move.unit}²`, move.at, slopesOf(move.at, v))];
  };
  const head = all.length ? `${selection[0].what} ${selection[0].id} over the stroke` : "Stroke";
  const help = all.length ? [] : [element("p", { class: "help" }, "Select a joint, a point or a link to see its curves. The slider under the drawing has the position for the buttons.")];
  const force = all.length ? desk.force?.charts[desk.state]?.drives?.[selection[0].id] : null;
  const effort = force ? [curve(`drive ${force[0] === "N" ? "force" : "torque"}, ${force[0]}`, force[1], force[2], move.at[player.now])] : [];
  refill(room, element("h2", {}, head), strokeButtons(), ...help, ...effort, ...all.flatMap(one));
}

/** The steps of the tutorial: what to do, and when it is done. */
const LESSON = [
  ["Draw the crank: take Bar (B), click two places.", () => listOf("link").length > 1],
  ["Draw the coupler: click the upper end of the crank, then a place to the right.", () => listOf("link").length > 2],
  ["Draw the rocker: click the end of the coupler, then a place below it.", () => listOf("link").length > 3],
  ["Pin it to the frame: take Frame pin (G), click the lower end of the crank, then that of the rocker.", () => listOf("joint").filter((j) => j.links.includes(frameOf())).length > 1],
  ["Choose the drive: take Drive (D) and click the frame pin of the crank.", () => listOf("joint").some((j) => j.drive)],
  ["Choose the output: take Output (O) and click the rocker.", () => listOf("link").some((l) => l.role === "output")],
  ["Play it. Its three redundant constraints come from parallel pins. Click an idea to remove them.", () => desk.verdict?.analysis?.states[0].redundant === 0 && desk.file.undo],
  ["Done: slightly inaccurate parts assemble without strain now. Undo goes back; Save keeps it.", () => false],
];

/** Shows the step of the tutorial that comes next. */
function teach() {
  if (teach.step === undefined) return;
  while (teach.step < LESSON.length - 1 && LESSON[teach.step][1]()) teach.step += 1;
  notice("lesson", `${teach.step + 1} of ${LESSON.length}: ${LESSON[teach.step][0]}`, ["End", () => {
    teach.step = undefined;
    notice("lesson", null);
  }]);
}

async function startLesson() {
  byId("shelf").close();
  if (!isEmpty()) await beginWith({ name: "mechanism" });
  teach.step = 0;
  teach();
}
