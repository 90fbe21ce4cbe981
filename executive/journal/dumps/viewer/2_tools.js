// Small tools: elements, canvases, colours. Text only ever becomes text: never markup.

const $ = (id) => document.getElementById(id);

/** An element; `options` are its properties, `on...` among them its listeners. */
function el(tag, options = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(options)) {
    if (key === "class") element.className = value;
    else if (key.startsWith("aria-") || key === "role") element.setAttribute(key, value);
    else element[key] = value;
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** Sizes in CSS pixels of what is drawn into, kept by an observer: asking costs a layout. */
const sizes = {};
function measureAll() {
  for (const id of ["overview", "lane", "bars", "map", "scroller"]) sizes[id] = [$(id).clientWidth, $(id).clientHeight];
}
const heights = new Map();
function setHeight(id, height) {
  if (heights.get(id) === height) return;
  heights.set(id, height);
  $(id).style.height = `${height}px`;
}

/** The canvas's context, cleared, in CSS pixels; with its size. */
function fresh(canvas, tall = sizes[canvas.id][1]) {
  const ratio = window.devicePixelRatio || 1, width = sizes[canvas.id][0];
  const [w, h] = [Math.round(width * ratio), Math.round(tall * ratio)];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, tall);
  return { pen, width, height: tall };
}

let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  const names = ["ground", "panel", "line", "text", "dim", "accent", "now", "select", "hover",
    "waiting", "running", "done", "failed", "stopped", "warn", "room", "furniture", "way"];
  colours = Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  hatches.clear();
}

/** Failed is hatched and stopped is dotted, so that no hue is needed to tell them. */
const hatches = new Map();
function hatch(pen, state) {
  if (!hatches.has(state)) {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 6;
    const t = tile.getContext("2d");
    t.strokeStyle = t.fillStyle = colours[state];
    t.lineWidth = 1.4;
    if (state === "failed") {
      t.beginPath(); t.moveTo(-1, 7); t.lineTo(7, -1); t.moveTo(-4, 4); t.lineTo(4, -4);
      t.moveTo(2, 10); t.lineTo(10, 2); t.stroke();
    } else { t.fillRect(1, 1, 2, 2); t.fillRect(4, 4, 2, 2); }
    hatches.set(state, pen.createPattern(tile, "repeat"));
  }
  return hatches.get(state);
}

/** The first letters of a text, and a sign that there are more; no letter is cut in half. */
const begun = (text, count) => `${text.slice(0, count).replace(/[\uD800-\uDBFF]$/, "")}…`;
/** Text cut to a width. */
function fitted(pen, text, width) {
  if (pen.measureText(text).width <= width) return text;
  let low = 0, high = text.length;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (pen.measureText(begun(text, middle)).width <= width) low = middle; else high = middle - 1;
  }
  return low > 2 ? begun(text, low) : "";
}

function showTip(event, text) {
  const tip = $("tip");
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const box = tip.getBoundingClientRect();
  tip.style.left = `${Math.min(event.clientX + 12, innerWidth - box.width - 8)}px`;
  tip.style.top = `${Math.min(event.clientY + 14, innerHeight - box.height - 8)}px`;
}

/** A list of which only the rows in sight exist. */
class LongList {
  constructor(scroller, holder, height, draw) {
    Object.assign(this, { scroller, holder, height, draw, items: [], offset: 0 });
  }
  set(items) {
    this.items = items;
    this.holder.style.height = `${items.length * this.height}px`;
    this.render();
  }
  render() {
    const top = Math.max(0, this.scroller.scrollTop - this.holder.offsetTop);
    const first = Math.max(0, Math.floor(top / this.height) - 4);
    const count = Math.ceil(this.scroller.clientHeight / this.height) + 8;
    const rows = this.items.slice(first, first + count).map((item, i) => {
      const row = this.draw(item);
      row.style.top = `${(first + i) * this.height}px`;
      return row;
    });
    this.holder.replaceChildren(...rows);
  }
  reveal(index) {
    const y = this.holder.offsetTop + index * this.height, view = this.scroller.clientHeight;
    const top = this.scroller.scrollTop;
    if (y < top + 40 || y > top + view - 60) this.scroller.scrollTop = y - view / 2;
  }
}
