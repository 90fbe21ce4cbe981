// What is planned and sensed, in 3-D: each kind can be switched off.

const SHOWS = { plans: true, lidar: true, zones: true, truth: true, cloud: false };
const BLUE = [0.0, 0.45, 0.85], GREEN = [0.0, 0.62, 0.35], ORANGE = [0.95, 0.5, 0.05], VIOLET = [0.55, 0.25, 0.85], RED = [0.85, 0.1, 0.15];
const ARM_REST_S = 0.4; // so long a motion is shown after its end

const plans = {
  marks: null, lidarOf: null, armOf: undefined, armPath: [], key: "",

  // Put everything that is drawn over the bodies up to date; returns the arm's end, to be drawn as a ghost.
  update(t, matrices) {
    const { marks } = this;
    if (!marks) return null;
    const floor = [], solid = [], dots = [];
    let ghost = null;
    if (SHOWS.zones) this.zones(floor, matrices);
    if (SHOWS.plans) {
      this.way(floor, t, matrices);
      this.steps(floor, t);
      this.reach(solid, floor, t);
      ghost = this.arm(dots, t);
    }
    marks.set("floor", floor);
    marks.set("solid", solid);
    marks.set("arm", dots, { size: 0.02, through: true });
    this.lidar(t);
    if (!SHOWS.cloud) marks.set("cloud", []);
    return ghost;
  },

  zones(into, matrices) {
    page.scene.bodies.forEach((body, k) => {
      if (body.role !== "person" || !matrices[k]) return;
      const at = [matrices[k][12], matrices[k][13]];
      ring(into, at, 0, page.zone_m, [...RED, 0.13], 0.004);
      ring(into, at, page.zone_m - 0.02, page.zone_m, [...RED, 0.75], 0.005);
    });
  },

  way(into, t, matrices) {
    const found = sensing.way.at(t);
    if (!found || !found[1].length) return;
    const base = matrices[page.scene.base], points = found[1].map(([x, y]) => [x, y]);
    // What is behind the robot is walked already: the way begins at the nearest of its points.
    let nearest = 0;
    const far = (k) => Math.hypot(points[k][0] - base[12], points[k][1] - base[13]);
    for (let k = 1; k < points.length; k++) if (far(k) < far(nearest)) nearest = k;
    const left = [[base[12], base[13]], ...points.slice(Math.min(nearest + 1, points.length - 1))];
    ribbon(into, left, 0.03, [...GREEN, 0.7], 0.007);
    for (const [x, y, yaw] of found[1].slice(nearest)) ring(into, [x, y], 0, 0.045, [...GREEN, 0.8], 0.008);
    const [x, y, yaw] = found[1][found[1].length - 1], [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    const at = (u, v) => [x + c * u - s * v, y + s * u + c * v, 0.009];
    triangle(into, [...GREEN, 0.9], at(0.24, 0), at(-0.02, 0.12), at(-0.02, -0.12)); // which way it will face
  },

  steps(into, t) {
    const found = sensing.steps.at(t);
    if (!found) return;
    found[1].forEach(([foot, x, y, yaw], k) => {
      const colour = foot ? ORANGE : VIOLET;
      sheet(into, [x, y, yaw], page.scene.sole_m, [...colour, k ? 0.35 : 0.7], 0.01 + 0.001 * k);
    });
  },

  // The hand before and at the grasp, as three bars, and where to stand for it.
  reach(into, floor, t) {
    const found = sensing.reach.at(t);
    if (!found || !found[1]) return;
    const { hand, stance, kind } = found[1], colour = kind === "pick" ? ORANGE : GREEN;
    const open = 0.05, thick = 0.007, long = 0.06;
    hand.forEach((pose, k) => {
      const m = matrixOf(pose), paint = [...colour, k === 1 ? 0.85 : 0.3];
      for (const side of [-1, 1]) block(into, m, [-long, side * open - thick, -thick], [0.02, side * open + thick, thick], paint);
      block(into, m, [-long - 2 * thick, -open - thick, -thick], [-long, open + thick, thick], paint);
    });
    const dots = [];
    for (let k = 0; k + 1 < hand.length; k++) for (let part = 0; part < 1; part += 0.12) dots.push(between(hand[k], hand[k + 1], part).slice(0, 3));
    for (const p of dots) block(into, matrixOf([...p, 1, 0, 0, 0]), [-0.004, -0.004, -0.004], [0.004, 0.004, 0.004], [...colour, 0.9]);
    ring(floor, stance, 0.13, 0.16, [...colour, 0.8], 0.009);
  },

  // The way of the hand while an arm moves as planned, and the arm at its end.
  arm(into, t) {
    const found = sensing.arm.at(t);
    if (!found) return null;
    const [from, arm] = found, end = from + arm.times_s[arm.times_s.length - 1];
    if (t > end + ARM_REST_S || !page.scene.grasps[arm.side]) return null;
    const stands = motion.at(from);
    if (!stands) return null;
    if (this.armOf !== found[1]) { // how it goes, once
      this.armOf = found[1];
      this.armPath = arm.positions.map((positions) => {
        const q = [...stands.q];
        arm.motors.forEach((motor, k) => { q[motor] = positions[k]; });
        const one = { at: () => ({ base: stands.base, q }), poseOf: () => null };
        const all = matricesAt(page.scene, { at: one.at, poseOf: one.poseOf, objects: null, people: null }, from, page.resting);
        return { all, hand: siteAt(page.scene.grasps[arm.side], all) };
      });
    }
    const path = this.armPath.map(({ hand }) => [hand[12], hand[13], hand[14]]);
    for (let k = 0; k + 1 < path.length; k++) {
      const apart = Math.hypot(...minus(path[k + 1], path[k])), count = Math.max(1, Math.round(apart / 0.03));
      for (let i = 0; i < count; i++) into.push(...path[k].map((one, row) => one + (path[k + 1][row] - one) * i / count), ...VIOLET, 0.95);
    }
    if (path.length) into.push(...path[path.length - 1], ...VIOLET, 1);
    const moved = new Set(arm.motors), { all } = this.armPath[this.armPath.length - 1];
    return { all, bodies: movedBy(page.scene, moved), colour: VIOLET };
  },

  lidar(t) {
    const found = SHOWS.lidar ? sensing.scan.at(t) : undefined;
    const fresh = found && t - found[0] < 2 ? found : undefined; // an old scan is of elsewhere
    if ((fresh && fresh[1]) === this.lidarOf) return; // null: it is not known what is drawn
    this.lidarOf = fresh && fresh[1];
    const numbers = [];
    if (fresh) {
      const X_WL = siteAt(page.scene.lidar, matricesAt(page.scene, motion, fresh[0], page.resting));
      for (const point of pointsOf(fresh[1], X_WL)) numbers.push(...point, ...RED, 1);
    }
    this.marks.set("lidar", numbers, { size: 0.035 });
  },

  // The depth image as points, coloured by height.
  points(shot, grey) {
    const X_WC = siteAt(page.scene.camera, matricesAt(page.scene, motion, shot.t_s, page.resting)), numbers = [];
    const [fx, fy] = shot.focal_px, [cx, cy] = shot.centre_px;
    for (let v = 0; v < shot.height; v++) for (let u = 0; u < shot.width; u++) {
      const depth = grey[4 * (v * shot.width + u)] / 255 * shot.range_m;
      if (!depth) continue;
      const p = [(u - cx) / fx * depth, (v - cy) / fy * depth, depth];
      const at = [0, 1, 2].map((row) => X_WC[row] * p[0] + X_WC[4 + row] * p[1] + X_WC[8 + row] * p[2] + X_WC[12 + row]);
      const part = Math.max(0, Math.min(1, at[2] / 1.6));
      numbers.push(...at, 0.1 + 0.9 * part, 0.75 - 0.45 * Math.abs(2 * part - 1), 1 - 0.9 * part, 1);
    }
    this.marks.set("cloud", numbers, { size: 0.022 });
  },
};

// The bodies that some motors move, and all that hangs on them.
function movedBy(scene, motors) {
  const moved = new Set();
  scene.bodies.forEach((body, k) => {
    if (body.role === "robot" && (moved.has(body.parent) || (body.joints || []).some((joint) => motors.has(joint.motor)))) moved.add(k);
  });
  return moved;
}
