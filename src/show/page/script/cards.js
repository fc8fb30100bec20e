// The cards: filtered, sorted, a page of them at a time.
const packed = JSON.parse(document.getElementById('data').textContent);
const data = { file: packed.file, cards: [] };
const STEP = 60;
const BIGGEST_FIRST = ['force_min', 'transmission', 'determinate_w1'];

function short(x) {
  return x === null || x === undefined ? '–' : String(+Number(x).toPrecision(3));
}

/** Returns a list that the page has deflated, in base64. */
function unpacked(list) {
  const bytes = Uint8Array.from(atob(list), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).json();
}

/** Gives a card, and its neighbours in the list, their files and ideas. */
async function complete(c) {
  if (c.ideas) return;
  const first = c.place - (c.place % packed.together);
  const all = await unpacked(packed.chosen[first / packed.together]);
  all.forEach((chosen, i) => Object.assign(data.cards[first + i], chosen));
}

const least = (c) => (c.certainty === 'exact' ? '' : 'at least ');
const motions = (c) => [c.jaw_a_motion, c.jaw_b_motion, c.jaw_c_motion].filter((m) => m);
const jawsOf = (c) => [...new Set(motions(c))].join(' and ');
const unit = (c) => (c.input === 'slide' ? 'N per N' : 'N per Nm');
const formOf = (c) => `${c.input === 'slide' ? 'sliding' : 'turning'} driver, ${c.symmetry}${c.parallel ? ', parallelograms' : ''}`;

const does = (c) => c.reached === 1 && !c.shortfall;

/** The scheme's name, the mechanism's, or links, driver and jaws. */
function titleOf(c) {
  const [scheme] = (c.classics || '').split(', ');
  const title = scheme ? scheme.replaceAll('-', ' ') : `${c.links} links, driver ${c.input}s, jaws ${jawsOf(c)}`;
  return (title + (c.jaw_c_motion ? ', three jaws' : '')).replace(/^./, (first) => first.toUpperCase());
}

function cardOf(c) {
  const task = does(c) ? 'Does the task' : c.shortfall;
  const button = element('button', { class: 'card', type: 'button', 'data-id': c.id },
    gripper(c, titleOf(c)),
    element('b', {}, titleOf(c)),
    element('span', { class: does(c) ? 'does' : 'lacks' }, task),
    element('span', {}, c.classics ? `${c.links} links, ${formOf(c)}` : `${c.symmetry} layout${c.parallel ? ', parallelograms' : ''}`),
    element('span', {}, `${c.classics ? `jaws ${jawsOf(c)}, ` : ''}${short(c.force_min)} ${unit(c)} at least, transmission angle from ${short(c.transmission)}°`),
    element('span', {}, `${least(c)}${grouped(c.determinate_w1)} redesign${c.determinate_w1 === '1' ? '' : 's'}, from cost ${short(c.best_cost)}`),
    element('span', {}, c.id));
  button.addEventListener('click', () => choose(c, button));
  movesWhenMet(button, c);
  return element('li', {}, button);
}

let shown = [], given = 0;

// The test of each filter for a card, given the filter's value.
const number = (keeps) => (c, v) => keeps(c, Number(v));
const FILTERS = {
  links: (c, v) => String(c.links) === v,
  input: (c, v) => c.input === v,
  symmetry: (c, v) => c.symmetry === v,
  sides: (c, v) => (c.jaw_c_motion ? '3' : '2') === v,
  jaws: (c, v) => motions(c).every((m) => m === v),
  price: number((c, v) => c.price > 0 && c.price <= v),
  pin: number((c, v) => c.pin_force > 0 && c.pin_force <= v),
  efficiency: number((c, v) => c.efficiency >= v),
  stroke: number((c, v) => c.opening_max - c.opening_min >= v),
  travel: number((c, v) => c.travel > 0 && c.travel <= v),
  actuator: number((c, v) => c.actuator > 0 && c.actuator <= v),
  width: number((c, v) => c.width > 0 && c.width <= v),
  height: number((c, v) => c.height > 0 && c.height <= v),
  cost: number((c, v) => c.best_cost !== null && c.best_cost <= v),
  transmission: number((c, v) => c.transmission >= v),
  force: number((c, v) => c.force_min >= v),
  ratio: number((c, v) => c.force_max <= v * c.force_min),
  turn: number((c, v) => c.jaw_turn <= v),
  planes: number((c, v) => c.planes > 0 && c.planes <= v),
  does,
  front: (c) => c.front === 1,
  find: (c, v) => c.name.toLowerCase().includes(v) || c.id.includes(v) || (c.classics || '').includes(v),
};

/** The filters in use, read once for all cards: each with its id and its test. */
function wanted() {
  return Object.entries(FILTERS).flatMap(([id, keeps]) => {
    const input = byId(id), value = input.type === 'checkbox' ? (input.checked ? 'on' : '') : input.value.trim().toLowerCase();
    return value === '' ? [] : [[id, (c) => keeps(c, value)]];
  });
}

/** The filters that exclude everything: the number of grippers without each. */
function inTheWay(asked) {
  const words = (id) => byId(id).closest('label').firstChild.textContent.trim() || byId(id).closest('label').textContent.trim();
  const without = asked.flatMap(([id]) => {
    const n = data.cards.filter((c) => asked.every(([other, keeps]) => other === id || keeps(c))).length;
    return n ? [`without “${words(id)}” ${grouped(n)}`] : [];
  });
  const out = without.length ? [without.join(', ')] : ['Two or more filters exclude every gripper'];
  if (byId('jaws').value === 'parallel' && !data.cards.some((c) => FILTERS.jaws(c, 'parallel'))) {
    out.push('with only hinges, jaws that do not turn need ten links; with slides, four do (ozols catalog build --pairs slide,gear,slot)');
  }
  return out.join('; ');
}

function more() {
  const next = shown.slice(given, given + STEP);
  byId('cards').append(...next.map(cardOf));
  given += next.length;
  byId('more').hidden = given >= shown.length;
}

function show() {
  const asked = wanted();
  shown = data.cards.filter((c) => asked.every(([, keeps]) => keeps(c)));
  const key = byId('sort').value;
  if (key) {
    const sign = BIGGEST_FIRST.includes(key) ? -1 : 1;
    const value = (c) => (c[key] === null || c[key] === undefined ? Infinity : sign * Number(c[key]));
    // Forces for 1 N and for 1 Nm do not compare: sliding drives come first.
    const kind = (c) => (key === 'force_min' && c.input !== 'slide' ? 1 : 0);
    shown.sort((a, b) => kind(a) - kind(b) || value(a) - value(b));
  }
  rest();
  byId('cards').replaceChildren();
  given = 0;
  more();
  const n = data.cards.length;
  byId('count').textContent = shown.length === n ? `All ${grouped(n)} grippers.`
    : shown.length ? `${grouped(shown.length)} of ${grouped(n)} grippers.`
    : `None of ${grouped(n)} grippers matches: ${inTheWay(asked)}.`;
}

unpacked(packed.cards).then((cards) => {
  cards.forEach((c, place) => Object.assign(c, { place }));
  data.cards = cards;
  for (const n of [...new Set(cards.map((c) => c.links))].sort((a, b) => a - b)) byId('links').append(element('option', { value: n }, n));
  show();
});
let pending = 0;
byId('filters').addEventListener('input', () => { clearTimeout(pending); pending = setTimeout(show, 120); });
byId('filters').addEventListener('reset', () => setTimeout(show));
byId('filters').addEventListener('submit', (e) => e.preventDefault());
byId('more').querySelector('button').addEventListener('click', more);
new IntersectionObserver((seen) => { if (seen.some((s) => s.isIntersecting) && given < shown.length) more(); }, { rootMargin: '600px' }).observe(byId('more'));
