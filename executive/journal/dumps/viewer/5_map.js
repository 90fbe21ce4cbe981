// The world from above: rooms, furniture, people, objects where they were believed to be, the way.

const NAMED = new Map(Object.entries({
  red: "#d62828", blue: "#1f6fd6", green: "#2a9d3a", yellow: "#e0b400", orange: "#e8791a", white: "#f5f5f5",
  black: "#222222", grey: "#8a8f98", gray: "#8a8f98", brown: "#8b5a2b", pink: "#e377c2", purple: "#7b3fb8",
}));
const things = new Map(list(plan?.objects).map((thing) => [thing.id, thing]));

const bounds = (() => {
  const xs = [], ys = [];
  const add = ([x, y]) => { xs.push(x); ys.push(y); };
  for (const area of [...list(plan?.rooms), ...list(plan?.furniture)]) area.outline_m.forEach(add);
  for (let i = 0; i < poses.length; i += 5) add([poses[i][1], poses[i][2]]);
  for (const person of list(plan?.people)) add([person.x_m, person.y_m]);
  if (!xs.length) return [-2, -2, 2, 2];
  const least = (v) => v.reduce((a, b) => Math.min(a, b)), most = (v) => v.reduce((a, b) => Math.max(a, b));
  return [least(xs) - 0.3, least(ys) - 0.3, most(xs) + 0.3, most(ys) + 0.3];
})();
const camera = { scale: 1, x: 0, y: 0 };

/** Texts of the map: each has its place to itself, the first ones the best; for others there may be none. */
class Labels {
  constructor(pen, width, height) { Object.assign(this, { pen, width, height, taken: [] }); }
  /** Keep a place free: its middle, and half its width and height. */
  keep(x, y, halfWidth, halfHeight) { this.taken.push([x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight]); }
  /** Write in the first place (the text's middle) that is free and inside; whether there was one. */
  write(text, places, colour) {
    const half = this.pen.measureText(text).width / 2 + 2;
    for (const [x, y] of text ? places(half) : []) {
      const box = [x - half, y - 7, x + half, y + 7];
      const inside = box[0] >= 0 && box[1] >= 0 && box[2] <= this.width && box[3] <= this.height;
      if (!inside || this.taken.some((other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])) continue;
      this.taken.push(box);
      this.pen.textAlign = "center";
      this.pen.lineWidth = 3;
      this.pen.strokeStyle = colours.ground;
      this.pen.strokeText(text, x, y + 4);
      this.pen.fillStyle = colour;
      this.pen.fillText(text, x, y + 4);
      return true;
    }
    return false;
  }
}
/** Places around a point, beside it first. */
const around = (x, y, far) => (half) => [
  [x + far + half, y], [x - far - half, y], [x, y - far - 8], [x, y + far + 8],
  ...[15, -15, 30, -30].flatMap((dy) => [[x + far + half, y + dy], [x - far - half, y + dy], [x, y + dy]]),
];
/** Places on an area: its middle, then above and below that; never beyond the map's edges. */
const inside = (x, y, width) => (half) => [0, -14, 14].map((dy) => [Math.min(Math.max(x, half), width - half), y + dy]);

function drawMap() {
  const { pen, width, height } = fresh($("map"));
  if (!plan && !poses.length) {
    pen.fillStyle = colours.dim;
    pen.textAlign = "center";
    pen.fillText("this journal has no map and no path", width / 2, height / 2);
    return;
  }
  const fit = Math.min(width / (bounds[2] - bounds[0]), height / (bounds[3] - bounds[1]));
  const scale = fit * camera.scale;
  const cx = (bounds[0] + bounds[2]) / 2 + camera.x, cy = (bounds[1] + bounds[3]) / 2 + camera.y;
  const at = ([x, y]) => [width / 2 + (x - cx) * scale, height / 2 - (y - cy) * scale];
  camera.unit = scale;
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center";
  for (const room of list(plan?.rooms)) area(pen, room.outline_m.map(at), colours.room, colours.line);
  const names = [], labels = new Labels(pen, width, height);
  for (const spot of list(plan?.spots)) names.push([area(pen, spot.outline_m.map(at), null, colours.line, [3, 3]), spot.name]);
  for (const piece of list(plan?.furniture)) {
    names.push([area(pen, piece.outline_m.map(at), colours.furniture, colours.waiting), piece.name.includes("wall") ? "" : piece.name]);
  }
  for (const [, outlines] of Object.entries(run.unmapped || {})) {
    const outline = outlines[lastBefore(outlines, now)];
    if (outline && outline[1].length) area(pen, outline[1].map(at), null, colours.warn, [2, 2]);
  }
  const people = list(plan?.people).map((person) => [person.name, ...someone(pen, person, at, scale)]);
  way(pen, at);
  for (const trouble of troubles) if (trouble.t_s <= now) {
    const pose = poses[lastBefore(poses, trouble.t_s)];
    if (pose) { const [x, y] = at([pose[1], pose[2]]); cross(pen, x, y); }
  }
  const here = robot(pen, at, scale), held = Object.entries(boardAt(now).get("held")?.[0] || {});
  const seen = Object.entries(run.things || {}).map(([id, sights]) => {
    const hand = held.find(([, name]) => name === id)?.[0];
    return thing(pen, id, sights, at, hand && here ? inHand(here, hand) : null);
  }).filter(Boolean);
  ruler(pen, labels, scale);
  if (here) labels.keep(here[0], here[1], here[3], here[3]);
  for (const [, x, y] of seen) labels.keep(x, y, 5, 5);
  for (const [text, x, y] of seen) labels.write(cut(text), around(x, y, 5), colours.text);
  for (const [name, x, y, r] of people) labels.write(cut(name), (half) => [[x, y], ...around(x, y, r)(half)], colours.text);
  for (const [[x, y, wide], name] of names) labels.write(fitted(pen, name, Math.max(wide - 4, 60)), inside(x, y, width), colours.dim);
}
/** A name of at most so many letters. */
const cut = (name) => (name.length > 24 ? begun(name, 23) : name);

function area(pen, corners, fill, line, dash = []) {
  pen.beginPath();
  corners.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.closePath();
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  pen.setLineDash(dash);
  pen.strokeStyle = line;
  pen.lineWidth = 1;
  pen.stroke();
  pen.setLineDash([]);
  const mean = (k) => corners.reduce((sum, c) => sum + c[k], 0) / Math.max(1, corners.length);
  const wide = corners.reduce((m, c) => Math.max(m, Math.abs(c[0] - mean(0))), 0) * 2;
  return [mean(0), mean(1), wide];
}

function someone(pen, person, at, scale) {
  const [x, y] = at([person.x_m, person.y_m]), r = Math.max(5, (person.radius_m || 0.25) * scale);
  pen.beginPath();
  pen.arc(x, y, r, 0, 2 * Math.PI);
  pen.strokeStyle = colours.stopped;
  pen.lineWidth = 2;
  pen.stroke();
  return [x, y, r];
}

function way(pen, at) {
  const stroke = (from, to, alpha, width) => {
    if (to - from < 1) return;
    pen.beginPath();
    for (let i = from; i <= to; i++) {
      const [x, y] = at([WAY[i][1], WAY[i][2]]);
      if (i === from) pen.moveTo(x, y); else pen.lineTo(x, y);
    }
    pen.globalAlpha = alpha;
    pen.strokeStyle = colours.way;
    pen.lineWidth = width;
    pen.lineJoin = "round";
    pen.stroke();
    pen.globalAlpha = 1;
  };
  const here = lastBefore(poses, now), recent = Math.max(0, lastBefore(poses, now - 60));
  stroke(0, poses.length - 1, 0.18, 1.5);
  stroke(0, here, 0.45, 2);
  stroke(Math.min(recent, Math.max(here, 0)), here, 1, 2.5);
}

/** Where the thing in a hand is drawn: before the robot, on that side. */
function inHand([x, y, yaw, r], hand) {
  const angle = yaw + (hand === "left" ? 0.6 : -0.6);
  return [x + 1.15 * r * Math.cos(angle), y - 1.15 * r * Math.sin(angle)];
}

function thing(pen, id, sights, at, carried) {
  const sight = sights[lastBefore(sights, now)];
  if (!sight) return null;
  const known = things.get(id), [x, y] = carried || at([sight[1], sight[2]]);
  const held = sight[4] || carried, missing = sight[5];
  pen.beginPath();
  pen.arc(x, y, 4.5, 0, 2 * Math.PI);
  pen.fillStyle = NAMED.get(known?.color) || colours.warn;
  pen.globalAlpha = missing ? 0.35 : 1;
  pen.fill();
  pen.strokeStyle = colours.text;
  pen.lineWidth = 1;
  pen.setLineDash(missing ? [2, 2] : []);
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
  return [(known?.name || id) + (held ? " (held)" : missing ? " (missing)" : ""), x, y];
}

function robot(pen, at, scale) {
  const index = lastBefore(poses, now);
  if (index < 0) return null;
  const [t0, x0, y0, a0] = poses[index], next = poses[index + 1];
  let [x, y, yaw] = [x0, y0, a0];
  if (next && next[0] - t0 < 2) { // between two poses, unless it stood still
    const part = Math.min(1, (now - t0) / (next[0] - t0));
    const turn = Math.atan2(Math.sin(next[3] - a0), Math.cos(next[3] - a0));
    [x, y, yaw] = [x0 + part * (next[1] - x0), y0 + part * (next[2] - y0), a0 + part * turn];
  }
  const [px, py] = at([x, y]), r = Math.max(8, 0.22 * scale);
  pen.beginPath();
  for (const [angle, reach] of [[0, 1.25], [2.4, 0.95], [Math.PI, 0.45], [-2.4, 0.95]]) {
    pen.lineTo(px + r * reach * Math.cos(yaw + angle), py - r * reach * Math.sin(yaw + angle));
  }
  pen.closePath();
  pen.fillStyle = colours.now;
  pen.fill();
  pen.strokeStyle = colours.ground;
  pen.lineWidth = 1.5;
  pen.stroke();
  return [px, py, yaw, r];
}

/** The scale, and of when and what the map is. */
function ruler(pen, labels, scale) {
  const { width, height } = labels;
  const metre = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20].find((m) => m * scale > 50) || 50;
  pen.fillStyle = colours.dim;
  pen.fillRect(width - 14 - metre * scale, height - 12, metre * scale, 2);
  pen.textAlign = "right";
  pen.fillText(`${metre} m`, width - 14, height - 16);
  labels.keep(width - 14 - (metre * scale) / 2, height - 17, (metre * scale) / 2 + 14, 13);
  pen.textAlign = "left";
  const room = width - metre * scale - 36, text = fitted(pen, `${plan?.name ? `${plan.name}, ` : ""}as the robot believed it at ${clock(now)}`, room);
  pen.fillText(text, 8, height - 8);
  labels.keep(8 + room / 2, height - 12, room / 2, 9);
}

function mapInput() {
  const canvas = $("map");
  let last = null;
  canvas.addEventListener("wheel", (event) => {
    camera.scale = Math.min(40, Math.max(0.5, camera.scale * Math.exp(-event.deltaY * 0.0015)));
    event.preventDefault();
    redraw();
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); last = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointermove", (event) => {
    if (!last) return;
    camera.x -= (event.clientX - last[0]) / (camera.unit || 1);
    camera.y += (event.clientY - last[1]) / (camera.unit || 1);
    last = [event.clientX, event.clientY];
    redraw();
  });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, () => { last = null; });
  canvas.addEventListener("dblclick", () => { Object.assign(camera, { scale: 1, x: 0, y: 0 }); redraw(); });
}
