// Files of a gripper, saved from the page alone.

/** A link that saves a text under a name. */
function saving(name, type, content) {
  const link = element('a', { download: name, href: '#' }, name);
  link.addEventListener('click', (event) => {
    event.preventDefault();
    saveFile(name, new Blob([content()], { type }));
  });
  return link;
}

/** A drawing that needs no page: with the rules that style it, and their colours in place of their names. */
function alone(picture) {
  const own = picture.cloneNode(true), style = document.createElementNS(SVG, 'style');
  const colours = getComputedStyle(document.documentElement);
  const rules = [...document.styleSheets].flatMap((s) => [...s.cssRules]).filter((r) => r.selectorText && r.selectorText.startsWith('.gripper'));
  style.textContent = rules.map((r) => r.cssText.replace(/var\((--[\w-]+)\)/g, (_, name) => colours.getPropertyValue(name).trim())).join('\n');
  own.prepend(style);
  own.setAttribute('xmlns', SVG);
  return new XMLSerializer().serializeToString(own);
}

/** Links to the mechanism's file and to its present drawing. */
function savedFiles(c, figure) {
  const svg = () => alone(figure.querySelector('svg'));
  return element('p', { class: 'saved' }, 'Save ',
    ...(c.mechanism ? [saving(`${c.id}.toml`, 'application/toml', () => c.mechanism), ', the mechanism file; '] : []),
    ...(c.mjcf ? [saving(`${c.id}.xml`, 'application/xml', () => c.mjcf), ', the same for MuJoCo; '] : []),
    saving(`${c.id}.svg`, 'image/svg+xml', svg), ', the drawing.');
}
