"use strict";
// Poses are [x, y, z, w, qx, qy, qz]; matrices 4 by 4 in the order of WebGL, columns first.

const UNIT = [0, 0, 0, 1, 0, 0, 0];

function matrixOf(pose, out = new Float32Array(16)) {
  const [x, y, z, w, a, b, c] = pose;
  out[0] = 1 - 2 * (b * b + c * c); out[1] = 2 * (a * b + w * c); out[2] = 2 * (a * c - w * b); out[3] = 0;
  out[4] = 2 * (a * b - w * c); out[5] = 1 - 2 * (a * a + c * c); out[6] = 2 * (b * c + w * a); out[7] = 0;
  out[8] = 2 * (a * c + w * b); out[9] = 2 * (b * c - w * a); out[10] = 1 - 2 * (a * a + b * b); out[11] = 0;
  out[12] = x; out[13] = y; out[14] = z; out[15] = 1;
  return out;
}

function times(m, n, out = new Float32Array(16)) {
  for (let column = 0; column < 4; column++) {
    const [a, b, c, d] = [n[4 * column], n[4 * column + 1], n[4 * column + 2], n[4 * column + 3]];
    for (let row = 0; row < 4; row++) {
      out[4 * column + row] = m[row] * a + m[4 + row] * b + m[8 + row] * c + m[12 + row] * d;
    }
  }
  return out;
}

// What a joint does to its body: a turn about an axis through a point, or a shift along it.
function jointMatrix(joint, value) {
  const [x, y, z] = joint.axis;
  if (joint.kind === "slide") return matrixOf([x * value, y * value, z * value, 1, 0, 0, 0]);
  const s = Math.sin(value / 2), m = matrixOf([0, 0, 0, Math.cos(value / 2), x * s, y * s, z * s]);
  const at = joint.at_m;
  for (let row = 0; row < 3; row++) {
    m[12 + row] = at[row] - m[row] * at[0] - m[4 + row] * at[1] - m[8 + row] * at[2];
  }
  return m;
}

// Of a frame's matrix, the one that goes back.
function inverse(m) {
  const out = new Float32Array(16);
  for (let row = 0; row < 3; row++) {
    for (let column = 0; column < 3; column++) out[4 * column + row] = m[4 * row + column];
    out[12 + row] = -(m[4 * row] * m[12] + m[4 * row + 1] * m[13] + m[4 * row + 2] * m[14]);
  }
  out[15] = 1;
  return out;
}

function between(a, b, part) {
  const pose = a.map((one, index) => one + (b[index] - one) * part);
  const same = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] >= 0;
  for (let index = 3; index < 7; index++) pose[index] = a[index] * (1 - part) + (same ? 1 : -1) * b[index] * part;
  const norm = Math.hypot(pose[3], pose[4], pose[5], pose[6]) || 1;
  for (let index = 3; index < 7; index++) pose[index] /= norm;
  return pose;
}

function perspective(fovy, aspect, near, far) {
  const f = 1 / Math.tan(fovy / 2), m = new Float32Array(16);
  m[0] = f / aspect; m[5] = f; m[10] = (far + near) / (near - far); m[11] = -1;
  m[14] = 2 * far * near / (near - far);
  return m;
}

function orthographic(half, near, far) {
  const m = new Float32Array(16);
  m[0] = m[5] = 1 / half; m[10] = -2 / (far - near); m[14] = -(far + near) / (far - near); m[15] = 1;
  return m;
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };

function lookAt(eye, at, up) {
  const z = unit(minus(eye, at)), x = unit(cross(up, z)), y = cross(z, x);
  return new Float32Array([
    x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
    -dot(x, eye), -dot(y, eye), -dot(z, eye), 1,
  ]);
}

function apply(m, p) {
  const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
  return [0, 1, 2].map((row) => (m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row]) / w).concat(w);
}
