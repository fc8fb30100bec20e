// The choice of a start: an empty sheet, a four-bar, a gripper, and all built-in mechanisms as pictures.

function card({ name, what }) {
  const picture = element("img", { src: `picture/${encodeURIComponent(name)}.svg`, alt: "", loading: "lazy", width: 150, height: 110 });
  const made = element("button", { type: "button", class: "card" }, picture, element("b", {}, name), element("small", {}, what ?? ""));
  return acted(made, () => beginWith({ name }));
}

/** Begins another file; Undo goes back to this one. */
async function beginWith(what) {
  byId("shelf").close();
  takeScene.seen = false;
  if (await inTurn("begin", what)) select([]);
}

/** Opens a mechanism file of this computer as a copy, which is saved in the folder of the studio. */
function fileField() {
  const input = element("input", { type: "file", accept: ".toml", class: "unseen", "aria-label": "Open a file" });
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (!file) return;
    await beginWith({ name: file.name.replace(/\.toml$/i, "").replace(/[^\w -]/g, "-"), text: await file.text() });
    input.value = "";
  });
  return element("label", { class: "file-button" }, "Open a file", input);
}

async function openShelf() {
  const dialog = byId("shelf");
  if (!dialog.childElementCount) {
    const families = await (await fetch("shelf")).json();
    const find = element("input", { type: "search", placeholder: "Find", "aria-label": "Find a mechanism", autocomplete: "off" });
    const rooms = families.map(({ family, all }) => element("section", {}, element("h3", {}, family), element("div", { class: "cards" }, ...all.map(card))));
    find.addEventListener("input", () => {
      for (const room of rooms) {
        for (const one of room.querySelectorAll(".card")) one.hidden = !one.textContent.toLowerCase().includes(find.value.toLowerCase());
        room.hidden = !room.querySelector(".card:not([hidden])");
      }
    });
    const close = button("Close", () => dialog.close());
    dialog.append(element("div", { class: "dialog-head" }, element("h2", { id: "shelf-head" }, "Start from"), fileField(), button("Tutorial", startLesson, "Draws a four-bar with you"), find, close), ...rooms);
  }
  dialog.showModal();
}
