// Above the rows: the whole run at a glance, the axis, what happened, health, and the body's mode.

const LANE = 22, MARK = 14;
const EVENTS = new Map(Object.entries({
  failure: ["✗", "failed"], fault: ["⚡", "warn"], recovery: ["↻", "running"], said: ["“", "accent"],
  hold: ["‖", "warn"], pause: ["‖", "accent"], resume: ["▸", "accent"], stop: ["■", "stopped"],
  cancel: ["■", "stopped"], abort: ["■", "failed"], help: ["?", "warn"], answer: ["!", "accent"],
  outcome: ["●", "text"], job: ["◆", "dim"],
}));
const MODES = new Map([["walk", "running"], ["fallen", "failed"], ["damping", "failed"]]);
const marked = list(run.log).filter((line) => EVENTS.has(line[1]));
const LEVELS = ["OK", "WARN", "DERATE", "RETURN", "HOLD", "SIT", "DAMP"];

/** Health over time: [begin, end, worst level, causes]. */
const healthBands = (() => {
  const bands = [], changes = list(run.health), times = [...new Set(changes.map((c) => c[0]))];
  times.forEach((t, i) => {
    const wrong = healthAt(t);
    if (!wrong.length) return;
    const worst = wrong.reduce((a, b) => (LEVELS.indexOf(b[2]) > LEVELS.indexOf(a[2]) ? b : a));
    bands.push([t, times[i + 1] ?? END, worst[2], wrong.map((f) => f[4] || f[1]).join("; ")]);
  });
  return bands;
})();
const modes = list(run.modes).map(([t, mode], i, all) => [t, all[i + 1]?.[0] ?? END, mode]);

function drawLanes() {
  const { pen, width, height } = fresh($("lane"));
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center";
  grid(pen, width, height);
  pen.fillStyle = colours.dim;
  for (const t of gridTimes(width)) {
    const text = axisText(t, width), w = pen.measureText(text).width + 6;
    const x = Math.min(Math.max(xOf(t, width), w / 2), width - w / 2);
    pen.fillStyle = colours.ground;
    pen.fillRect(x - w / 2, 2, w, 16);
    pen.fillStyle = colours.dim;
    pen.fillText(text, x, 15);
  }
  drawMarks(pen, width, LANE);
  drawBands(pen, width, 2 * LANE, healthBands, (level) => (LEVELS.indexOf(level) >= 3 ? "failed" : "warn"), (b) => `${b[2].toLowerCase()}: ${b[3]}`);
  drawBands(pen, width, 3 * LANE, modes, (mode) => MODES.get(mode) || "waiting", (b) => b[2]);
  nowLine(pen, width, height);
}

function axisText(t, width) {
  const step = axisStep(width);
  if (END < 600) return `${t.toFixed(step < 0.1 ? 2 : step < 1 ? 1 : 0)} s`;
  const text = clock(t);
  return step >= 1 ? text.replace(/\.\d+$/, "") : text;
}

function drawMarks(pen, width, top) {
  pen.font = "bold 13px system-ui, sans-serif";
  const first = lastBefore(marked, view.from - 1e-9) + 1, seen = marked.slice(first, lastBefore(marked, view.to) + 1);
  const failures = seen.filter((line) => line[1] === "failure");
  const taken = []; // one mark stands for all around it, which the tip tells; failures come first
  for (const line of [...failures, ...seen]) {
    const x = Math.min(Math.max(xOf(line[0], width), MARK / 2), width - MARK / 2);
    if (taken.some((other) => Math.abs(other - x) < MARK)) continue;
    taken.push(x);
    const [glyph, colour] = EVENTS.get(line[1]);
    pen.fillStyle = colours[colour];
    pen.fillText(glyph, x, top + 16);
  }
}

function drawBands(pen, width, top, bands, colour, text) {
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "left";
  const first = Math.max(0, lastBefore(bands, view.from));
  for (let i = first; i < bands.length && bands[i][0] <= view.to; i++) {
    const x0 = Math.max(0, xOf(bands[i][0], width)), x1 = Math.min(width, xOf(bands[i][1], width));
    if (x1 < 0) continue;
    const name = colour(bands[i][2]);
    pen.globalAlpha = 0.25;
    pen.fillStyle = name === "failed" ? hatch(pen, "failed") : colours[name];
    pen.fillRect(x0, top + 4, Math.max(1, x1 - x0), LANE - 8);
    pen.globalAlpha = 1;
    pen.fillStyle = colours[name];
    pen.fillRect(x0, top + 4, 2, LANE - 8);
    if (x1 - x0 > 30) {
      pen.fillStyle = colours.text;
      pen.fillText(fitted(pen, text(bands[i]), x1 - x0 - 8), x0 + 5, top + 15);
    }
  }
}

function laneTip(event) {
  const width = sizes.lane[0], t = tOf(event.offsetX, width), lane = Math.floor(event.offsetY / LANE);
  if (lane === 1) {
    const near = marked.filter((line) => Math.abs(xOf(line[0], width) - event.offsetX) < MARK);
    return near.slice(0, 6).map((line) => `${clock(line[0])}  ${line[2]}`).join("\n");
  }
  const bands = lane === 2 ? healthBands : lane === 3 ? modes : [];
  const band = bands[lastBefore(bands, t)];
  return band && t <= band[1] ? `${clock(band[0])} to ${clock(band[1])}: ${band[2]}${band[3] ? `\n${band[3]}` : ""}` : clock(t);
}

// --- the whole run -----------------------------------------------------------------------------

const busy = (() => { // how many leaves run, over 400 slices of the run
  const slices = new Float32Array(400), slice = (END - BEGIN) / 400;
  for (const node of order) {
    if (node.children.length || node.inner) continue;
    for (const [begin, end, state] of node.spans) {
      if (state !== "running") continue;
      const last = Math.min(399, Math.floor((end - BEGIN) / slice));
      for (let i = Math.max(0, Math.floor((begin - BEGIN) / slice)); i <= last; i++) slices[i] += 1;
    }
  }
  return slices;
})();

const most = busy.reduce((a, b) => Math.max(a, b), 1);
let selecting = null;
function drawOverview() {
  const { pen, width, height } = fresh($("overview"));
  const at = (t) => ((t - BEGIN) / (END - BEGIN)) * width;
  pen.fillStyle = colours.running;
  pen.globalAlpha = 0.55;
  pen.beginPath();
  busy.forEach((count, i) => {
    const tall = count ? 4 + (count / most) * 12 : 0;
    if (tall) pen.rect((i * width) / 400, height - 8 - tall, width / 400 + 0.5, tall);
  });
  pen.fill();
  pen.globalAlpha = 0.35;
  for (const [begin, end, level] of healthBands) {
    pen.fillStyle = LEVELS.indexOf(level) >= 3 ? colours.failed : colours.warn;
    pen.fillRect(at(begin), height - 5, Math.max(1, at(end) - at(begin)), 5);
  }
  pen.globalAlpha = 1;
  for (const trouble of troubles) cross(pen, Math.min(Math.max(at(trouble.t_s), 5), width - 5), 8);
  const [a, b] = selecting ? [Math.min(...selecting), Math.max(...selecting)] : [at(view.from), at(view.to)];
  pen.fillStyle = colours.dim;
  pen.globalAlpha = 0.16;
  pen.fillRect(0, 0, a, height);
  pen.fillRect(b, 0, width - b, height);
  pen.globalAlpha = 1;
  pen.strokeStyle = colours.accent;
  pen.lineWidth = 1;
  pen.strokeRect(a + 0.5, 0.5, Math.max(2, b - a - 1), height - 1);
  pen.fillStyle = colours.now;
  pen.fillRect(at(now) - 0.75, 0, 1.5, height);
}

function overviewInput() {
  const canvas = $("overview"), at = (x) => BEGIN + (x / sizes.overview[0]) * (END - BEGIN);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    selecting = [event.offsetX, event.offsetX];
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!selecting) return;
    selecting[1] = Math.min(Math.max(event.offsetX, 0), sizes.overview[0]);
    redraw();
  });
  canvas.addEventListener("pointerup", () => {
    if (!selecting) return;
    const [a, b] = [Math.min(...selecting), Math.max(...selecting)];
    selecting = null;
    if (b - a > 5) setView(at(a), at(b)); else setNow(at(a), { follow: true });
  });
  canvas.addEventListener("pointercancel", () => { selecting = null; redraw(); });
  canvas.addEventListener("dblclick", () => setView(BEGIN, END));
}
