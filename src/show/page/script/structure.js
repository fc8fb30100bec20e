// The gripper that is chosen: drawing, figures, ideas, and how to go on.
function changesOf(idea) {
  // "a, b -> spherical; c -> cylindrical"
  return idea.changes.split('; ').flatMap((part) => {
    const [joints, to] = part.split(' -> ');
    return to ? joints.split(', ').map((j) => [j, to]) : [];
  });
}

/** The figures of a gripper, each with its name. */
function figuresOf(c) {
  const drive = c.input === 'slide' ? 'mm' : 'rad';
  const ends = [['closing', c.ends_closing], ['opening', c.ends_opening]].filter((e) => e[1]).map((e) => `${e[0]}: ${e[1]}`);
  const rows = [
    ['Structure', `${c.id}: ${c.name}`],
    ...(c.classics ? [[c.jaw_c_motion ? 'With two jaws known as' : 'Known as', c.classics]] : []),
    ['Form', `${c.links} links, ${formOf(c)}; jaws at the frame: ${c.jaws_at_frame}${c.truss ? '; a truss with the part' : ''}${c.drawing && c.drawing.folded ? '; of three sides two are drawn, opposite each other' : ''}`],
    ['Jaws', `${jawsOf(c)}; they turn by at most ${short(c.jaw_turn)}°`],
    ['Opening', `${short(c.opening_min)} to ${short(c.opening_max)} mm for ${short(c.travel)} ${drive} of the drive${ends.length ? ' (' + ends.join(', ') + ')' : ''}`],
    ['Force of a jaw', `${short(c.force_min)} ${unit(c)} at least, ${short(c.force_max)} at most over the stroke, without friction`],
    ['Transmission', `worst angle ${short(c.transmission)}°, links 1 : ${short(c.link_ratio)}, crossings: ${c.crossings}`],
    ...(c.pin_force ? [
      ['Task', c.shortfall || 'does all of it'],
      ['Joints', `${short(c.pin_force)} N at most for 1 N of each jaw; efficiency from ${short(c.efficiency)}`],
      ...(c.stacked ? [['Planes', c.planes ? `${c.planes}, links from the back: ${c.in_planes}` : 'something meets in whatever planes its links lie']] : []),
      ['Room', `${short(c.width)} by ${short(c.height)} mm over the stroke`],
      ['Actuator', `work ${short(c.actuator)} N mm for 1 N of each jaw: travel by greatest force, friction included`],
      ...(c.price ? [['Price', `${short(c.price)} revolute joints, with the cheapest redesign`]] : []),
    ] : []),
  ];
  return rows.concat([
    ['As built', `W = ${c.mobility}, σ = ${c.redundant}; finite mobility ${c.finite}`],
    ['Without redundant', `${least(c)}${grouped(c.determinate)} assignments, ${grouped(c.determinate_w1)} of them with W = 1`],
  ]);
}

let kept = null;

/** Figures of a gripper, next to those of the one kept for comparison. */
function figureTable(c) {
  const own = figuresOf(c);
  if (!kept || kept === c) return element('dl', {}, ...own.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
  const other = new Map(figuresOf(kept)), mine = new Map(own), names = [...new Set([...mine.keys(), ...other.keys()])];
  const head = ['', titleOf(c), titleOf(kept)].map((words) => element('th', { scope: words ? 'col' : null }, words));
  const rows = names.map((name) => element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, mine.get(name) || '–'), element('td', {}, other.get(name) || '–')));
  return element('div', { class: 'wide beside' }, element('table', {}, element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...rows)));
}

/** A button that keeps a gripper for comparison, or releases it. */
const keeping = (c, anew) => button(kept === c ? 'Let it go' : 'Keep to compare', () => {
  kept = kept === c ? null : c;
  anew();
});

/** A figure over the opening, from open to closed, on a scale from 0. */
function strokeChart(words, widths, values, most) {
  const [first, last] = [widths[0], widths.at(-1)];
  const at = (x, i) => [8 + (204 * (widths[i] - first)) / (last - first), 52 - (44 * x) / most];
  const chart = svgElement('svg', { class: 'gripper chart', viewBox: '0 0 220 60', role: 'img' });
  chart.append(svgElement('title', {}, words), svgElement('path', { class: 'guide', d: path([[8, 52], [212, 52]]) }), svgElement('path', { class: 'drive', d: path(values.map(at)) }));
  return element('figure', {}, chart, element('figcaption', { class: 'help' }, words));
}

/** The force of a jaw and the transmission angle over the stroke. */
function strokeCharts(c, frames) {
  const all = frames.flatMap((f) => figuresAt(c.drawing, motions(c).length, f) || []), widths = all.map((f) => f.width);
  const forces = all.map((f) => f.force), words = (what) => `${what} from open to closed: `;
  return element('div', { class: 'two' },
    strokeChart(`${words('Jaw force')}${short(c.force_min)} to ${short(c.force_max)} ${unit(c)}`, widths, forces, Math.max(...forces)),
    strokeChart(`${words('Transmission angle')}minimum ${short(c.transmission)}°, 90° at the top`, widths, all.map((f) => f.angle), 90));
}

/** The drawing of what is chosen, with how far it is open. */
function sight(c) {
  const figure = element('div'), frames = framesOf(c);
  let idea = null, frame;
  const draw = () => {
    const title = `${titleOf(c)}${idea ? ', idea ' + idea.place : ''}`;
    const picture = gripper(c, title, idea ? changesOf(idea) : [], frame);
    const old = figure.querySelector('svg');
    if (old) old.replaceWith(picture); else figure.prepend(picture);
  };
  draw();
  if (frames.length > 1) {
    const drawn = frames.findIndex((f) => f.pins === c.drawing.pins);
    const range = element('input', { type: 'range', min: 0, max: frames.length - 1, value: drawn, 'aria-label': 'From open to closed' });
    range.addEventListener('input', () => {
      frame = Number(range.value) === drawn ? undefined : frames[range.value];
      draw();
    });
    figure.append(element('label', { class: 'stroke' }, 'open', range, 'closed'), strokeCharts(c, frames));
  }
  return { figure, show: (chosen) => { idea = chosen; draw(); } };
}

/** The cheapest ideas, of which one is drawn when it is picked. */
function ideaTable(c, pick) {
  const number = { class: 'n' };
  const head = [['', {}], ['cost', number], ['variants', number], ['changes', {}]].map(([name, look]) => element('th', look, name));
  const rows = c.ideas.map((idea) => {
    const row = element('tr', { tabindex: 0 }, element('td', {}, idea.place), element('td', number, short(idea.cost)),
      element('td', number, least(c) + grouped(idea.variants)), element('td', {}, ...unbroken(changesInWords(changesOf(idea)))));
    const chosen = () => {
      for (const other of rows) other.setAttribute('aria-selected', other === row);
      pick(idea);
    };
    row.addEventListener('click', chosen);
    row.addEventListener('keydown', (e) => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); chosen(); } });
    return row;
  });
  return element('div', { class: 'wide ideas' }, element('table', {}, element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...rows)));
}

/** The dialog about a gripper. */
function tell(c) {
  const dialog = byId('chosen');
  const help = (words) => element('p', { class: 'help' }, words);
  const keep = keeping(c, () => { tell(c); dialog.querySelector('button').focus(); });
  const { figure, show } = sight(c);
  if (kept && kept !== c) figure.append(help(`Compared with ${titleOf(kept)}:`), gripper(kept, titleOf(kept)));
  dialog.replaceChildren(
    element('header', {}, element('h2', { id: 'chosen-name' }, titleOf(c)), element('div', {}, keep, ' ', button('Close', () => dialog.close()))),
    element('div', { class: 'two' }, figure, figureTable(c)));
  const commands = element('pre');
  const command = (idea) => {
    const k = idea ? ` --idea ${idea.place}` : '';
    commands.textContent = `ozols catalog export ${data.file} ${c.id}${k} -o gripper.toml\nozols studio gripper.toml\nozols report gripper.toml -o gripper.html`;
  };
  command(null);
  if (c.ideas.length) {
    const types = [...new Set(c.ideas.flatMap(changesOf).map(([, to]) => to))].filter((to) => packed.hardware[to]);
    dialog.append(
      element('h3', {}, 'Redesigns without redundant constraints, symmetric ones first'),
      help('Each represents all variants that distribute the same freedoms among joints in series; choose one to see the redesign.'),
      ideaTable(c, (idea) => { show(idea); command(idea); }),
      help(`Hardware: ${types.map((to) => `${to}: ${packed.hardware[to]}`).join('; ')}.`),
    );
  }
  dialog.append(element('h3', {}, 'Go on'), commands);
  if (c.drawing) dialog.append(savedFiles(c, figure));
}

async function choose(c, from) {
  const dialog = byId('chosen');
  rest();
  await complete(c);
  tell(c);
  dialog.addEventListener('close', () => from.focus(), { once: true });
  dialog.showModal();
}
