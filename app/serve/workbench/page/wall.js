// The wall as glass: drawn by the graphics card, bright where it is seen edge-on.
const vertexShader = `#version 300 es
in vec3 p; in vec3 n;
uniform mat3 turn; uniform vec3 middle; uniform vec2 scale;
out float edge;
void main() {
  vec3 q = turn * (p - middle);
  edge = 1.0 - abs((turn * n).z);
  gl_Position = vec4(q.xy * scale, 0.0, 1.0);
}`;
const fragmentShader = `#version 300 es
precision mediump float;
in float edge; out vec4 colour;
void main() {
  float a = 0.03 + 0.32 * edge * edge * edge;
  colour = vec4(vec3(0.84, 0.34, 0.32) * a, a);
}`;

function program(gl) {
  const out = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(out, shader);
  }
  gl.linkProgram(out);
  return out;
}

export class Wall {
  constructor(canvas) {
    this.canvas = canvas;
    this.points = this.triangles = null; // mm
    this.gl = canvas.getContext('webgl2', { antialias: true }); // null: no wall is drawn, everything else works
    if (!this.gl) return;
    this.program = program(this.gl);
    this.buffers = ['p', 'n', 'triangles'].map(() => this.gl.createBuffer());
  }
  take(bytes) {
    const view = new DataView(bytes), vertices = view.getUint32(8, true), triangles = view.getUint32(12, true);
    this.points = new Float32Array(bytes.slice(16, 16 + 12 * vertices));
    this.triangles = new Uint32Array(bytes.slice(16 + 12 * vertices, 16 + 12 * (vertices + triangles)));
    const gl = this.gl;
    if (!gl) return;
    gl.useProgram(this.program);
    const [p, n, t] = this.buffers;
    for (const [name, buffer, data] of [['p', p, this.points], ['n', n, this.normals()]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      const at = gl.getAttribLocation(this.program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, t);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.triangles, gl.STATIC_DRAW);
  }
  normals() {
    const p = this.points, out = new Float32Array(p.length);
    for (let i = 0; i < this.triangles.length; i += 3) {
      const [a, b, c] = [3 * this.triangles[i], 3 * this.triangles[i + 1], 3 * this.triangles[i + 2]];
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]], v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const k of [a, b, c]) for (let j = 0; j < 3; ++j) out[k + j] += n[j];
    }
    for (let k = 0; k < out.length; k += 3) {
      const length = Math.hypot(out[k], out[k + 1], out[k + 2]) || 1;
      for (let j = 0; j < 3; ++j) out[k + j] /= length;
    }
    return out;
  }
  // The nearest point of the wall under a point of the canvas, in mm; null: there is none.
  hit(camera, x, y) {
    if (!this.points) return null;
    const placed = new Float32Array(this.points.length);
    for (let k = 0; k < placed.length; k += 3) placed.set(camera.place(this.points, k), k);
    let best = null;
    for (let i = 0; i < this.triangles.length; i += 3) {
      const [a, b, c] = [3 * this.triangles[i], 3 * this.triangles[i + 1], 3 * this.triangles[i + 2]];
      const ux = placed[b] - placed[a], uy = placed[b + 1] - placed[a + 1], vx = placed[c] - placed[a], vy = placed[c + 1] - placed[a + 1];
      const det = ux * vy - uy * vx, wx = x - placed[a], wy = y - placed[a + 1];
      if (!det) continue;
      const s = (wx * vy - wy * vx) / det, t = (ux * wy - uy * wx) / det;
      if (s < 0 || t < 0 || s + t > 1) continue;
      const depth = placed[a + 2] + s * (placed[b + 2] - placed[a + 2]) + t * (placed[c + 2] - placed[a + 2]);
      if (best && depth <= best.depth) continue;
      const p = [0, 1, 2].map((j) => this.points[a + j] + s * (this.points[b + j] - this.points[a + j]) + t * (this.points[c + j] - this.points[a + j]));
      best = { depth, p };
    }
    return best && best.p;
  }
  draw(camera) {
    const gl = this.gl;
    if (!gl || !this.points) return;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    gl.uniformMatrix3fv(uniform('turn'), false, camera.columns());
    gl.uniform3fv(uniform('middle'), camera.middle);
    gl.uniform2f(uniform('scale'), 2 * camera.scale / camera.width, 2 * camera.scale / camera.height);
    gl.drawElements(gl.TRIANGLES, this.triangles.length, gl.UNSIGNED_INT, 0);
  }
}
