// Files of a gripper, saved from the page alone.

/** A link that saves a text under a name. */
function saving(name, type, content) {
  const link = text('a', name, { download: name, href: '#' });
  link.addEventListener('click', () => {
    const url = URL.createObjectURL(new Blob([content()], { type }));
    link.href = url;
    setTimeout(() => URL.revokeObjectURL(url), 10000);
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

/** Links to the mechanism's file and to its drawing as it stands. */
function savedFiles(c, figure) {
  const row = document.createElement('p');
  row.className = 'saved';
  row.append('Save ');
  if (c.mechanism) row.append(saving(`${c.id}.toml`, 'application/toml', () => c.mechanism), ', the mechanism file; ');
  if (c.mjcf) row.append(saving(`${c.id}.xml`, 'application/xml', () => c.mjcf), ', the same for MuJoCo; ');
  row.append(saving(`${c.id}.svg`, 'image/svg+xml', () => alone(figure.querySelector('svg'))), ', the drawing.');
  return row;
}
