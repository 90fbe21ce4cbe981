// What was sensed and planned, as it came, and how it stood at any time.

class Track {
  constructor() { this.times = []; this.values = []; }
  add(t, value) { this.times.push(t); this.values.push(value); }
  // The last that came by a time, as [when, what]; undefined before the first.
  at(t) {
    const k = before(this.times, t);
    return k < 0 ? undefined : [this.times[k], this.values[k]];
  }
}

const bytesOf = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

class Sensing {
  constructor() { this.clear(); }

  clear() {
    for (const kind of ["torque", "heat", "scan", "sees", "way", "steps", "reach", "arm"]) this[kind] = new Track();
    this.source = "";
  }

  add(line) {
    const t = line.t_s;
    for (const kind of ["torque", "heat"]) if (line[kind]) this[kind].add(t, Float32Array.from(line[kind]));
    for (const kind of ["scan", "sees", "way", "steps", "reach", "arm"]) if (line[kind]) this[kind].add(t, line[kind]);
    if (line.no_reach) this.reach.add(t, null);
    if (line.source) this.source = line.source;
  }
}

// A frame that is fixed in a body, where all bodies are at `matrices`.
const siteAt = (site, matrices) => times(matrices[site.body], matrixOf(site.X_BS));

// The points of a scan, [x, y, z] in the world.
function pointsOf(scan, X_WL) {
  const data = bytesOf(scan.ranges_mm), view = new DataView(data.buffer), points = [];
  for (let k = 0; 2 * k + 1 < data.length; k++) {
    const r = view.getUint16(2 * k, true) / 1000;
    if (!r) continue;
    const angle = scan.from_rad + k * scan.step_rad, [x, y] = [r * Math.cos(angle), r * Math.sin(angle)];
    points.push([0, 1, 2].map((row) => X_WL[row] * x + X_WL[4 + row] * y + X_WL[12 + row]));
  }
  return points;
}
