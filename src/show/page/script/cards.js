// The cards: filtered, sorted, a page of them at a time.
const data = JSON.parse(document.getElementById('data').textContent);
const by = (id) => document.getElementById(id);
const STEP = 60;
const BIGGEST_FIRST = ['force_min', 'transmission', 'determinate_w1'];

function grouped(digits) {
  return String(digits).replace(/\B(?=(\d{3})+(?!\d))/g, ',');
}

function short(x) {
  return x === null || x === undefined ? '–' : String(+Number(x).toPrecision(3));
}

function text(name, content, attributes) {
  const e = document.createElement(name);
  e.textContent = content;
  for (const [key, value] of Object.entries(attributes || {})) e.setAttribute(key, value);
  return e;
}

const least = (c) => (c.certainty === 'exact' ? '' : 'at least ');
const motions = (c) => [c.jaw_a_motion, c.jaw_b_motion, c.jaw_c_motion].filter((m) => m);
const jawsOf = (c) => [...new Set(motions(c))].join(' and ');
const unit = (c) => (c.input === 'slide' ? 'N per N' : 'N per Nm');
const formOf = (c) => c.drawn ? `drawn (${c.mode}), ${c.contours} contours${c.input ? ', driver ' + c.input + 's' : ''}` : `${c.input === 'slide' ? 'sliding' : 'turning'} driver, ${c.symmetry}${c.parallel ? ', parallelograms' : ''}`;

function cardOf(c) {
  const item = document.createElement('li');
  const button = text('button', '', { class: 'card', type: 'button', 'data-id': c.id });
  button.append(
    gripper(c, `Gripper ${c.drawn ? c.name : c.id}`),
    text('b', c.drawn ? c.name : c.id),
    text('span', `${c.links} links, ${formOf(c)}`),
    text('span', c.drawn ? c.description : `${c.jaw_c_motion ? 'three jaws' : 'jaws'} ${jawsOf(c)}, ${short(c.force_min)} ${unit(c)} at least`),
    text('span', `W ${c.mobility}, σ ${c.redundant}; ${least(c)}${grouped(c.determinate_w1)} redesign${c.determinate_w1 === '1' ? '' : 's'}, from cost ${short(c.best_cost)}`),
  );
  button.addEventListener('click', () => choose(c, button));
  item.append(button);
  return item;
}

let shown = [], given = 0;

// What the filters ask for, read once for all cards.
function wanted() {
  const [links, input, symmetry, jaws] = ['links', 'input', 'symmetry', 'jaws'].map((id) => by(id).value);
  const [cost, transmission, force, ratio, turn] = ['cost', 'transmission', 'force', 'ratio', 'turn'].map((id) => (by(id).value === '' ? null : Number(by(id).value)));
  const front = by('front').checked, does = by('does').checked, find = by('find').value.trim().toLowerCase();
  return (c) =>
    (!links || String(c.links) === links) &&
    (!input || c.input === input) &&
    (!symmetry || (c.drawn ? 'drawn' : c.symmetry) === symmetry) &&
    (!jaws || (!c.drawn && motions(c).every((m) => m === jaws))) &&
    (cost === null || (c.best_cost !== null && c.best_cost <= cost)) &&
    (transmission === null || c.transmission >= transmission) &&
    (force === null || c.force_min >= force) &&
    (ratio === null || (!c.drawn && c.force_max <= ratio * c.force_min)) &&
    (turn === null || (!c.drawn && c.jaw_turn <= turn)) &&
    (!does || (c.reached === 1 && !c.shortfall)) &&
    (!front || c.front === 1) &&
    (!find || c.name.toLowerCase().includes(find) || c.id.includes(find));
}

function more() {
  const next = shown.slice(given, given + STEP);
  by('cards').append(...next.map(cardOf));
  given += next.length;
  by('more').hidden = given >= shown.length;
}

function show() {
  shown = data.cards.filter(wanted());
  const key = by('sort').value;
  if (key) {
    const sign = BIGGEST_FIRST.includes(key) ? -1 : 1;
    const value = (c) => (c[key] === null || c[key] === undefined ? Infinity : sign * Number(c[key]));
    shown.sort((a, b) => value(a) - value(b));
  }
  by('cards').replaceChildren();
  given = 0;
  more();
  const n = data.cards.length;
  by('count').textContent = shown.length === n ? `All ${grouped(n)} grippers.`
    : shown.length ? `${grouped(shown.length)} of ${grouped(n)} grippers.`
    : `None of ${grouped(n)} grippers is like that: take a filter away.`;
}

for (const n of [...new Set(data.cards.map((c) => c.links))]) by('links').append(text('option', n, { value: n }));
let pending = 0;
by('filters').addEventListener('input', () => { clearTimeout(pending); pending = setTimeout(show, 120); });
by('filters').addEventListener('reset', () => setTimeout(show));
by('filters').addEventListener('submit', (e) => e.preventDefault());
by('more').querySelector('button').addEventListener('click', more);
new IntersectionObserver((seen) => { if (seen.some((s) => s.isIntersecting) && given < shown.length) more(); }, { rootMargin: '600px' }).observe(by('more'));
