// Coordinates as the file writes them: numbers, or exact expressions, which stay exact when they are moved or mirrored.

/** A coordinate as a person reads it. */
const shown = (c) => String(c);

/** A number that is as short as a step of the grid allows. */
function rounded(x, step) {
  const places = Math.max(0, Math.min(9, Math.ceil(-Math.log10(step) - 1e-9)));
  const out = Number((Math.round(x / step) * step).toFixed(places));
  return Object.is(out, -0) ? 0 : out;
}

/** The number that a text is, or null. */
const numeral = (text) => (/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text.trim()) ? Number(text) : null);

/** The text as the file has it: a number if it is one. */
function typed(text) {
  const plain = text.trim();
  return numeral(plain) === null ? plain : plain.replace(/^\+/, "").replace(/^(-?)\./, "$10.").replace(/\.$/, "").replace(/\.e/i, "e");
}

/** Whether an expression is one term, which a sign may stand before. */
function isTerm(text) {
  let depth = 0;
  for (const [n, c] of [...text].entries()) {
    if (c === "(") depth += 1;
    if (c === ")") depth -= 1;
    if (n > 0 && depth === 0 && (c === "+" || c === "-") && !/[eE*/^]/.test(text[n - 1])) return false;
  }
  return true;
}

/** The opposite of a coordinate, exactly. */
function negated(c) {
  const n = typeof c === "number" ? c : numeral(c);
  if (n !== null) return n === 0 ? 0 : typeof c === "number" ? -c : c.trim().startsWith("-") ? c.trim().slice(1) : `-${c.trim().replace(/^\+/, "")}`;
  const text = c.trim();
  const inner = /^-\((.*)\)$/.exec(text);
  if (inner && isTerm(`(${inner[1]})`) && balanced(inner[1])) return inner[1];
  if (!isTerm(text)) return `-(${text})`;
  return text.startsWith("-") ? text.slice(1) : `-${text}`;
}

/** Whether no bracket is closed before it is opened. */
function balanced(text) {
  let depth = 0;
  for (const c of text) {
    depth += c === "(" ? 1 : c === ")" ? -1 : 0;
    if (depth < 0) return false;
  }
  return depth === 0;
}

/** A coordinate moved by a number. */
function moved1(c, by) {
  if (by === 0) return c;
  const n = typeof c === "number" ? c : numeral(c);
  if (n !== null) return Number((n + by).toPrecision(12));
  return `${c} ${by < 0 ? "-" : "+"} ${Math.abs(by)}`;
}

/** Whether two coordinates are written alike. */
const alike = (a, b) => String(a) === String(b);
