"use strict";
// The run as data, and what can be asked of it. Arrays are those of executive/journal/run.py.

const page = JSON.parse(document.getElementById("data").textContent);
const run = page.run;
const BEGIN = run.begin_s || 0;
const END = Math.max(run.end_s || 0, BEGIN + 0.05);
const MARKS = { waiting: "·", running: "▸", done: "✓", failed: "✗", stopped: "■" };
const list = (value) => value || [];

/** Index of the last entry whose time is not later than t, or -1; `when` gives an entry's time. */
function lastBefore(entries, t, when = (entry) => entry[0]) {
  let low = 0, high = entries.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (when(entries[middle]) <= t) low = middle + 1; else high = middle;
  }
  return low - 1;
}

const nodes = new Map();
for (const [key, raw] of Object.entries(run.nodes || {})) {
  nodes.set(Number(key), {
    id: Number(key), parent: raw.parent, kind: raw.kind, name: raw.name,
    label: raw.title || raw.name, step: raw.step || "", born: raw.born_s || 0,
    gone: raw.gone_s ?? null, hidden: raw.hidden_s ?? Infinity,
    children: list(raw.children), changes: list(raw.changes), inner: false, spans: [],
  });
}
for (const id of list(page.inner)) nodes.get(id).inner = true;

/** State spans [begin, end, state] other than waiting; neighbours of one state are one span. */
function spansOf(node) {
  const spans = [], stop = node.gone ?? END;
  node.changes.forEach(([begin, state], index) => {
    const end = index + 1 < node.changes.length ? node.changes[index + 1][0] : stop;
    const last = spans[spans.length - 1];
    if (last && last[2] === state) last[1] = end;
    else spans.push([begin, end, state]);
  });
  return spans.filter((span) => span[2] !== "waiting");
}
for (const node of nodes.values()) node.spans = spansOf(node);

function changeAt(node, t) {
  const index = lastBefore(node.changes, t);
  return index < 0 ? [node.born, "waiting"] : node.changes[index];
}
const stateAt = (node, t) => changeAt(node, t)[1];
const noteAt = (node, t) => changeAt(node, t)[2] || "";
const inView = (node, t) => node.born <= t && t < node.hidden;

/** How a span of running ended: the state of the span that follows at once. */
function endOf(node, index) {
  const next = node.spans[index + 1];
  if (next && next[0] <= node.spans[index][1] + 1e-9) return next[2];
  return "running";
}

/** Every node in reading order. */
const order = [];
(function walk() {
  const stack = list(run.roots).slice().reverse();
  while (stack.length) {
    const node = nodes.get(stack.pop());
    order.push(node);
    for (let i = node.children.length - 1; i >= 0; i--) stack.push(node.children[i]);
  }
})();

const troubles = list(run.troubles);
const poses = list(run.path);
const plan = run.plan || null;
const WAY = poses.map((pose, i) => { // the pelvis sways with every step: the way is its mean
  const near = poses.slice(Math.max(0, i - 2), i + 3);
  const mean = (k) => near.reduce((sum, p) => sum + p[k], 0) / near.length;
  return [pose[0], mean(1), mean(2)];
});

/** The blackboard at t: key to [value, since when]. */
function boardAt(t) {
  const board = new Map();
  for (const [when, key, value] of list(run.board)) {
    if (when > t) break;
    board.set(key, [value, when]);
  }
  return board;
}

/** What is wrong at t: findings that are not OK. */
function healthAt(t) {
  const found = new Map();
  for (const finding of list(run.health)) {
    if (finding[0] > t) break;
    if (finding[2] === "OK") found.delete(finding[1]); else found.set(finding[1], finding);
  }
  return [...found.values()];
}

/** Times at which something changes, for stepping. */
const stops = (() => {
  const times = new Set([BEGIN, END]);
  for (const node of order) if (!node.inner) for (const change of node.changes) times.add(change[0]);
  for (const line of list(run.log)) times.add(line[0]);
  return [...times].sort((a, b) => a - b);
})();

/** A time for people. */
function clock(t) {
  if (END < 600) return `${t.toFixed(2)} s`;
  const total = Math.max(0, t), h = Math.floor(total / 3600), m = Math.floor((total % 3600) / 60);
  const s = (total % 60).toFixed(1).padStart(4, "0");
  return h || END >= 3600 ? `${h}:${String(m).padStart(2, "0")}:${s}` : `${m}:${s}`;
}
const span = (seconds) => (seconds < 100 ? `${seconds.toFixed(2)} s` : `${seconds.toFixed(0)} s`);

/** A number as fine as anything that is measured here: a millimetre, a millisecond, a milliradian. */
function number(value) {
  const fine = Math.abs(value) < 1000 ? 3 : 0;
  return Number.isFinite(value) ? String(Number(value.toFixed(fine)) + 0) : String(value);
}
/** As `-0.00` of a fixed number of decimals never looks. */
const fixed = (value, decimals) => value.toFixed(decimals).replace(/^-(?=[0.]*$)/, "");

const UNITS = { m: "m", s: "s", rad: "rad", c: "°C", hz: "Hz", n: "N", nm: "N m", kg: "kg", w: "W", v: "V" };
/** A measurement in words: `gap_m` and 0.1234 are "gap 0.123 m". */
function measured(name, value) {
  const [, what, unit] = /^(.+)_([a-z]+)$/.exec(name) || [null, name, ""];
  const known = typeof value === "number" && Object.hasOwn(UNITS, unit);
  return known ? `${what.replaceAll("_", " ")} ${number(value)} ${UNITS[unit]}` : `${name.replaceAll("_", " ")} ${words(value)}`;
}

function words(value) {
  if (typeof value === "string") return value;
  if (typeof value === "number") return number(value);
  if (value && typeof value === "object" && !Array.isArray(value)) {
    const pairs = Object.entries(value).map(([key, item]) => `${key}: ${words(item)}`);
    return pairs.length ? pairs.join(", ") : "nothing";
  }
  if (value === null) return "none";
  return Array.isArray(value) ? value.map(words).join(", ") : String(value);
}
