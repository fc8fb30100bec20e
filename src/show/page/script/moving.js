// A card moves under the pointer, or while it has the focus.
const PERIOD = 2600;
const still = matchMedia('(prefers-reduced-motion: reduce)');
let moved = null;

function rest() {
  if (!moved) return;
  cancelAnimationFrame(moved.request);
  moved.button.querySelector('svg').replaceWith(moved.picture);
  moved = null;
}

function move(button, card) {
  if (still.matches || (moved && moved.button === button)) return;
  rest();
  const frames = framesOf(card), picture = button.querySelector('svg');
  if (frames.length < 2 || !picture) return;
  const mine = { button, picture, request: 0 };
  moved = mine;
  let began = null, last = -1;
  const next = (now) => {
    if (moved !== mine) return;
    if (began === null) began = now;
    // There and back, slower at the ends.
    const share = (1 - Math.cos((2 * Math.PI * (now - began)) / PERIOD)) / 2;
    const at = Math.round(share * (frames.length - 1));
    if (at !== last) {
      last = at;
      button.querySelector('svg').replaceWith(gripper(card, picture.querySelector('title').textContent, null, frames[at]));
    }
    mine.request = requestAnimationFrame(next);
  };
  mine.request = requestAnimationFrame(next);
}

function movesWhenMet(button, card) {
  for (const event of ['pointerenter', 'focus']) button.addEventListener(event, () => move(button, card));
  for (const event of ['pointerleave', 'blur']) button.addEventListener(event, rest);
}
