// A page that is written anew while its mechanism is drawn: it is read again while the reader is elsewhere, in an editor, and
// when the reader comes back. What is scrolled to stays; browsers see to that.

const AGAIN = 1500;

addEventListener("focus", () => location.reload());
setInterval(() => {
  if (document.visibilityState === "visible" && !document.hasFocus()) location.reload();
}, AGAIN);
