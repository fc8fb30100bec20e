// The player of a motion: one picture of it is seen at a time.

const RATE = 30;

function player(figure) {
  const frames = [...figure.querySelectorAll("[data-frame]")];
  const round = figure.dataset.motion === "round";
  const [slider, play, loop, say] = ["range", "play", "loop", "say"].map((part) => figure.querySelector(`[data-part="${part}"]`));
  let now = frames.findIndex((f) => !f.hasAttribute("visibility"));
  let forward = true;
  let running = null;
  const show = (n) => {
    frames[now].setAttribute("visibility", "hidden");
    now = n;
    frames[now].removeAttribute("visibility");
    slider.value = now;
    say.textContent = `picture ${now + 1} of ${frames.length}`;
  };
  const stop = () => {
    cancelAnimationFrame(running);
    running = null;
    play.textContent = "Play";
  };
  /** The next picture: round again, or back from the end; none at the end where it is not to be repeated. */
  const next = () => {
    const last = forward ? frames.length - 1 : 0;
    if (now !== last) return now + (forward ? 1 : -1);
    if (!loop.checked && (round || !forward)) return null;
    if (round) return 0;
    forward = !forward;
    return now + (forward ? 1 : -1);
  };
  const start = () => {
    play.textContent = "Stop";
    if (!loop.checked && round && now === frames.length - 1) show(0);
    if (!loop.checked && !round && now === 0) forward = true;
    let due = null;
    const tick = (time) => {
      if (due === null) due = time;
      while (time >= due) {
        const to = next();
        if (to === null) return stop();
        show(to);
        due += 1000 / RATE;
      }
      running = requestAnimationFrame(tick);
    };
    running = requestAnimationFrame(tick);
  };
  slider.max = frames.length - 1;
  slider.addEventListener("input", () => {
    stop();
    show(Number(slider.value));
  });
  play.addEventListener("click", () => (running === null ? start() : stop()));
  show(now);
  // Readers who want less motion begin it themselves.
  const seen = new IntersectionObserver((entries) => {
    if (entries.some((e) => e.isIntersecting) && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      seen.disconnect();
      start();
    }
  }, { threshold: 0.4 });
  seen.observe(figure);
}

for (const figure of document.querySelectorAll("[data-motion]")) player(figure);
