// Triangles of the shapes that bodies are made of, in true size: points, normals, faces.

const ROUND = 28;
const WALL_M = 1.15; // what is left of a wall, so that one can look into a room

function boxShape([x, y, z]) {
  const shape = { points: [], normals: [], faces: [] };
  for (const [axis, sign] of [[0, 1], [0, -1], [1, 1], [1, -1], [2, 1], [2, -1]]) {
    const first = shape.points.length / 3, [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    for (const [a, b] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
      const point = [0, 0, 0], normal = [0, 0, 0];
      point[axis] = sign; point[u] = a * sign; point[v] = b; normal[axis] = sign;
      shape.points.push(point[0] * x, point[1] * y, point[2] * z);
      shape.normals.push(...normal);
    }
    shape.faces.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  return shape;
}

// Turned about z: rows of [radius, height, normal outwards, normal upwards].
function turned(rows) {
  const shape = { points: [], normals: [], faces: [] };
  for (const [r, h, out, up] of rows) {
    for (let k = 0; k <= ROUND; k++) {
      const c = Math.cos(2 * Math.PI * k / ROUND), s = Math.sin(2 * Math.PI * k / ROUND);
      shape.points.push(r * c, r * s, h);
      shape.normals.push(out * c, out * s, up);
    }
  }
  const wide = ROUND + 1;
  for (let row = 0; row + 1 < rows.length; row++) {
    for (let k = 0; k < ROUND; k++) {
      const a = row * wide + k;
      shape.faces.push(a, a + 1, a + wide + 1, a, a + wide + 1, a + wide);
    }
  }
  return shape;
}

function arc(r, h, from, to, steps) {
  return Array.from({ length: steps + 1 }, (_, k) => {
    const angle = from + (to - from) * k / steps;
    return [r * Math.cos(angle), h + r * Math.sin(angle), Math.cos(angle), Math.sin(angle)];
  });
}

function shapeOf(geom, meshes) {
  const [a, b, c] = geom.size_m, quarter = Math.PI / 2;
  switch (geom.kind) {
    case "box": return boxShape([a, b, c]);
    case "sphere": return turned(arc(a, 0, -quarter, quarter, 14));
    case "cylinder":
      return turned([[0, -b, 0, -1], [a, -b, 0, -1], [a, -b, 1, 0], [a, b, 1, 0], [a, b, 0, 1], [0, b, 0, 1]]);
    case "capsule": return turned([...arc(a, -b, -quarter, 0, 7), ...arc(a, b, 0, quarter, 7)]);
    case "ellipsoid": {
      const ball = turned(arc(1, 0, -quarter, quarter, 14)), size = [a, b, c];
      ball.points = ball.points.map((one, index) => one * size[index % 3]);
      for (let k = 0; k < ball.normals.length; k += 3) {
        const n = unit([0, 1, 2].map((axis) => ball.normals[k + axis] / size[axis]));
        [ball.normals[k], ball.normals[k + 1], ball.normals[k + 2]] = n;
      }
      return ball;
    }
    default: return meshShape(meshes[geom.mesh]);
  }
}

function meshShape(mesh) {
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
  const from = new Float32Array(bytes(mesh.points_m)), faces = new Uint32Array(bytes(mesh.faces));
  const shape = { points: [], normals: [], faces: [] };
  for (let k = 0; k < faces.length; k += 3) { // each face for itself: edges stay sharp
    const [p, q, r] = [0, 1, 2].map((i) => [0, 1, 2].map((axis) => from[3 * faces[k + i] + axis]));
    const normal = unit(cross(minus(q, p), minus(r, p)));
    for (const point of [p, q, r]) { shape.points.push(...point); shape.normals.push(...normal); }
    shape.faces.push(k, k + 1, k + 2);
  }
  return shape;
}

// The geoms of a body as one list of triangles; a checker stands for itself.
function pieces(body, meshes) {
  const whole = { points: [], normals: [], colours: [], faces: [] }, found = [];
  for (const given of body.geoms || []) {
    const geom = body.role === "wall" ? lowered(given, body) : given;
    if (!geom) continue;
    const one = shapeOf(geom, meshes), m = matrixOf(geom.X_BG);
    const into = geom.rgba2 ? { points: [], normals: [], colours: [], faces: [] } : whole;
    const first = into.points.length / 3;
    for (let k = 0; k < one.points.length; k += 3) {
      const [x, y, z] = one.points.slice(k, k + 3), [nx, ny, nz] = one.normals.slice(k, k + 3);
      for (let row = 0; row < 3; row++) {
        into.points.push(m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row]);
        into.normals.push(m[row] * nx + m[4 + row] * ny + m[8 + row] * nz);
      }
      into.colours.push(...geom.rgba.slice(0, 3));
    }
    for (const face of one.faces) into.faces.push(first + face);
    if (geom.rgba2) found.push({ ...into, second: geom.rgba2, tile: geom.tile_m, origin: [geom.X_BG[0] - geom.size_m[0], geom.X_BG[1] - geom.size_m[1]] });
  }
  if (whole.faces.length) found.push(whole);
  return found;
}

// A wall cut off at WALL_M; what stands above that is not there.
function lowered(geom, body) {
  const middle = body.X_PB[2] + geom.X_BG[2], half = geom.size_m[2];
  const [low, high] = [middle - half, Math.min(middle + half, WALL_M)];
  if (high <= low) return null;
  const size = [geom.size_m[0], geom.size_m[1], (high - low) / 2], pose = [...geom.X_BG];
  pose[2] = (high + low) / 2 - body.X_PB[2];
  return { ...geom, size_m: size, X_BG: pose };
}
