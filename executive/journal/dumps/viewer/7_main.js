// Time, keys, and putting it all on the screen.

let now = END;
let selected = -1;
let printing = false;
let playing = 0;
let queued = false;

function redraw() {
  if (queued) return;
  queued = true;
  requestAnimationFrame(() => { queued = false; draw(); });
}
function draw() {
  layRows();
  drawOverview();
  drawLanes();
  drawRows();
  drawMap();
  drawPanel();
  $("clock").textContent = `${clock(now)} / ${clock(END)}`;
  $("slider").value = String(now);
  $("slider").setAttribute("aria-valuetext", clock(now));
}

/** Show the deepest node that is running. */
function follow() {
  reveal(order.findLast((node) => !node.inner && inView(node, now) && stateAt(node, now) === "running"));
}

function setNow(t, { follow: follow_ = false } = {}) {
  now = Math.min(Math.max(t, BEGIN), END);
  if (now < view.from || now > view.to) {
    const wide = view.to - view.from;
    setView(now - wide * (follow_ ? 0.5 : now < view.from ? 0.05 : 0.95), now + wide * (follow_ ? 0.5 : now < view.from ? 0.95 : 0.05));
  }
  if (follow_) follow();
  remember();
  redraw();
}

function select(id, { reveal: show = false } = {}) {
  selected = id;
  if (show) reveal(nodes.get(id));
  if (tab !== "node") openTab("node");
  remember();
  redraw();
}

/** Scroll to a node's row. */
function reveal(node) {
  if (!node) return;
  for (let up = nodes.get(node.parent); up; up = nodes.get(up.parent)) folded.delete(up.id);
  layRows();
  const index = rows.findIndex((row) => row.node.id === node.id), scroller = $("scroller");
  if (index < 0) return;
  const y = index * ROW;
  if (y < scroller.scrollTop || y > scroller.scrollTop + sizes.scroller[1] - 2 * ROW) {
    scroller.scrollTop = y - sizes.scroller[1] / 2;
  }
}

let remembering = 0;
/** The place in the run goes into the address, so that it can be passed on. */
function remember() {
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    const place = `#t=${now.toFixed(2)}${selected >= 0 ? `&node=${selected}` : ""}${tab !== "now" ? `&tab=${tab}` : ""}`;
    try { history.replaceState(null, "", place); } catch { /* some browsers forbid it for files */ }
  }, 300);
}
function recall() {
  const place = new URLSearchParams(location.hash.slice(1));
  const t = Number.parseFloat(place.get("t")), id = Number.parseInt(place.get("node"), 10);
  if (nodes.has(id)) selected = id;
  if (Object.hasOwn(TABS, place.get("tab") ?? "")) tab = place.get("tab");
  const [from, to] = [Number.parseFloat(place.get("from")), Number.parseFloat(place.get("to"))];
  if (to > from) Object.assign(view, { from: Math.max(from, BEGIN), to: Math.min(to, END) });
  if (Number.isFinite(t)) now = Math.min(Math.max(t, BEGIN), END);
}

function step(direction) {
  const index = lastBefore(stops, direction > 0 ? now + 1e-6 : now - 1e-6, (t) => t);
  setNow(stops[Math.min(stops.length - 1, Math.max(0, direction > 0 ? index + 1 : index))], { follow: true });
}
function failureStep(direction) {
  const times = troubles.map((trouble) => trouble.t_s);
  const found = direction > 0 ? times.find((t) => t > now + 1e-6) : times.findLast((t) => t < now - 1e-6);
  if (found !== undefined) setNow(found, { follow: true });
}

function play() {
  if (playing) { cancelAnimationFrame(playing); playing = 0; $("play").textContent = "▶"; return; }
  if (now >= END) now = BEGIN;
  $("play").textContent = "⏸";
  let last = performance.now();
  const frame = (stamp) => {
    const t = now + ((stamp - last) / 1000) * Number($("speed").value);
    last = stamp;
    playing = requestAnimationFrame(frame);
    setNow(t, { follow: true });
    if (t >= END) play();
  };
  playing = requestAnimationFrame(frame);
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  readColours();
  drawLegend();
  redraw();
}
const theme = () => document.documentElement.dataset.theme;

function drawLegend() {
  const names = { running: "running", done: "done", failed: "failed", stopped: "stopped from above" };
  $("legend").replaceChildren(...Object.entries(names).map(([state, text]) => {
    const canvas = el("canvas");
    const item = el("span", {}, canvas, text);
    canvas.width = 52; canvas.height = 24;
    const pen = canvas.getContext("2d");
    pen.scale(2, 2);
    bar(pen, state, 0, 0, 26, 12);
    return item;
  }), el("span", { textContent: "a bar: running, coloured by how it ended; a thin line: what it ended as" }));
}

const KEYS = [
  ["← →", "to the last or next change"], ["Shift ← →", "one second back or on"], [", .", "one tick (0.05 s) back or on"],
  ["[ ]", "previous or next failure"], ["Home End", "beginning, end"], ["Space", "play, pause"],
  ["+ − 0", "zoom in, out, the whole run"], ["Ctrl wheel", "zoom; Shift wheel or Shift drag: pan"],
  ["↑ ↓ Enter", "choose a node; collapse or expand it"], ["/", "filter by name"], ["i", "inner nodes"], ["t", "dark or light"], ["?", "this"],
];
function showKeys() {
  const close = el("button", { textContent: "close", onclick: () => $("keys").close() });
  $("keys").replaceChildren(el("table", {}, ...KEYS.map(([key, text]) => el("tr", {}, el("td", {}, el("kbd", { textContent: key })), el("td", { textContent: text })))), close);
  if (!$("keys").open) $("keys").showModal();
}
function choose(direction) {
  const index = rows.findIndex((row) => row.node.id === selected);
  const next = rows[Math.min(rows.length - 1, Math.max(0, index < 0 ? 0 : index + direction))];
  if (next) select(next.node.id, { reveal: true });
}

function onKey(event) {
  const field = event.target;
  if (field instanceof HTMLSelectElement || (field instanceof HTMLInputElement && field.type === "search")) {
    if (event.key === "Escape") field.blur();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
  if (event.key === " " && field instanceof HTMLButtonElement) return;
  if (event.key === "Enter" && field instanceof HTMLButtonElement) return;
  const sign = event.key === "ArrowRight" ? 1 : -1;
  const actions = {
    ArrowLeft: () => (event.shiftKey ? setNow(now - 1) : step(sign)), ArrowRight: () => (event.shiftKey ? setNow(now + 1) : step(sign)),
    ",": () => setNow(now - 0.05), ".": () => setNow(now + 0.05), "[": () => failureStep(-1), "]": () => failureStep(1),
    Home: () => setNow(BEGIN, { follow: true }), End: () => setNow(END, { follow: true }), " ": play,
    "+": () => zoom(0.6), "=": () => zoom(0.6), "-": () => zoom(1 / 0.6), 0: () => setView(BEGIN, END),
    ArrowUp: () => choose(-1), ArrowDown: () => choose(1), Enter: () => { if (rows.some((row) => row.node.id === selected && row.folds)) toggle(nodes.get(selected)); },
    "/": () => $("filter").focus(), i: () => { $("inner").checked = !$("inner").checked; redraw(); },
    t: () => setTheme(theme() === "dark" ? "light" : "dark"), "?": showKeys,
  };
  if (!Object.hasOwn(actions, event.key)) return;
  event.preventDefault();
  actions[event.key]();
}

const ENDED = new Set(["done", "failed", "cancelled"]);

function head() {
  const ending = list(run.endings).at(-1), badge = $("badge");
  const jobs = list(run.jobs).map((job) => list(job.states).at(-1)?.[1]), done = jobs.filter((state) => state === "done").length;
  const many = jobs.length > 1, well = many ? done === jobs.length : ending?.code === "done", over = jobs.every((state) => ENDED.has(state));
  const verdict = many ? `${well ? "✓ " : ""}${done} of ${jobs.length} jobs done` : !ending ? "no outcome yet" : ending.code === "done" ? "✓ done" : `✗ ${ending.code.replaceAll("_", " ")}`;
  badge.textContent = verdict;
  badge.classList.add(!ending || (many && !over) ? "open" : well ? "done" : "failed");
  if (ending?.cause) badge.title = ending.cause;
  const about = run.about || {}, facts = [page.began, about.robot, about.world, about.runtime, about.seed !== undefined ? `seed ${words(about.seed)}` : "", clock(END - BEGIN)];
  facts.push(`${order.length} nodes`);
  if (run.recoveries) facts.push(run.recoveries === 1 ? "1 recovery" : `${run.recoveries} recoveries`);
  if (run.left_out) facts.push(`a very long run: ${run.left_out} details are left out`);
  if (run.unreadable) facts.push(`${run.unreadable} unreadable lines`);
  if (run.cut) facts.push("cut off in its last line");
  $("facts").textContent = facts.filter(Boolean).join(" · ");
}

/** Dragging the border between names and time. */
function gripInput() {
  const grip = $("grip"), left = $("left");
  grip.addEventListener("pointerdown", (event) => grip.setPointerCapture(event.pointerId));
  grip.addEventListener("pointermove", (event) => {
    if (!grip.hasPointerCapture(event.pointerId)) return;
    const x = event.clientX - left.getBoundingClientRect().left;
    left.style.setProperty("--names", `${Math.max(90, Math.min(x, left.clientWidth - 150))}px`);
  });
}

function listen() {
  const clicks = {
    first: () => setNow(BEGIN, { follow: true }), last: () => setNow(END, { follow: true }), play, prior: () => failureStep(-1), next: () => failureStep(1),
    in: () => zoom(0.6), out: () => zoom(1 / 0.6), fit: () => setView(BEGIN, END), theme: () => setTheme(theme() === "dark" ? "light" : "dark"), help: showKeys,
    expand: () => { folded.clear(); redraw(); },
    collapse: () => { for (const row of rows) if (row.folds && row.depth > 0) folded.add(row.node.id); redraw(); },
  };
  for (const [id, action] of Object.entries(clicks)) $(id).addEventListener("click", action);
  $("slider").min = String(BEGIN);
  $("slider").max = String(END);
  $("slider").addEventListener("input", () => setNow(Number($("slider").value)));
  for (const id of ["filter", "state", "inner"]) $(id).addEventListener("input", () => { $("scroller").scrollTop = 0; redraw(); });
  $("scroller").addEventListener("scroll", () => drawRows());
  $("panel").addEventListener("scroll", () => long?.render());
  document.addEventListener("keydown", onKey);
  const resized = new ResizeObserver(() => { measureAll(); redraw(); });
  for (const id of ["scroller", "map", "bars", "overview", "lane"]) resized.observe($(id));
  addEventListener("hashchange", () => { recall(); drawTabs(); redraw(); });
  let before = "";
  addEventListener("beforeprint", () => { before = theme(); printing = true; measureAll(); drawPanel({ force: true }); setTheme("light"); draw(); });
  addEventListener("afterprint", () => { printing = false; measureAll(); openTab(tab); setTheme(before); });
  namesInput();
  gripInput();
  timeInput($("bars"), barTip);
  timeInput($("lane"), laneTip);
  overviewInput();
  mapInput();
}

$("lanenames").replaceChildren(...["time", "events", "health", "body"].map((text) => el("div", { textContent: text })));
recall();
head();
measureAll();
listen();
drawTabs();
setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
requestAnimationFrame(() => { if (now < END || !list(run.endings).length) follow(); redraw(); });
