// What the camera saw, at the time that is looked at, with a box around each thing that was recognised.

const camera_ = {
  shown: false, kind: "colour", shots: {}, images: {}, drawn: "",

  // Which pictures the page wants of its server now.
  wanted() {
    const kinds = [];
    if (this.shown) kinds.push("colour");
    if (SHOWS.cloud || (this.shown && (this.kind === "depth" || !this.shots.colour))) kinds.push("depth");
    return kinds;
  },

  ask() { if (link) link.send({ at: page.now ? null : page.t, pictures: this.wanted() }); },

  clear() { this.shots = {}; this.images = {}; this.drawn = ""; this.draw(); },

  async have(shot) {
    const image = new Image();
    image.src = `data:image/${shot.type};base64,${shot.data}`;
    try { await image.decode(); } catch { return; } // no picture
    this.shots[shot.kind] = shot;
    this.images[shot.kind] = shot.kind === "depth" ? this.depth(shot, image) : image;
    this.draw();
  },

  // A depth image in colours, near bright and far dark; its points are put into the 3-D picture, too.
  depth(shot, image) {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [shot.width, shot.height];
    const paper = canvas.getContext("2d", { willReadFrequently: true });
    paper.drawImage(image, 0, 0);
    const pixels = paper.getImageData(0, 0, shot.width, shot.height);
    if (SHOWS.cloud && page.scene && plans.marks) { plans.points(shot, pixels.data); page.dirty = true; }
    for (let k = 0; k < pixels.data.length; k += 4) {
      const far = pixels.data[k] / 255, colour = far ? nearToFar(far) : [0, 0, 0];
      for (let i = 0; i < 3; i++) pixels.data[k + i] = 255 * colour[i];
    }
    paper.putImageData(pixels, 0, 0);
    return canvas;
  },

  draw() {
    $("seen").hidden = !this.shown;
    if (!this.shown) return;
    const kind = this.shots[this.kind] ? this.kind : this.shots.colour ? "colour" : "depth", shot = this.shots[kind];
    $("seen-none").hidden = Boolean(shot);
    $("picture").hidden = !shot;
    for (const one of ["colour", "depth"]) {
      $(`seen-${one}`).setAttribute("aria-pressed", kind === one && Boolean(shot));
      $(`seen-${one}`).disabled = one === "colour" && !this.shots.colour && Boolean(this.shots.depth);
    }
    $("seen-colour").title = this.shots.colour ? "" : "None are kept: --camera renders and keeps them, in live runs";
    if (!shot || !page.scene) { $("seen-note").textContent = ""; return; }
    const canvas = $("picture"), paper = canvas.getContext("2d"), scale = 480 / shot.width;
    [canvas.width, canvas.height] = [480, Math.round(shot.height * scale)];
    paper.imageSmoothingEnabled = kind === "colour";
    paper.drawImage(this.images[kind], 0, 0, canvas.width, canvas.height);
    const sees = sensing.sees.at(shot.t_s + 0.05), names = sees ? sees[1] : [];
    for (const id of names) this.box(paper, id, shot, scale);
    const who = sensing.source === "oracle" ? "boxes: the simulation's oracle" : `boxes: ${sensing.source || "nobody"}`;
    const what = kind === "depth" ? `depth to ${shot.range_m} m, light is near` : "colours";
    $("seen-note").textContent = `${seconds(shot.t_s)}  ${what}, ${shot.source}; ${who}`;
  },

  // A box where something is believed to be, as the camera had to see it.
  box(paper, id, shot, scale) {
    const k = page.scene.bodies.findIndex((body) => body.id === id && ["object", "person"].includes(body.role));
    if (k < 0) return;
    const matrices = matricesAt(page.scene, motion, shot.t_s, page.resting);
    if (!matrices[k]) return;
    const X_CW = inverse(siteAt(page.scene.camera, matrices)), X_CB = times(X_CW, matrices[k]);
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const p of cornersOf(page.scene.bodies[k])) {
      const [x, y, z] = [0, 1, 2].map((row) => X_CB[row] * p[0] + X_CB[4 + row] * p[1] + X_CB[8 + row] * p[2] + X_CB[12 + row]);
      if (z < 0.05) continue;
      const u = (shot.centre_px[0] + shot.focal_px[0] * x / z + 0.5) * scale, v = (shot.centre_px[1] + shot.focal_px[1] * y / z + 0.5) * scale;
      [box[0], box[1], box[2], box[3]] = [Math.min(box[0], u), Math.min(box[1], v), Math.max(box[2], u), Math.max(box[3], v)];
    }
    const { width: w, height: h } = paper.canvas;
    const [x0, y0, x1, y1] = [Math.max(1, box[0]), Math.max(1, box[1]), Math.min(w - 1, box[2]), Math.min(h - 1, box[3])];
    if (!(x1 > x0 && y1 > y0)) return;
    const name = page.scene.bodies[k].name || id, person = page.scene.bodies[k].role === "person";
    paper.lineWidth = 3;
    paper.strokeStyle = person ? "#ff5a5f" : "#ffd400";
    paper.strokeRect(x0, y0, x1 - x0, y1 - y0);
    paper.font = "600 19px system-ui, sans-serif";
    const wide = paper.measureText(name).width + 10, left = Math.min(x0, w - wide), top = y0 > 26 ? y0 - 25 : Math.min(y1, h - 25);
    paper.fillStyle = paper.strokeStyle;
    paper.fillRect(left, top, wide, 25);
    paper.fillStyle = "#111";
    paper.fillText(name, left + 5, top + 19);
  },
};

// Light yellow, orange, violet, dark blue: lightness falls all the way.
const DEPTHS = [[1, 0.98, 0.7], [0.99, 0.65, 0.3], [0.75, 0.22, 0.45], [0.4, 0.08, 0.5], [0.08, 0.03, 0.25]];
function nearToFar(part) {
  const at = Math.sqrt(part) * (DEPTHS.length - 1), k = Math.min(DEPTHS.length - 2, Math.floor(at));
  return DEPTHS[k].map((one, i) => one + (DEPTHS[k + 1][i] - one) * (at - k));
}

// The corners of the boxes around the shapes of a body, in its frame.
const corners = new Map();
function cornersOf(body) {
  if (!corners.has(body)) {
    const found = [];
    for (const geom of body.geoms || []) {
      const [a, b, c] = geom.size_m, m = matrixOf(geom.X_BG);
      let low, high;
      if (geom.kind === "mesh") {
        const points = new Float32Array(bytesOf(page.scene.meshes[geom.mesh].points_m).buffer);
        [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
        points.forEach((one, k) => { low[k % 3] = Math.min(low[k % 3], one); high[k % 3] = Math.max(high[k % 3], one); });
      } else {
        high = { box: [a, b, c], ellipsoid: [a, b, c], sphere: [a, a, a], cylinder: [a, a, b], capsule: [a, a, a + b] }[geom.kind];
        low = high.map((one) => -one);
      }
      for (let k = 0; k < 8; k++) {
        const p = [0, 1, 2].map((axis) => (k >> axis & 1 ? high[axis] : low[axis]));
        found.push([0, 1, 2].map((row) => m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row]));
      }
    }
    corners.set(body, found);
  }
  return corners.get(body);
}
