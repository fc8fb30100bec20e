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
  const rows = c.drawn ? [['Mechanism', c.name], ['', c.description], ['Form', `${c.links} links, ${c.joints} joints, ${formOf(c)}`]] : [
    ['Structure', `${c.id}: ${c.name}`],
    ...(c.classics ? [[c.jaw_c_motion ? 'With two jaws known as' : 'Known as', c.classics]] : []),
    ['Form', `${c.links} links, ${formOf(c)}; ${c.jaws_at_frame} jaws at the frame${c.truss ? '; a truss with the part' : ''}${c.drawing && c.drawing.folded ? '; of three sides two are drawn, opposite each other' : ''}`],
    ['Jaws', `${jawsOf(c)}; they turn by at most ${short(c.jaw_turn)}°`],
    ['Opening', `${short(c.opening_min)} to ${short(c.opening_max)} mm for ${short(c.travel)} ${drive} of the drive${ends.length ? ' (' + ends.join(', ') + ')' : ''}`],
    ['Force of a jaw', `${short(c.force_min)} ${unit(c)} at least, ${short(c.force_max)} at most over the stroke, without friction`],
    ['Transmission', `worst angle ${short(c.transmission)}°, links 1 : ${short(c.link_ratio)}, ${c.crossings} crossings`],
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
    ['Without redundant', `${least(c)}${grouped(c.determinate)} assignments, ${grouped(c.determinate_w1)} of them ${c.drawn ? 'that move as it does now' : 'with W = 1'}`],
  ]);
}

let kept = null;

/** Figures of a gripper, beside those of the one that is kept. */
function figureTable(c) {
  const own = figuresOf(c);
  if (!kept || kept === c) {
    const list = document.createElement('dl');
    for (const [name, value] of own) list.append(text('dt', name), text('dd', value));
    return list;
  }
  const other = new Map(figuresOf(kept)), mine = new Map(own), names = [...new Set([...mine.keys(), ...other.keys()])];
  const table = document.createElement('table'), head = table.createTHead().insertRow(), body = table.createTBody();
  head.append(text('th', ''), text('th', titleOf(c), { scope: 'col' }), text('th', titleOf(kept), { scope: 'col' }));
  for (const name of names) {
    const row = body.insertRow();
    row.append(text('th', name, { scope: 'row' }), text('td', mine.get(name) || '–'), text('td', other.get(name) || '–'));
  }
  const room = document.createElement('div');
  room.classList.add('wide', 'beside');
  room.append(table);
  return room;
}

/** Keeps a gripper beside those that are chosen next, or lets it go. */
function keeping(c, anew) {
  const button = text('button', kept === c ? 'Let it go' : 'Keep to compare', { type: 'button' });
  button.addEventListener('click', () => {
    kept = kept === c ? null : c;
    anew();
  });
  return button;
}

/** The force of a jaw over the stroke, from open to closed: work in is work out, so that it is the drive's travel by the opening's. */
function forceChart(c, frames) {
  const widths = frames.map((f) => opening(c.drawing, f.tips) / c.drawing.scale), jaws = c.jaw_c_motion ? 3 : 2;
  const step = ((c.drawing.slides ? 1 : 1000) * c.travel) / STEPS;
  const forces = widths.slice(1).map((w, i) => (2 * step) / jaws / Math.abs(w - widths[i])), most = Math.max(...forces);
  const at = (f, i) => [8 + (204 * i) / (forces.length - 1), 52 - (44 * f) / most];
  const words = `Jaw force from open to closed: ${short(c.force_min)} to ${short(c.force_max)} ${unit(c)}`;
  const lines = [element('path', { class: 'guide', d: path([[8, 52], [212, 52]]) }), element('path', { class: 'drive', d: path(forces.map(at)) })];
  const chart = element('svg', { class: 'gripper chart', viewBox: '0 0 220 60', role: 'img' }, [element('title', {}, [words]), ...lines]);
  const figure = document.createElement('figure');
  figure.append(chart, text('figcaption', words, { class: 'help' }));
  return figure;
}

/** The drawing of what is chosen, with how far it is open. */
function sight(c) {
  const figure = document.createElement('div'), frames = framesOf(c);
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
    const range = text('input', '', { type: 'range', min: 0, max: frames.length - 1, value: drawn, 'aria-label': 'From open to closed' });
    range.addEventListener('input', () => {
      frame = Number(range.value) === drawn ? undefined : frames[range.value];
      draw();
    });
    const label = document.createElement('label');
    label.className = 'stroke';
    label.append('open', range, 'closed');
    figure.append(label, forceChart(c, frames));
  }
  return { figure, show: (chosen) => { idea = chosen; draw(); } };
}

/** The cheapest ideas, of which one is drawn when it is picked. */
function ideaTable(c, pick) {
  const table = document.createElement('table'), body = document.createElement('tbody');
  const top = table.createTHead().insertRow();
  for (const name of ['', 'cost', 'variants', 'changes']) top.append(text('th', name, name && name !== 'changes' ? { class: 'n' } : {}));
  for (const idea of c.ideas) {
    const row = body.insertRow();
    row.tabIndex = 0;
    row.append(text('td', idea.place), text('td', short(idea.cost), { class: 'n' }), text('td', least(c) + grouped(idea.variants), { class: 'n' }), text('td', idea.changes));
    const chosen = () => {
      for (const other of body.rows) other.setAttribute('aria-selected', other === row);
      pick(idea);
    };
    row.addEventListener('click', chosen);
    row.addEventListener('keydown', (e) => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); chosen(); } });
  }
  table.append(body);
  const room = document.createElement('div');
  room.className = 'wide ideas';
  room.append(table);
  return room;
}

/** What the dialog says of a gripper. */
function tell(c) {
  const dialog = by('chosen'), head = document.createElement('header');
  const close = text('button', 'Close', { type: 'button' });
  close.addEventListener('click', () => dialog.close());
  const buttons = document.createElement('div');
  buttons.append(keeping(c, () => { tell(c); dialog.querySelector('button').focus(); }), ' ', close);
  head.append(text('h2', titleOf(c), { id: 'chosen-name' }), buttons);
  const { figure, show } = sight(c), two = document.createElement('div');
  two.className = 'two';
  two.append(figure, figureTable(c));
  if (kept && kept !== c) figure.append(text('p', `Compared with ${titleOf(kept)}:`, { class: 'help' }), gripper(kept, titleOf(kept)));
  dialog.replaceChildren(head, two);
  const commands = text('pre', '');
  const command = (idea) => {
    const k = idea ? ` --idea ${idea.place}` : '';
    commands.textContent = `ozols catalog export ${data.file} ${c.id}${k} -o gripper.toml\nozols studio gripper.toml\nozols report gripper.toml -o gripper.html`;
  };
  command(null);
  if (c.ideas.length) {
    dialog.append(
      text('h3', 'Redesigns without redundant constraints, symmetric ones first'),
      text('p', 'Each represents all variants that distribute the same freedoms among joints in series; choose one to see the redesign.', { class: 'help' }),
      ideaTable(c, (idea) => { show(idea); command(idea); }),
    );
    const types = [...new Set(c.ideas.flatMap(changesOf).map(([, to]) => to))].filter((to) => packed.hardware[to]);
    dialog.append(text('p', `Hardware: ${types.map((to) => `${to}: ${packed.hardware[to]}`).join('; ')}.`, { class: 'help' }));
  }
  dialog.append(text('h3', 'Go on'), commands);
  if (c.drawing) dialog.append(savedFiles(c, figure));
}

async function choose(c, from) {
  const dialog = by('chosen');
  rest();
  await complete(c);
  tell(c);
  dialog.addEventListener('close', () => from.focus(), { once: true });
  dialog.showModal();
}
