// The rows: every node's name and state now, and its states over time beside it.

const ROW = 22;
const view = { from: BEGIN, to: END };
const folded = new Set();
let rows = [];

const xOf = (t, width) => ((t - view.from) / (view.to - view.from)) * width;
const tOf = (x, width) => view.from + (x / width) * (view.to - view.from);

function wanted(node, text, state) {
  if (text && !`${node.label} ${node.name} ${node.step}`.toLowerCase().includes(text)) return false;
  if (state === "now") return stateAt(node, now) === "running";
  if (state === "ran") return node.changes.length > 0;
  if (state === "waiting") return node.changes.every((change) => change[1] === "waiting");
  return !state || node.changes.some((change) => change[1] === state);
}

/** The rows to show: nodes that pass the filter, and, dimmed, those above them. */
function layRows() {
  const all = $("inner").checked, text = $("filter").value.trim().toLowerCase();
  const state = $("state").value, filtering = Boolean(text || state);
  const shown = order.filter((node) => all || !node.inner);
  const keep = new Map();
  if (filtering) {
    for (const node of shown) {
      if (!wanted(node, text, state)) continue;
      keep.set(node.id, true);
      for (let up = nodes.get(node.parent); up; up = nodes.get(up.parent)) {
        if (!keep.has(up.id)) keep.set(up.id, false);
      }
    }
  }
  const depths = new Map(), shut = new Set();
  rows = [];
  for (const node of order) {
    const above = depths.get(node.parent) ?? 0;
    const visible = all || !node.inner;
    depths.set(node.id, above + (visible ? 1 : 0));
    if (shut.has(node.parent)) { shut.add(node.id); continue; }
    if (!visible) continue;
    if (filtering && !keep.has(node.id)) continue;
    rows.push({ node, depth: above, aside: filtering && !keep.get(node.id) });
    if (folded.has(node.id) && !filtering) shut.add(node.id);
  }
  const parents = new Set();
  rows.forEach((row, i) => { if (rows[i + 1]?.depth > row.depth || folded.has(row.node.id)) parents.add(row.node.id); });
  for (const row of rows) row.folds = parents.has(row.node.id);
  setHeight("spacer", rows.length * ROW);
}

/** Elements of rows, used again and again: what has not changed is not touched. */
const pool = [];
function pooled(index) {
  while (pool.length <= index) {
    const parts = {
      fold: el("button", { class: "fold", tabIndex: -1, title: "collapse or expand" }),
      mark: el("span", { class: "mark" }), name: el("span", { class: "name" }), note: el("span", { class: "note" }),
    };
    const element = el("div", { role: "treeitem" }, parts.fold, parts.mark, parts.name, parts.note);
    pool.push({ element, key: "", top: null, node: null, ...parts });
    $("names").append(element);
  }
  return pool[index];
}

function drawName(slot, row, top) {
  const { node } = row, there = inView(node, now), state = there ? stateAt(node, now) : "waiting";
  const note = state === "running" || state === "failed" || state === "waiting" || node.kind === "recover" ? noteAt(node, now) : "";
  const shut = folded.has(node.id), chosen_ = node.id === selected;
  slot.node = node;
  if (slot.top !== top) { slot.top = top; slot.element.style.transform = `translateY(${top}px)`; }
  const key = [node.id, there, state, note, row.depth, row.folds, shut, row.aside, chosen_].join("|");
  if (slot.key === key) return;
  slot.key = key;
  slot.element.className = `row ${state}${there ? "" : " gone"}${row.aside ? " aside" : ""}${chosen_ ? " selected" : ""}`;
  slot.element.setAttribute("aria-level", row.depth + 1);
  slot.element.setAttribute("aria-selected", chosen_);
  slot.element.style.paddingLeft = `${4 + row.depth * 14}px`;
  slot.element.hidden = false;
  slot.fold.textContent = row.folds ? (shut ? "▸" : "▾") : "";
  slot.mark.textContent = there ? MARKS[state] : " ";
  slot.mark.title = there ? state : "not in the tree now";
  slot.name.textContent = node.label;
  slot.name.title = `${node.label} (${node.kind.replaceAll("_", " ")})`;
  slot.note.textContent = slot.note.title = note;
}

function namesInput() {
  const slotOf = (event) => pool.find((slot) => slot.element.contains(event.target));
  $("names").addEventListener("click", (event) => {
    const slot = slotOf(event);
    if (!slot) return;
    if (event.target === slot.fold && slot.fold.textContent) toggle(slot.node); else select(slot.node.id);
  });
  $("names").addEventListener("dblclick", (event) => { const slot = slotOf(event); if (slot) zoomTo(slot.node); });
}

function drawRows() {
  const scroller = $("scroller"), tall = printing ? Math.min(rows.length, 150) * ROW : sizes.scroller[1];
  const top = printing ? 0 : scroller.scrollTop;
  const first = Math.floor(top / ROW), last = Math.min(rows.length, Math.ceil((top + tall) / ROW));
  setHeight("window", tall);
  setHeight("bars", tall);
  const { pen, width } = fresh($("bars"), tall);
  grid(pen, width, tall);
  for (let i = first; i < last; i++) drawBars(pen, rows[i], i * ROW - top, width);
  nowLine(pen, width, tall);
  for (let i = first; i < last; i++) drawName(pooled(i - first), rows[i], i * ROW - top);
  for (let i = Math.max(0, last - first); i < pool.length; i++) {
    if (!pool[i].element.hidden) { pool[i].element.hidden = true; pool[i].key = ""; }
  }
}

function drawBars(pen, row, y, width) {
  const { node } = row;
  if (node.id === selected) { pen.fillStyle = colours.select; pen.fillRect(0, y, width, ROW); }
  pen.fillStyle = colours.line;
  pen.globalAlpha = 0.6;
  pen.fillRect(0, y + ROW - 0.5, width, 0.5);
  pen.globalAlpha = row.aside ? 0.35 : 1;
  const from = Math.max(0, lastBefore(node.spans, view.from) - 1);
  let drawn = -1;
  for (let i = from; i < node.spans.length; i++) {
    const [begin, end, state] = node.spans[i];
    if (begin > view.to) break;
    const x0 = xOf(begin, width), x1 = xOf(end, width);
    if (x1 < 0) continue;
    if (state === "running") {
      const how = endOf(node, i), wide = Math.max(x1 - x0, 2);
      if (x0 + wide <= drawn && how !== "failed") continue; // too small to be seen beside its neighbour
      bar(pen, how, x0, y + 4, wide, ROW - 8);
      drawn = x0 + wide;
      if (x1 - x0 > 30) label(pen, node, begin, end, width, y, how);
      if (how === "failed") cross(pen, x1, y + ROW / 2);
      else if (how === "running" && !list(run.endings).length) arrow(pen, x1, y + ROW / 2);
    } else {
      const before = node.spans[i - 1];
      const instant = !before || before[1] < begin - 1e-9 || before[2] !== "running";
      if (instant && x0 >= -3) tick(pen, state, x0, y);
      pen.globalAlpha *= 0.55;
      pen.fillStyle = colours[state];
      pen.fillRect(Math.max(0, x0), y + ROW / 2 - 0.75, Math.min(x1, width) - Math.max(0, x0), 1.5);
      pen.globalAlpha /= 0.55;
    }
  }
  pen.globalAlpha = 1;
}

/** A bar; failed and stopped ones are light and hatched, so that text can be read on them. */
function bar(pen, state, x, y, width, height) {
  const light = state === "failed" || state === "stopped";
  const alpha = pen.globalAlpha;
  pen.fillStyle = colours[state];
  if (!light) { pen.fillRect(x, y, width, height); return; }
  pen.globalAlpha = alpha * 0.16;
  pen.fillRect(x, y, width, height);
  pen.globalAlpha = alpha * 0.45;
  pen.fillStyle = hatch(pen, state);
  pen.fillRect(x, y, width, height);
  pen.globalAlpha = alpha;
  pen.strokeStyle = colours[state];
  pen.lineWidth = 1;
  if (width > 3) pen.strokeRect(x + 0.5, y + 0.5, width - 1, height - 1);
  else { pen.fillStyle = colours[state]; pen.fillRect(x, y, width, height); }
}

/** What a node says of itself inside its bar, phase by phase, as far as there is room. */
function label(pen, node, begin, end, width, y, how) {
  pen.font = "11px system-ui, sans-serif";
  const light = how === "failed" || how === "stopped";
  const ink = light ? colours.text : theme() === "dark" ? "#0c1118" : "#ffffff";
  let i = lastBefore(node.changes, begin);
  let t = begin;
  while (t < end - 1e-9) {
    const next = node.changes[i + 1], until = Math.min(next ? next[0] : end, end);
    const x0 = Math.max(xOf(t, width), 0), x1 = Math.min(xOf(until, width), width);
    pen.fillStyle = light ? colours[how] : colours.ground;
    if (t > begin && x0 > 0) pen.fillRect(x0, y + 4, 1, ROW - 8);
    if (x1 - x0 > 34) {
      pen.fillStyle = ink;
      pen.fillText(fitted(pen, node.changes[i]?.[2] || node.label, x1 - x0 - 8), x0 + 4, y + ROW / 2 + 4);
    }
    if (x0 > width) break;
    t = until;
    i += 1;
  }
}

function tick(pen, state, x, y) {
  pen.fillStyle = colours[state];
  if (state === "failed") { cross(pen, x, y + ROW / 2); return; }
  pen.beginPath();
  pen.moveTo(x, y + 5); pen.lineTo(x + 4, y + ROW / 2); pen.lineTo(x, y + ROW - 5); pen.lineTo(x - 4, y + ROW / 2);
  pen.fill();
}

function cross(pen, x, y) {
  for (const [colour, width] of [[colours.ground, 5], [colours.failed, 2.4]]) {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.beginPath();
    pen.moveTo(x - 4, y - 4); pen.lineTo(x + 4, y + 4); pen.moveTo(x + 4, y - 4); pen.lineTo(x - 4, y + 4);
    pen.stroke();
  }
}

function arrow(pen, x, y) {
  pen.fillStyle = colours.running;
  pen.beginPath(); pen.moveTo(x - 1, y - 8); pen.lineTo(x + 7, y); pen.lineTo(x - 1, y + 8); pen.fill();
}

/** A step of the axis: 1, 2 or 5 times a power of ten seconds, or round minutes. */
function axisStep(width) {
  const least = ((view.to - view.from) / Math.max(width, 1)) * 70;
  const steps = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21600];
  return steps.find((step) => step >= least) || steps[steps.length - 1] * Math.ceil(least / 21600);
}

function* gridTimes(width) {
  const step = axisStep(width);
  for (let k = Math.ceil(view.from / step); k * step <= view.to; k++) yield k * step;
}

function grid(pen, width, height) {
  pen.fillStyle = colours.line;
  pen.globalAlpha = 0.7;
  for (const t of gridTimes(width)) pen.fillRect(Math.round(xOf(t, width)), 0, 1, height);
  pen.globalAlpha = 1;
}

function nowLine(pen, width, height) {
  const x = xOf(now, width);
  pen.fillStyle = colours.now;
  pen.fillRect(x - 0.75, 0, 1.5, height);
}

// --- zoom --------------------------------------------------------------------------------------

function setView(from, to) {
  const least = 0.5, wide = Math.min(Math.max(to - from, least), END - BEGIN);
  const begin = Math.min(Math.max(from, BEGIN), END - wide);
  view.from = begin;
  view.to = begin + wide;
  redraw();
}
function zoom(factor, around = now) {
  const inside = around >= view.from && around <= view.to ? around : (view.from + view.to) / 2;
  setView(inside - (inside - view.from) * factor, inside + (view.to - inside) * factor);
}
function zoomTo(node) {
  const ran = node.spans.filter((entry) => entry[2] === "running");
  if (!ran.length) return;
  const from = ran[0][0], to = ran[ran.length - 1][1], margin = 0.05 * (to - from) + 0.2;
  setView(from - margin, to + margin);
}
function toggle(node) {
  if (folded.has(node.id)) folded.delete(node.id); else folded.add(node.id);
  redraw();
}

/** Pointer and wheel on a canvas whose x is time. */
function timeInput(canvas, tip) {
  let dragging = "";
  let last = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    dragging = event.shiftKey || event.button === 1 ? "pan" : "scrub";
    last = event.offsetX;
    if (dragging === "scrub") setNow(tOf(event.offsetX, sizes[canvas.id][0]));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (dragging === "scrub") setNow(tOf(event.offsetX, sizes[canvas.id][0]));
    if (dragging === "pan") {
      const shift = tOf(last, sizes[canvas.id][0]) - tOf(event.offsetX, sizes[canvas.id][0]);
      last = event.offsetX;
      setView(view.from + shift, view.to + shift);
    }
    showTip(event, dragging ? "" : tip(event));
  });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, () => { dragging = ""; });
  canvas.addEventListener("pointerleave", (event) => showTip(event, ""));
  canvas.addEventListener("wheel", (event) => {
    const sideways = Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey;
    if (event.ctrlKey || event.metaKey || event.altKey) {
      zoom(Math.exp(event.deltaY * 0.002), tOf(event.offsetX, sizes[canvas.id][0]));
    } else if (sideways) {
      const shift = ((event.deltaX || event.deltaY) / sizes[canvas.id][0]) * (view.to - view.from);
      setView(view.from + shift, view.to + shift);
    } else return;
    event.preventDefault();
  }, { passive: false });
}

function barTip(event) {
  const row = rows[Math.floor((event.offsetY + $("scroller").scrollTop) / ROW)];
  if (!row) return "";
  const t = tOf(event.offsetX, sizes.bars[0]);
  const index = lastBefore(row.node.spans, t), found = row.node.spans[index];
  const note = noteAt(row.node, t);
  let text = `${row.node.label}\n${clock(t)}: ${stateAt(row.node, t)}`;
  if (note) text += `, ${note}`;
  if (found && found[2] === "running") text += `\n${clock(found[0])} to ${clock(found[1])}, ${span(found[1] - found[0])}`;
  return text;
}
