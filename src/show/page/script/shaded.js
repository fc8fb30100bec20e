// Bodies on a canvas, shaded, by the browser's own WebGL: parallel light and parallel projection.

/** Pixels of a picture for each of the drawing's, at least. */
const FINE = 2;
const VERTEX = `attribute vec3 place, normal, colour;
uniform mat4 link;
uniform mat3 view;
uniform vec4 fit;
varying vec3 shade, up;
const float DEEP = 4000.0;
void main() {
  vec3 seen = view * ((link * vec4(place, 1.0)).xyz);
  up = view * (mat3(link[0].xyz, link[1].xyz, link[2].xyz) * normal);
  shade = colour;
  gl_Position = vec4(seen.xy * fit.xy + fit.zw, -seen.z / DEEP, 1.0);
}`;
const FRAGMENT = `precision mediump float;
varying vec3 shade, up;
void main() {
  vec3 n = normalize(up);
  if (n.z < 0.0) n = -n;
  float light = max(dot(n, normalize(vec3(-0.45, 0.65, 0.75))), 0.0);
  float sheen = pow(max(dot(reflect(vec3(0.0, 0.0, -1.0), n), normalize(vec3(-0.45, 0.65, 0.75))), 0.0), 24.0);
  gl_FragColor = vec4(shade * (0.42 + 0.18 * n.y + 0.52 * light) + 0.16 * sheen, 1.0);
}`;

/** Whether this browser can shade bodies. */
const canShade = (() => {
  let can = null;
  return () => (can ??= document.createElement("canvas").getContext("webgl") !== null);
})();

function programOf(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  return program;
}

/** The matrix of a link's pose, by columns. */
function matrixOf(pose, link) {
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((e) => [...turned(pose, link, e), 0]);
  return [...columns.flat(), ...carried(pose, link, [0, 0, 0]), 1];
}

/** A canvas that shows bodies; one for each pane, for browsers have few of them. */
function shadedCanvas() {
  const canvas = element("canvas", { class: "bodies" });
  const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  const program = programOf(gl);
  const at = (name) => gl.getUniformLocation(program, name);
  const uniforms = { link: at("link"), view: at("view"), fit: at("fit") };
  gl.enable(gl.DEPTH_TEST);
  let links = [];
  let lines = [];
  const attribute = (name, offset) => {
    const place = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 36, offset);
  };
  const load = (numbers, how) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, how);
    return { buffer, count: numbers.length / 9 };
  };
  const put = ({ buffer, count }, mode) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    attribute("place", 0);
    attribute("normal", 12);
    attribute("colour", 24);
    gl.drawArrays(mode, 0, count);
  };
  /** Takes the triangles of each link. */
  const take = (meshes) => {
    links.forEach((l) => gl.deleteBuffer(l.buffer));
    links = meshes.map((numbers) => load(numbers, gl.STATIC_DRAW));
  };
  /** Shows them in a pose, and triangles that stand in space, in a room of left, top, width and height. */
  const show = ({ view, fit }, pose, room, standing) => {
    const fine = Math.max(FINE, devicePixelRatio);
    const [wide, high] = [canvas.clientWidth || room[2], canvas.clientHeight || room[3]].map((x) => Math.round(x * fine));
    if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
    gl.viewport(0, 0, wide, high);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    // the room is shown whole, in the middle of the canvas
    const scale = Math.min(wide / room[2], high / room[3]);
    const [sx, sy] = [(2 * scale) / wide, (2 * scale) / high];
    gl.uniform4f(uniforms.fit, sx * fit.scale, sy * fit.scale, sx * (fit.at[0] - room[0] - room[2] / 2), -sy * (fit.at[1] - room[1] - room[3] / 2));
    gl.uniformMatrix3fv(uniforms.view, false, [0, 1, 2].flatMap((n) => view.map((axis) => axis[n])));
    links.forEach((l, n) => {
      gl.uniformMatrix4fv(uniforms.link, false, matrixOf(pose, n));
      put(l, gl.TRIANGLES);
    });
    lines.forEach((l) => gl.deleteBuffer(l.buffer));
    lines = [load(standing, gl.DYNAMIC_DRAW)];
    gl.uniformMatrix4fv(uniforms.link, false, matrixOf(null, 0));
    put(lines[0], gl.TRIANGLES);
  };
  return { canvas, take, show };
}
