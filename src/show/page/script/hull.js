// The corners of the convex hull of points, in order (Andrew's monotone chain).
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const side = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && side(out[out.length - 2], out[out.length - 1], p) <= 0) out.pop();
      out.push(p);
    }
    out.pop();
    return out;
  };
  return half(sorted).concat(half(sorted.reverse()));
}

/** The solution of a square system, the right side in the last column, by Gauss, who passes over zeros; null where it is singular. */
function solved(rows) {
  const n = rows.length;
  for (let k = 0; k < n; k += 1) {
    let best = k;
    for (let i = k + 1; i < n; i += 1) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    if (Math.abs(rows[best][k]) < 1e-9) return null;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = k + 1; i < n; i += 1) {
      const f = rows[i][k] / rows[k][k];
      if (f) for (let j = k; j <= n; j += 1) rows[i][j] -= f * rows[k][j];
    }
  }
  const out = new Array(n).fill(0);
  for (let k = n - 1; k >= 0; k -= 1) {
    out[k] = rows[k][n];
    for (let j = k + 1; j < n; j += 1) out[k] -= rows[k][j] * out[j];
    out[k] /= rows[k][k];
  }
  return out;
}
