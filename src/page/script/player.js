// The player of a mechanism in space: its motions picture by picture, its self-stresses, and the view turned by mouse, finger
// and arrow keys.

const RATE = 30;
/** A turn by a key, and by a pixel of a drag. */
const [KEY, PIXEL] = [Math.PI / 18, 0.01];

function player(figure, scene) {
  const [turn, play, slider, again, loop, shown, home, say] = ["turn", "play", "range", "again", "loop", "shown", "home", "say"].map((part) =>
    figure.querySelector(`[data-part="${part}"]`));
  const layer = figure.querySelector("[data-scene]");
  let [now, forward, running, motion, stress] = [0, true, null, 0, null];
  let [side, tilt] = [0, 0];
  let sight = null;
  const what = figure.querySelector("text.sub");
  const seenFirst = what.textContent;
  const poses = () => scene.moves[motion].poses;

  const draw = () => {
    const loads = stress === null ? [] : scene.stresses[stress].arrows;
    layer.replaceChildren(...pictureOf(scene, sight, stress === null ? poses()[now] : null, stress === null ? motion : null, loads));
    slider.value = now;
    figure.dataset.picture = now;
  };
  const tell = () => {
    const degrees = (x) => Math.round((x * 180) / Math.PI);
    const view = sight.away ? `; turned by ${degrees(side)}° to the side and ${degrees(tilt)}° up` : "";
    say.textContent = `${(stress === null ? scene.moves[motion] : scene.stresses[stress]).name}${view}`;
  };
  /** Looks from where the view has been turned to. */
  const look = () => {
    const away = side !== 0 || tilt !== 0;
    const view = away ? seenFrom(scene, side, tilt) : scene.view;
    const fit = away ? fitted(scene, view, stress === null ? poses() : [null]) : { scale: 1, at: scene.origin };
    sight = { view, fit, away };
    for (const part of figure.querySelectorAll("[data-home]")) part.setAttribute("visibility", away ? "hidden" : "visible");
    what.textContent = away ? "Kinematic scheme, turned" : seenFirst;
    home.disabled = !away;
    draw();
    tell();
  };
  const turnBy = (across, up) => {
    const height = Math.asin(Math.max(-1, Math.min(1, dot(scene.view[2], scene.upright))));
    side = (side + across) % (2 * Math.PI);
    tilt = Math.max(-Math.PI / 2 - height, Math.min(Math.PI / 2 - height, tilt + up));
    look();
  };
  const goHome = () => {
    [side, tilt] = [0, 0];
    look();
  };

  const stop = () => {
    cancelAnimationFrame(running);
    running = null;
    play.textContent = "Play";
  };
  /** The next picture: round again, or back from the end; none at the end where it is not to be repeated. */
  const next = () => {
    const round = scene.moves[motion].closed;
    const last = forward ? poses().length - 1 : 0;
    if (now !== last) return now + (forward ? 1 : -1);
    if (!loop.checked && (round || !forward)) return null;
    if (round) return 0;
    forward = !forward;
    return now + (forward ? 1 : -1);
  };
  const start = () => {
    const round = scene.moves[motion].closed;
    play.textContent = "Stop";
    if (!loop.checked && round && now === poses().length - 1) now = 0;
    if (!loop.checked && !round && now === 0) forward = true;
    let due = null;
    const tick = (time) => {
      if (due === null) due = time;
      while (time >= due) {
        const to = next();
        if (to === null) return stop();
        now = to;
        due += 1000 / RATE;
      }
      draw();
      running = requestAnimationFrame(tick);
    };
    running = requestAnimationFrame(tick);
  };
  /** Another motion, or a self-stress. */
  const show = (which) => {
    const moves = scene.moves.length;
    stop();
    [motion, stress] = which < moves ? [which, null] : [0, which - moves];
    [now, forward] = [scene.moves[motion].start, true];
    slider.max = poses().length - 1;
    for (const part of [play, slider, again]) part.hidden = stress !== null || poses().length < 2;
    look();
  };

  [...scene.moves, ...scene.stresses].forEach((s, n) => shown.append(element("option", { value: n }, s.name)));
  shown.addEventListener("change", () => show(Number(shown.value)));
  slider.addEventListener("input", () => {
    stop();
    now = Number(slider.value);
    draw();
  });
  play.addEventListener("click", () => (running === null ? start() : stop()));
  home.addEventListener("click", () => {
    goHome();
    turn.focus();
  });
  const keys = { ArrowLeft: [-KEY, 0], ArrowRight: [KEY, 0], ArrowUp: [0, KEY], ArrowDown: [0, -KEY] };
  turn.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (event.key === "Home") goHome();
    else if (event.key in keys) turnBy(...keys[event.key]);
    else return;
    event.preventDefault();
  });
  let from = null;
  turn.addEventListener("pointerdown", (event) => {
    from = [event.clientX, event.clientY];
    turn.setPointerCapture(event.pointerId);
  });
  turn.addEventListener("pointermove", (event) => {
    if (!from) return;
    turnBy((from[0] - event.clientX) * PIXEL, (event.clientY - from[1]) * PIXEL);
    from = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) turn.addEventListener(end, () => (from = null));

  show(0);
  // Readers who want less motion begin it themselves.
  const seen = new IntersectionObserver((entries) => {
    if (entries.some((e) => e.isIntersecting) && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      seen.disconnect();
      if (poses().length > 1 && stress === null) start();
    }
  }, { threshold: 0.4 });
  seen.observe(figure);
}

for (const figure of document.querySelectorAll("[data-space]")) player(figure, page.scenes[Number(figure.dataset.space)]);
