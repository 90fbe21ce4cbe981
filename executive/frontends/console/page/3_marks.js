// What is drawn over bodies: points, and coloured triangles that one can look through. Without light.

const MARK_VERTEX = `#version 300 es
layout(location=0) in vec3 point; layout(location=1) in vec4 colour;
uniform mat4 view; uniform float size; out vec4 paint;
void main() { gl_Position = view * vec4(point, 1.0); gl_PointSize = clamp(size / gl_Position.w, 2.0, 14.0); paint = colour; }`;
const MARK_FRAGMENT = `#version 300 es
precision highp float; in vec4 paint; out vec4 pixel; uniform float round;
void main() {
  if (round > 0.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
  pixel = paint;
}`;
const NUMBERS = 7; // of a vertex: x, y, z, red, green, blue, how much of it

class Marks {
  constructor(drawing) {
    this.gl = drawing.gl;
    this.canvas = drawing.canvas;
    this.program = drawing.program(MARK_VERTEX, MARK_FRAGMENT);
    this.all = new Map();
  }

  // Draw these from now on under a name; `size` [m] makes points of them, else they are triangles.
  set(name, numbers, { size = 0, through = false } = {}) {
    const gl = this.gl;
    let mark = this.all.get(name);
    if (!mark) {
      mark = { array: gl.createVertexArray(), buffer: gl.createBuffer() };
      gl.bindVertexArray(mark.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, mark.buffer);
      for (const [place, count, offset] of [[0, 3, 0], [1, 4, 12]]) {
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, count, gl.FLOAT, false, 4 * NUMBERS, offset);
      }
      this.all.set(name, mark);
    }
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ARRAY_BUFFER, mark.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.DYNAMIC_DRAW);
    Object.assign(mark, { count: numbers.length / NUMBERS, size, through });
  }

  clear() { for (const mark of this.all.values()) mark.count = 0; }

  draw(view, fovy) {
    const gl = this.gl, { made, names } = this.program;
    gl.useProgram(made);
    gl.uniformMatrix4fv(names.view, false, view);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    for (const mark of this.all.values()) {
      if (!mark.count) continue;
      if (mark.through) gl.disable(gl.DEPTH_TEST); else gl.enable(gl.DEPTH_TEST);
      gl.uniform1f(names.size, mark.size * this.canvas.height / (2 * Math.tan(fovy / 2)));
      gl.uniform1f(names.round, mark.size ? 1 : 0);
      gl.bindVertexArray(mark.array);
      gl.drawArrays(mark.size ? gl.POINTS : gl.TRIANGLES, 0, mark.count);
    }
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
  }
}

// --- shapes, as the numbers of their triangles ---

const FLAT_M = 0.006; // above the floor

function triangle(into, colour, ...points) { for (const p of points) into.push(...p, ...colour); }

function quad(into, colour, a, b, c, d) { triangle(into, colour, a, b, c); triangle(into, colour, a, c, d); }

// A ribbon on the floor along points [x, y].
function ribbon(into, points, half, colour, z = FLAT_M) {
  for (let k = 0; k + 1 < points.length; k++) {
    const [a, b] = [points[k], points[k + 1]], dx = b[0] - a[0], dy = b[1] - a[1], n = Math.hypot(dx, dy);
    if (n < 1e-6) continue;
    const [x, y] = [-dy / n * half, dx / n * half];
    quad(into, colour, [a[0] + x, a[1] + y, z], [a[0] - x, a[1] - y, z], [b[0] - x, b[1] - y, z], [b[0] + x, b[1] + y, z]);
  }
}

// A ring on the floor, filled where `inner` is 0.
function ring(into, [x, y], inner, outer, colour, z = FLAT_M) {
  const at = (r, k) => [x + r * Math.cos(Math.PI * k / 24), y + r * Math.sin(Math.PI * k / 24), z];
  for (let k = 0; k < 48; k++) quad(into, colour, at(inner, k), at(outer, k), at(outer, k + 1), at(inner, k + 1));
}

// A rectangle on the floor about [x, y, heading].
function sheet(into, [x, y, yaw], [length, width], colour, z = FLAT_M) {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const at = (u, v) => [x + c * u * length - s * v * width, y + s * u * length + c * v * width, z];
  quad(into, colour, at(1, 1), at(-1, 1), at(-1, -1), at(1, -1));
}

// A box about a frame, from corner to corner in it.
function block(into, m, low, high, colour) {
  const at = (i, j, k) => {
    const p = [i ? high[0] : low[0], j ? high[1] : low[1], k ? high[2] : low[2]];
    return [0, 1, 2].map((row) => m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row]);
  };
  for (const one of [0, 1]) {
    quad(into, colour, at(one, 0, 0), at(one, 1, 0), at(one, 1, 1), at(one, 0, 1));
    quad(into, colour, at(0, one, 0), at(1, one, 0), at(1, one, 1), at(0, one, 1));
    quad(into, colour, at(0, 0, one), at(1, 0, one), at(1, 1, one), at(0, 1, one));
  }
}
