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
    ['Structure', c.name],
    ['Form', `${c.links} links, ${formOf(c)}; ${c.jaws_at_frame} jaws at the frame${c.truss ? '; a truss with the part' : ''}`],
    ['Jaws', `${jawsOf(c)}; they turn by ${short(c.jaw_turn)}° at most`],
    ['Opening', `${short(c.opening_min)} to ${short(c.opening_max)} mm for ${short(c.travel)} ${drive} of the drive${ends.length ? ' (' + ends.join(', ') + ')' : ''}`],
    ['Force of a jaw', `${short(c.force_min)} ${unit(c)} at least, ${short(c.force_max)} at most over the stroke, without friction`],
    ['Transmission', `worst angle ${short(c.transmission)}°, links 1 : ${short(c.link_ratio)}, ${c.crossings} crossings`],
    ...(c.pin_force ? [
      ['Task', c.shortfall || 'does all of it'],
      ['Joints', `${short(c.pin_force)} N at most for 1 N of each jaw; efficiency from ${short(c.efficiency)}`],
      ['Room', `${short(c.width)} by ${short(c.height)} mm over the stroke`],
    ] : []),
  ];
  return rows.concat([
    ['As built', `W = ${c.mobility}, σ = ${c.redundant}; finite mobility ${c.finite}`],
    ['Without redundant', `${least(c)}${grouped(c.determinate)} assignments, ${grouped(c.determinate_w1)} of them ${c.drawn ? 'that move as it does now' : 'with W = 1'}`],
  ]);
}

function choose(c, from) {
  const dialog = by('chosen');
  const head = document.createElement('header');
  const close = text('button', 'Close', { type: 'button' });
  close.addEventListener('click', () => dialog.close());
  head.append(text('h2', c.id, { id: 'chosen-name' }), close);
  const figure = document.createElement('div');
  const draw = (idea) => figure.replaceChildren(gripper(c, `Gripper ${c.id}${idea ? ', idea ' + idea.place : ''}`, idea ? changesOf(idea) : []));
  draw(null);
  const list = document.createElement('dl');
  for (const [name, value] of figuresOf(c)) list.append(text('dt', name), text('dd', value));
  const two = document.createElement('div');
  two.className = 'two';
  two.append(figure, list);
  dialog.replaceChildren(head, two);
  const commands = text('pre', '');
  const tell = (idea) => {
    const k = idea ? ` --idea ${idea.place}` : '';
    commands.textContent = `ozols catalog export ${data.file} ${c.id}${k} -o gripper.toml\nozols report gripper.toml -o gripper.html`;
  };
  if (c.ideas.length) {
    const table = document.createElement('table'), body = document.createElement('tbody');
    const top = table.createTHead().insertRow();
    for (const name of ['', 'cost', 'variants', 'adds']) top.append(text('th', name, name && name !== 'adds' ? { class: 'n' } : {}));
    for (const idea of c.ideas) {
      const row = body.insertRow();
      row.tabIndex = 0;
      row.append(text('td', idea.place), text('td', short(idea.cost), { class: 'n' }), text('td', least(c) + grouped(idea.variants), { class: 'n' }), text('td', idea.adds));
      const pick = () => {
        for (const other of body.rows) other.setAttribute('aria-selected', other === row);
        draw(idea);
        tell(idea);
      };
      row.addEventListener('click', pick);
      row.addEventListener('keydown', (e) => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); pick(); } });
    }
    table.append(body);
    const room = document.createElement('div');
    room.className = 'wide';
    room.append(table);
    dialog.append(text('h3', 'The cheapest ideas'), text('p', 'Each stands for as many variants as share out the same freedoms among joints in series; choose one to see it carried out.', { class: 'help' }), room);
  }
  tell(null);
  dialog.append(text('h3', 'Go on'), commands);
  dialog.addEventListener('close', () => from.focus(), { once: true });
  dialog.showModal();
}

show();
