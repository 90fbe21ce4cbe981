// How everything moved: moments as they come, and how things stand at any time between them.

const HELD_S = 0.35; // further apart, two moments are a rest and not a motion

class Motion {
  constructor() { this.clear(); }

  clear() {
    this.times = []; this.bases = []; this.joints = [];
    this.objects = new Map(); this.people = new Map(); this.held = { times: [], values: [] };
    this.charge = null; this.late = null; this.latest = null;
  }

  add(moment) {
    const t = moment.t_s;
    this.times.push(t); this.bases.push(moment.base); this.joints.push(moment.q);
    for (const [tracks, news] of [[this.objects, moment.objects], [this.people, moment.people]]) {
      for (const [id, pose] of Object.entries(news || {})) {
        if (!tracks.has(id)) tracks.set(id, { times: [], poses: [] });
        const track = tracks.get(id);
        track.times.push(t); track.poses.push(pose);
      }
    }
    if (moment.held) { this.held.times.push(t); this.held.values.push(moment.held); }
    if (moment.charge != null) this.charge = moment.charge;
    if (moment.late != null) this.late = moment.late;
  }

  get begin() { return this.times.length ? this.times[0] : 0; }
  get end() { return this.times.length ? this.times[this.times.length - 1] : 0; }

  // How the robot stands at a time.
  at(t) {
    const k = before(this.times, t);
    if (k < 0) return this.latest || (this.times.length ? { base: this.bases[0], q: this.joints[0] } : null);
    const next = this.times[k + 1], gap = next - this.times[k];
    if (next === undefined || gap <= 0) return { base: this.bases[k], q: this.joints[k] };
    const part = gap > HELD_S ? Math.max(0, 1 - (next - t) / HELD_S) : (t - this.times[k]) / gap;
    const [p, q] = [this.joints[k], this.joints[k + 1]];
    return { base: between(this.bases[k], this.bases[k + 1], part), q: p.map((one, i) => one + (q[i] - one) * part) };
  }

  poseOf(tracks, id, t) {
    const track = tracks.get(id);
    if (!track) return undefined;
    const k = before(track.times, t), pose = k < 0 ? null : track.poses[k], next = track.poses[k + 1];
    const gap = track.times[k + 1] - track.times[k];
    return pose && next && gap <= HELD_S ? between(pose, next, (t - track.times[k]) / gap) : pose;
  }

  heldAt(t) {
    const k = before(this.held.times, t);
    return k < 0 ? [] : this.held.values[k];
  }
}

const ERRS_M = 0.02, ERRS_TURN = 0.03; // what is believed this near to the truth, in metres and parts of a matrix, is true

// What truly is elsewhere than the robot believes, of a simulation: its matrices, and which bodies they are of; null if nothing is.
function truthAt(scene, truth, motion, t, resting, matrices) {
  if (!truth.times.length) return null;
  const base = truth.at(t), stands = motion.at(t), bodies = new Set();
  const real = { at: () => ({ base: base.base, q: stands ? stands.q : scene.posture }), poseOf: (tracks, id, when) => truth.poseOf(tracks, id, when), objects: truth.objects, people: truth.people };
  const all = matricesAt(scene, real, t, resting);
  const turns = (k) => scene.bodies[k].role !== "object"; // a cup looks the same from all sides
  const errs = (k) => all[k] && (!matrices[k] || all[k].some((one, i) => Math.abs(one - matrices[k][i]) > (i >= 12 ? ERRS_M : turns(k) ? ERRS_TURN : Infinity)));
  const off = errs(scene.base);
  scene.bodies.forEach((body, k) => { if (body.role === "robot" ? off : ["object", "person"].includes(body.role) && errs(k)) bodies.add(k); });
  return bodies.size ? { all, bodies, tint: [1, 0.8, 0.1] } : null;
}

// The place of the last of some growing numbers that is not beyond a value; -1 if all are.
function before(numbers, value) {
  let [low, high] = [0, numbers.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
}

// Where every body of a scene is in the world at a time; null: nobody knows.
function matricesAt(scene, motion, t, resting) {
  const stands = motion.at(t), base = stands ? stands.base : null, q = stands ? stands.q : scene.posture;
  const found = [];
  scene.bodies.forEach((body, place) => {
    if (body.role === "robot") {
      if (place === scene.base) { found[place] = matrixOf(base || body.X_PB); return; }
      let m = times(!(body.parent >= 0) ? matrixOf(UNIT) : found[body.parent], resting[place]);
      for (const joint of body.joints || []) if (joint.motor >= 0) m = times(m, jointMatrix(joint, joint.gain * (q[joint.motor] || 0)));
      found[place] = m;
    } else if (body.role === "object" || body.role === "person") {
      const pose = motion.poseOf(body.role === "object" ? motion.objects : motion.people, body.id, t);
      found[place] = pose ? matrixOf(pose) : null;
    } else {
      found[place] = resting[place];
    }
  });
  return found;
}
