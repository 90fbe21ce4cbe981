// The motors: torque as a part of what each can give, its course, its temperature; one of them large.

const COURSE_S = 20, HOT_C = 80, WARM_C = 60, HARD = 0.8, LEAST = 0.2; // of its limit: what is pushed hard, what a small course is drawn to

const motors = {
  rows: [], chosen: 0,

  build() {
    const list = $("motor-list");
    list.replaceChildren();
    this.rows = page.scene.motor_names.map((name, k) => {
      const row = element("button", "motor");
      row.type = "button";
      const course = element("canvas");
      [course.width, course.height] = [128, 36];
      const torque = element("span", "torque"), heat = element("span", "heat");
      row.append(element("span", "name", name.replaceAll("_", " ")), course, torque, heat);
      row.onclick = () => { this.chosen = k; this.draw(); };
      list.append(row);
      return { row, course, torque, heat };
    });
    this.chosen = 0;
  },

  unit(k) { return /gripper/.test(page.scene.motor_names[k]) ? "N" : "N m"; },

  // Values of one motor over the last seconds, as [time, value].
  course(track, k, t) {
    const found = [], last = before(track.times, t);
    if (last >= 0) found.push([t, track.values[last][k]]); // as it is since
    for (let i = last; i >= 0 && track.times[i] > t - COURSE_S; i--) found.push([track.times[i], track.values[i][k]]);
    return found.reverse();
  },

  draw() {
    if ($("motors").hidden || !page.scene) return;
    if (this.rows.length !== page.scene.motor_names.length) this.build();
    const t = when(), torque = sensing.torque.at(t), heat = sensing.heat.at(t);
    $("motors-none").hidden = Boolean(torque);
    const dim = css("--dim"), accent = css("--accent"), failed = css("--failed");
    this.rows.forEach(({ row, course, torque: force, heat: warm }, k) => {
      const limit = page.scene.torque_limits_nm[k], value = torque ? torque[1][k] : 0, part = Math.abs(value) / limit;
      const degrees = heat ? heat[1][k] : undefined;
      force.textContent = torque ? `${value.toFixed(value > -10 && value < 10 ? 1 : 0)} ${this.unit(k)}` : "";
      force.className = part > HARD ? "torque hard" : "torque";
      warm.textContent = degrees === undefined ? "" : `${degrees.toFixed(0)} °C`;
      warm.className = degrees > HOT_C ? "heat hard" : degrees > WARM_C ? "heat warm" : "heat";
      row.setAttribute("aria-pressed", k === this.chosen);
      row.title = `${page.scene.motor_names[k]}: ${Math.round(100 * part)} % of ${limit} ${this.unit(k)}`;
      const paper = course.getContext("2d"), [w, h] = [course.width, course.height];
      paper.clearRect(0, 0, w, h);
      paper.strokeStyle = dim; paper.lineWidth = 1; paper.globalAlpha = 0.4; paper.beginPath(); paper.moveTo(0, h / 2); paper.lineTo(w, h / 2); paper.stroke();
      paper.globalAlpha = 1; paper.strokeStyle = part > HARD ? failed : accent; paper.lineWidth = 2;
      const values = this.course(sensing.torque, k, t), half = Math.max(LEAST * limit, ...values.map(([, one]) => Math.abs(one)));
      line(paper, values, (at) => w - (t - at) / COURSE_S * w, (one) => h / 2 - one / half * (h / 2 - 2));
    });
    this.large(t);
  },

  large(t) {
    const k = this.chosen, name = page.scene.motor_names[k], canvas = $("motor-plot");
    $("motor-name").textContent = name.replaceAll("_", " ");
    const sharp = Math.min(window.devicePixelRatio || 1, 2), [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (!w) return;
    [canvas.width, canvas.height] = [Math.round(w * sharp), Math.round(h * sharp)];
    const paper = canvas.getContext("2d");
    paper.scale(sharp, sharp);
    const positions = [];
    for (let i = before(motion.times, t); i >= 0 && motion.times[i] > t - COURSE_S; i--) positions.push([motion.times[i], motion.joints[i][k]]);
    const slides = this.unit(k) === "N", turn = slides ? 1000 : 180 / Math.PI, limit = page.scene.torque_limits_nm[k];
    const plots = [
      [`position [${slides ? "mm" : "°"}]`, positions.reverse().map(([at, q]) => [at, turn * q]), slides ? 5 : 5, css("--done")],
      [`torque [${this.unit(k)}], limit ${limit}`, this.course(sensing.torque, k, t), 0.1 * limit, css("--accent")],
      ["temperature [°C]", this.course(sensing.heat, k, t), 4, css("--failed")],
    ];
    paper.font = "11px system-ui, sans-serif";
    plots.forEach(([title, values, least, colour], row) => {
      const top = row * h / 3 + 16, high = h / 3 - 22;
      paper.fillStyle = css("--dim");
      paper.fillText(title, 38, top - 4);
      if (!values.length) return;
      const all = values.map(([, one]) => one), middle = (Math.min(...all) + Math.max(...all)) / 2, half = Math.max((Math.max(...all) - Math.min(...all)) / 2, least / 2) * 1.08;
      paper.strokeStyle = css("--line");
      paper.strokeRect(38.5, top + 0.5, w - 46, high);
      paper.textAlign = "right";
      for (const [value, y] of [[middle + half, top + 9], [middle - half, top + high]]) paper.fillText(value.toFixed(half < 5 ? 1 : 0), 35, y);
      const last = all[all.length - 1];
      paper.fillStyle = colour;
      paper.fillText(last.toFixed(1), w - 8, top - 4);
      paper.textAlign = "left";
      paper.strokeStyle = colour;
      paper.lineWidth = 1.5;
      line(paper, values, (at) => w - 8 - (t - at) / COURSE_S * (w - 46), (one) => top + high / 2 - (one - middle) / half * high / 2);
      paper.lineWidth = 1;
    });
  },
};

function line(paper, values, x, y) {
  paper.beginPath();
  values.forEach(([at, one], k) => { if (k) paper.lineTo(x(at), y(one)); else paper.moveTo(x(at), y(one)); });
  paper.stroke();
}

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
