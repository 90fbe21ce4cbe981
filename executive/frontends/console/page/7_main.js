// Puts it together: what comes from the server, what a person does, and a picture when one of them is new.

const motion = new Motion(), truth = new Motion(), sensing = new Sensing();
const parts = { head: {}, tree: [], said: [], health: [], jobs: [], troubles: [], left_out: "" };
const page = {
  scene: null, resting: [], live: null, steers: false, linked: false, now: true, t: 0, playing: false, dirty: true,
  follow: true, names: true, answers: [], then: null, asks: null, drawn: 0, framesMs: [], problem: "", shown: "", over: false,
  zone_m: 0,
};
const camera = { at: [0, 0, 0.7], distance: 4.5, heading: -2.2, down: 0.42, fovy: 0.75, eye: [0, 0, 0] };
let drawing = null, link = null, trail = 0;

try { drawing = new Drawing($("view")); plans.marks = new Marks(drawing); } catch (error) { page.problem = error.message; }

// --- what comes ---

function taken(news) {
  if ("show" in news) begin(news);
  if (news.steers !== undefined) { page.steers = news.steers; panels.steering(); }
  if (news.scene) haveScene(news.scene);
  if (news.latest) { motion.latest = { base: news.latest.base, q: news.latest.q }; page.dirty = true; }
  for (const moment of news.moments || []) motion.add(moment);
  for (const moment of news.truth || []) truth.add({ q: [], ...moment });
  for (const line of news.sensed || []) sensing.add(line);
  if (news.sensed) { page.dirty = true; panels.soon("sensed"); }
  if (news.shot) camera_.have(news.shot);
  if (news.moments) { page.dirty = true; page.told = performance.now(); }
  if (news.live !== undefined) { page.over = page.live === true && !news.live; page.live = news.live; page.dirty = true; panels.all(); }
  for (const key of Object.keys(parts)) if (key in news) { parts[key] = news[key]; panels.soon(key); }
  if (news.then && !page.now) { page.then = news.then; panels.all(); }
  if (news.word && news.word.out !== undefined) clearTimeout(page.unanswered);
  if (news.word) panels.answer(news.word);
  if (news.asks !== undefined) { page.asks = news.asks; panels.asking(); }
}

function begin(news) {
  motion.clear();
  truth.clear();
  sensing.clear();
  camera_.clear();
  if (plans.marks) plans.marks.clear();
  Object.assign(plans, { lidarOf: null, armOf: null });
  page.zone_m = news.zone_m || 0;
  faults.forms = news.faults || [];
  Object.assign(page, { scene: null, live: null, now: true, then: null, shown: news.show, asks: null, over: false, playing: false, answers: [] });
  Object.assign(parts, { head: {}, tree: [], said: [], health: [], jobs: [], troubles: [], left_out: "" });
  trail = 0;
  camera_.ask();
  if (drawing) { drawing.things = []; drawing.way([]); }
  $("nothing").hidden = false;
  $("nothing").textContent = page.problem || (news.show ? "Making the picture ..." : "Waiting for a robot: start one with `humanoid` in another terminal.");
  panels.all();
}

function haveScene(scene) {
  if (scene.problem) { page.problem = `No picture: ${scene.problem}`; $("nothing").textContent = page.problem; return; }
  if (!drawing) { $("nothing").textContent = page.problem; return; }
  page.scene = scene;
  page.resting = scene.bodies.map((body) => matrixOf(body.X_PB));
  drawing.show(scene);
  faults.build();
  motors.rows = [];
  const base = scene.bodies[scene.base].X_PB;
  camera.at = [base[0], base[1], 0.75];
  const narrow = $("view").clientWidth < 600;
  camera.distance = narrow ? 5.0 : 4.2;
  $("nothing").hidden = true;
  page.dirty = true;
}

// --- time ---

const when = () => (page.now ? motion.end : page.t);

function goTo(t) {
  page.t = Math.max(motion.begin, Math.min(motion.end, t));
  page.now = page.live && page.t >= motion.end - 0.06 && !page.playing;
  page.dirty = true;
  if (page.now) { page.then = null; link.send({ at: null }); } else askThen();
  if (plans.marks) plans.marks.set("cloud", []); // of another time
  panels.all();
}

let asked = 0, askLater = null;
function askThen() { // a few times a second, whatever the slider does
  clearTimeout(askLater);
  const wait = 120 - (performance.now() - asked);
  if (wait > 0) { askLater = setTimeout(askThen, wait); return; }
  asked = performance.now();
  if (!page.now) link.send({ at: page.t });
}

function play(on) {
  page.playing = on;
  if (on) {
    if (page.now || page.t >= motion.end - 0.1) page.t = page.live ? Math.max(motion.begin, motion.end - 10) : motion.begin;
    page.now = false;
  }
  page.dirty = true;
  panels.time();
}

// How a run ended, as a part of a sentence; empty where that is not known.
const ended = ({ ending, phase }) => !ending || phase !== "done" ? "" : `, and nothing moves any more: ${ending.code === "done" ? "it was done" : ending.cause || ending.code}`;

const ESTOP = "emergency stop"; // as health calls it
// --- panels, at most a few times a second ---

const panels = {
  waiting: new Set(), timer: null,
  soon(key) {
    this.waiting.add(key);
    if (!this.timer) this.timer = setTimeout(() => { this.timer = null; this.draw(); }, 60);
  },
  all() { for (const key of Object.keys(parts)) this.soon(key); this.soon("time"); },
  draw() {
    const told = page.now || !page.then ? parts : { ...parts, ...page.then }, keys = this.waiting;
    this.waiting = new Set();
    if (keys.has("tree")) showTree(told.tree);
    if (keys.has("said")) showTalk([...told.said, ...page.answers.filter(([t]) => page.now || t <= when())]);
    if (keys.has("health") || keys.has("troubles") || keys.has("head")) showHealth(told.health, told.troubles, told.head, motion, motion.at(when()));
    if (keys.has("sensed") || keys.has("time")) motors.draw();
    if (keys.has("jobs")) showJobs(told.jobs);
    this.head(told);
    this.time();
  },
  head(told) {
    const { head } = told;
    let [kind, word] = standing(head, page.live, page.linked, told.jobs, told !== parts);
    if (told.health.some(([, name]) => name === ESTOP)) [kind, word] = ["failed", "emergency stop"];
    $("badge").className = `badge ${kind}`;
    $("badge").textContent = word;
    const goal = head.goal || (told.jobs.length ? told.jobs[told.jobs.length - 1][1] : head.text) || "Humanoid console";
    $("title").textContent = goal === "prompt" ? "Ready for orders" : goal;
    document.title = `${word}: ${$("title").textContent}`;
    $("phase").textContent = head.phase && head.phase !== "done" ? head.phase : "";
    const about = head.about || {};
    $("facts").textContent = [about.robot && `${about.robot} in ${about.world}`, about.runtime, motion.charge != null && `battery ${Math.round(100 * motion.charge)} %`, told.left_out && `not shown: ${told.left_out}`].filter(Boolean).join("  ·  ");
    this.banner(head);
    this.steering();
    page.dirty = true;
  },
  banner(head) {
    const banner = $("banner");
    let text = "", kind = "";
    if (link && link.refused) text = "This address is no longer valid: open the one that the terminal shows.";
    else if (!page.linked && page.live === false) [text, kind] = [`The run is over${ended(head)}. Its page is no longer served: \`humanoid console\` in a terminal opens it again.`, "over"];
    else if (!page.linked) text = "No connection to the robot's computer: STOP does not reach it from here. Use Ctrl-C in its terminal. Trying again ...";
    else if (head.help && page.live) [text, kind] = [`The robot asks for help: ${head.help}`, "calm"];
    else if (page.live === false && head.ending && head.ending.code !== "done") {
      const { cause, suggestion } = head.ending;
      [text, kind] = [`${cause || head.ending.code}${suggestion ? `. What to do: ${suggestion}` : ""}`, "over"];
    } else if (page.over) [text, kind] = ["The run is over. Look through it with the slider below.", "over"];
    banner.hidden = !text;
    banner.className = kind;
    banner.textContent = text;
  },
  steering() {
    const on = page.steers && page.linked && page.live;
    document.body.classList.toggle("steers", Boolean(page.steers && page.live));
    $("stop").hidden = !(page.steers && page.live);
    for (const id of ["order", "steer", "tab-faults"]) $(id).hidden = !on;
    if (!on && !$("faults").hidden) showTab("talk");
    const latched = parts.health.some(([, name]) => name === ESTOP);
    for (const button of document.querySelectorAll("[data-do=release], [data-do=reset]")) button.hidden = !latched;
  },
  asking() {
    const box = $("ask");
    box.hidden = !(page.asks && page.live);
    if (box.hidden) return;
    const choices = element("div");
    for (const choice of page.asks.choices) {
      const button = element("button", "", choice);
      button.type = "button";
      button.onclick = () => order(choice);
      choices.append(button);
    }
    box.replaceChildren(element("p", "", page.asks.question), choices);
  },
  answer({ out, you, t_s = motion.end }) {
    page.answers.push([t_s, you === undefined ? "answer" : "you", you === undefined ? out : you, ""]);
    page.answers = page.answers.slice(-200);
    this.soon("said");
  },
  time() {
    const t = when(), slider = $("slider");
    slider.min = motion.begin; slider.max = Math.max(motion.end, 0.1);
    if (document.activeElement !== slider || page.now || page.playing) slider.value = t;
    $("clock").textContent = `${seconds(t)} / ${seconds(motion.end)}`;
    $("play").textContent = page.playing ? "❚❚" : "▶";
    $("now").hidden = page.live === false;
    $("now").setAttribute("aria-pressed", page.now);
    document.body.classList.toggle("then", Boolean(page.live && !page.now));
    $("belief").textContent = page.live && !page.now ? `This was ${(motion.end - t).toFixed(0)} s ago` : "As the robot believes it to be";
  },
};

// --- the picture ---

function place(label, x, y, boxes, taken) {
  const [w, h] = [label.offsetWidth, label.offsetHeight];
  const box = [x - w / 2, y - h, x + w / 2, y];
  if (taken && boxes.some((b) => box[0] < b[2] && box[2] > b[0] && box[1] < b[3] && box[3] > b[1])) { label.hidden = true; return; }
  boxes.push(box);
  label.style.transform = `translate(${Math.round(box[0])}px, ${Math.round(box[1])}px)`;
}

const labels = new Map();
function label(key, text, className) {
  if (!labels.has(key)) { const made = element("span"); labels.set(key, made); $("labels").append(made); }
  const made = labels.get(key);
  if (made.textContent !== text) made.textContent = text;
  if (made.className !== className) made.className = className;
  made.hidden = false;
  made.used = true;
  return made;
}

function drawLabels(view, matrices, t) {
  const { clientWidth: w, clientHeight: h } = $("view"), boxes = [], held = new Set(motion.heldAt(t));
  for (const one of labels.values()) one.used = false;
  const onScreen = (p) => { const q = apply(view, p); return q[3] > 0.1 ? [(q[0] + 1) / 2 * w, (1 - q[1]) / 2 * h, q[3]] : null; };
  const base = matrices[page.scene.base];
  const words = saying(t);
  if (words) {
    const at = onScreen([base[12], base[13], base[14] + 0.85]);
    if (at) place(label("says", words, "says"), Math.max(90, Math.min(w - 90, at[0])), Math.max(60, at[1]), boxes, false);
  }
  if (page.names) page.scene.bodies.forEach((body, k) => {
    const m = matrices[k];
    if (!m || !["object", "person", "furniture"].includes(body.role) || !body.name) return;
    const up = body.role === "object" ? 0.13 : body.role === "person" ? 1.85 : 0;
    if (body.role === "furniture" && camera.distance > 9) return;
    const top = body.role === "furniture" ? topOf(body, k) : m[14] + up;
    const at = onScreen([m[12], m[13], top]);
    if (at && at[2] < 14 && at[0] > 0 && at[0] < w && at[1] > 0 && at[1] < h) place(label(k, body.name, held.has(body.id) ? "held" : ""), at[0], at[1], boxes, true);
  });
  for (const one of labels.values()) one.hidden = one.hidden || !one.used;
}

const tops = new Map();
function topOf(body, k) {
  if (!tops.has(body)) tops.set(body, Math.max(...body.geoms.map((geom) => geom.X_BG[2] + geom.size_m[2])));
  return page.resting[k][14] + tops.get(body) + 0.03;
}

function saying(t) {
  const lines = (page.now || !page.then ? parts : page.then).said || [];
  for (let k = lines.length - 1; k >= 0; k--) {
    const [at, kind, text] = lines[k];
    if (at < t - 5) return "";
    if (kind === "said" && at <= t + 0.1) return text.replace(/^says: /, "");
  }
  return "";
}

function look() {
  const { at, distance, heading, down } = camera;
  camera.eye = [at[0] + distance * Math.cos(down) * Math.cos(heading), at[1] + distance * Math.cos(down) * Math.sin(heading), Math.max(0.08, at[2] + distance * Math.sin(down))];
}

function drawTrail(t) {
  const k = before(motion.times, t);
  if (Math.abs(k - trail) < 4 && k >= trail) return;
  trail = k;
  const points = [];
  let [x, y] = [0, 0];
  for (let i = 0; i <= k; i++) { // the body sways from foot to foot: the way is what is left of that
    const base = motion.bases[i], last = points[points.length - 1], part = i ? 0.06 : 1;
    x += part * (base[0] - x);
    y += part * (base[1] - y);
    if (!last || Math.hypot(x - last[0], y - last[1]) > 0.06) points.push([x, y]);
  }
  drawing.way(points.slice(-3000));
}

const SLOW_MS = 120; // where the processor draws, which the robot may need on the same machine
let last = performance.now();
function frame(ms) {
  const dt = Math.min(0.25, (ms - last) / 1000);
  last = ms;
  if (page.playing) {
    page.t += dt * Number($("speed").value);
    if (page.t >= motion.end) { page.t = motion.end; page.playing = false; if (page.live) goTo(motion.end); }
    page.dirty = true;
    askThen();
    panels.time();
    panels.soon("sensed");
  }
  if (page.now && page.live && page.head !== motion.end) { // a tenth behind, so that it moves evenly
    page.head = page.head === undefined || Math.abs(motion.end - page.head) > 1 ? motion.end : page.head + (motion.end - page.head) * Math.min(1, 9 * dt);
    if (motion.end - page.head < 0.002) page.head = motion.end;
    page.dirty = true;
  }
  const due = ms - (page.pictured || 0) >= (drawing && drawing.slow && !fingers.size ? SLOW_MS : 0);
  if (page.scene && drawing && due && (page.dirty || drawing.resize()) && !document.hidden) {
    page.pictured = ms;
    try { picture(ms); } catch (error) { // what cannot be drawn stops neither time nor STOP
      if (page.problem !== error.message) console.error(error);
      page.problem = error.message;
    }
  }
  requestAnimationFrame(frame);
}

function picture(ms) {
  page.dirty = false;
  const t = page.now && page.live && page.head !== undefined ? page.head : when();
  const matrices = matricesAt(page.scene, motion, t, page.resting), base = matrices[page.scene.base];
  if (page.follow) {
    const to = [base[12], base[13], Math.max(0.45, Math.min(0.95, base[14] + 0.12))], gap = Math.hypot(...minus(to, camera.at));
    const part = gap > 3 ? 1 : 0.12;
    camera.at = camera.at.map((one, k) => one + (to[k] - one) * part);
    if (gap > 0.01) page.dirty = true;
  }
  look();
  const held = new Set(motion.heldAt(t)), glows = page.scene.bodies.map((body) => (body.role === "object" && held.has(body.id) ? 0.12 : 0));
  const sky = getComputedStyle(document.documentElement).getPropertyValue("--sky").trim();
  const haze = [1, 3, 5].map((k) => parseInt(sky.slice(k, k + 2), 16) / 255);
  drawTrail(t);
  const planned = plans.update(t, matrices), real = SHOWS.truth ? truthAt(page.scene, truth, motion, t, page.resting, matrices) : null;
  page.real = real;
  $("real").hidden = !real;
  const view = drawing.draw(matrices, camera, haze, glows, [real, planned].filter(Boolean));
  plans.marks.draw(view, camera.fovy);
  drawLabels(view, matrices, t);
  pace(ms);
  page.drawn += 1;
  page.matrices = matrices;
}

// Where drawing takes long (no graphics card), the picture is coarser rather than late.
const COARSER = [{ sharp: 0.75, slow: true }, { shadowed: false }, { sharp: 0.5 }];
function pace(ms) {
  page.framesMs = page.framesMs.filter((one) => ms - one < 3000);
  page.framesMs.push(ms);
  if (page.framesMs.length < 5 || ms - page.framesMs[0] < 1200) return;
  const span = (ms - page.framesMs[0]) / (page.framesMs.length - 1);
  page.framesMs = [];
  if (span > (drawing.slow ? 2 * SLOW_MS : 70) && page.dirty && COARSER.length) Object.assign(drawing, COARSER.shift());
}

// --- what a person does ---

function order(text) {
  if (!link.send({ line: text })) panels.answer({ out: "Not sent: there is no connection." });
}

const ANSWER_MS = 3000, UNSENT_MS = 10000;
function stop() {
  clearTimeout(page.unanswered);
  const sent = link.send({ do: "stop" });
  page.unsent = sent ? 0 : performance.now();
  $("stop").classList.add("sent");
  setTimeout(() => $("stop").classList.remove("sent"), 600);
  if (!sent) panels.answer({ out: "STOP was not sent: there is no connection. It is sent once there is one, within 10 s. Use Ctrl-C in the robot's terminal." });
  else page.unanswered = setTimeout(() => panels.answer({ out: "STOP was not answered yet. Use Ctrl-C in the robot's terminal." }), ANSWER_MS);
}

$("stop").addEventListener("pointerdown", (event) => { event.preventDefault(); stop(); });
$("stop").addEventListener("click", (event) => { if (event.detail === 0) stop(); }); // by keyboard
for (const button of document.querySelectorAll("[data-do]")) button.onclick = () => { if (!link.send({ do: button.dataset.do })) panels.answer({ out: "Not sent: there is no connection." }); };
$("order").onsubmit = (event) => {
  event.preventDefault();
  const text = $("line").value.trim();
  if (text) order(text);
  talk.follows = true; // to its answer
  toNewest();
  $("line").value = "";
};
$("slider").oninput = () => { page.playing = false; page.now = false; goTo(Number($("slider").value)); };
$("play").onclick = () => play(!page.playing);
$("now").onclick = () => { page.playing = false; goTo(motion.end); };
const press = (id, key) => { page[key] = !page[key]; $(id).setAttribute("aria-pressed", page[key]); page.dirty = true; };
$("follow").onclick = () => press("follow", "follow");
$("names").onclick = () => press("names", "names");
$("above").onclick = () => { camera.down = 1.5; camera.distance = Math.max(camera.distance, 6); page.dirty = true; };
$("all").onclick = () => {
  if (!page.scene) return;
  const [x0, y0, x1, y1] = page.scene.bounds_m;
  if (page.follow) press("follow", "follow");
  const wide = Math.min(1, $("view").clientWidth / Math.max(1, $("view").clientHeight));
  Object.assign(camera, { at: [(x0 + x1) / 2, (y0 + y1) / 2, 0.3], down: 0.85, distance: 1.25 * Math.max(x1 - x0, y1 - y0, 4) / wide });
  page.dirty = true;
};
for (const box of document.querySelectorAll("#layers input")) box.onchange = () => {
  SHOWS[box.dataset.layer] = box.checked;
  plans.lidarOf = null;
  page.dirty = true;
  if (box.dataset.layer === "cloud") camera_.ask();
};
const look_ = (shown) => { camera_.shown = shown; $("eye").setAttribute("aria-pressed", shown); camera_.ask(); camera_.draw(); };
$("eye").onclick = () => look_(!camera_.shown);
$("seen-close").onclick = () => look_(false);
for (const kind of ["colour", "depth"]) $(`seen-${kind}`).onclick = () => { camera_.kind = kind; camera_.ask(); camera_.draw(); };
$("seen-large").onclick = () => $("seen").classList.toggle("large");
$("fault-kind").onchange = () => faults.form();
$("fault-form").onsubmit = (event) => { event.preventDefault(); faults.send(); };
for (const tab of document.querySelectorAll("#tabs button")) tab.onclick = () => showTab(tab.dataset.show);

$("mic").addEventListener("pointerdown", (event) => { event.preventDefault(); $("mic").setPointerCapture(event.pointerId); microphone.press(); });
for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) $("mic").addEventListener(kind, () => microphone.release());
document.addEventListener("keyup", (event) => { if (event.key.toLowerCase() === "v") microphone.release(); }, true);
window.addEventListener("blur", () => microphone.release());

document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") { event.preventDefault(); stop(); return; }
  const typing = ["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName) && event.target.id !== "slider";
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const does = {
    " ": () => play(!page.playing), f: () => $("follow").click(), o: () => $("all").click(), t: () => $("above").click(),
    n: () => $("names").click(), c: () => $("eye").click(), End: () => $("now").click(), ",": () => goTo(when() - 0.05), ".": () => goTo(when() + 0.05),
    "/": () => $("line").focus(), v: () => microphone.press(),
  }[event.key];
  if (does && !(event.key === " " && event.target.tagName === "BUTTON")) { event.preventDefault(); does(); }
}, true);

const fingers = new Map();
$("view").addEventListener("pointerdown", (event) => { $("view").setPointerCapture(event.pointerId); fingers.set(event.pointerId, event); });
for (const kind of ["pointerup", "pointercancel"]) $("view").addEventListener(kind, (event) => fingers.delete(event.pointerId));
$("view").addEventListener("pointermove", (event) => {
  const old = fingers.get(event.pointerId);
  if (!old) return;
  const [dx, dy] = [event.clientX - old.clientX, event.clientY - old.clientY];
  const other = [...fingers.values()].find((one) => one.pointerId !== event.pointerId);
  fingers.set(event.pointerId, event);
  if (other) {
    const apart = (a) => Math.hypot(a.clientX - other.clientX, a.clientY - other.clientY);
    camera.distance = Math.max(0.7, Math.min(40, camera.distance * apart(old) / Math.max(20, apart(event))));
    shift(dx / 2, dy / 2);
  } else if (event.shiftKey || event.buttons & 6) {
    shift(dx, dy);
  } else {
    camera.heading -= 0.006 * dx;
    camera.down = Math.max(-0.05, Math.min(1.55, camera.down + 0.006 * dy));
  }
  page.dirty = true;
});
function shift(dx, dy) {
  const scale = 1.1 * camera.distance / Math.max(200, $("view").clientHeight), [c, s] = [Math.cos(camera.heading), Math.sin(camera.heading)];
  camera.at = [camera.at[0] + scale * (s * dx - c * dy), camera.at[1] + scale * (-c * dx - s * dy), camera.at[2]];
  if (page.follow) press("follow", "follow");
}
$("view").addEventListener("contextmenu", (event) => event.preventDefault());
$("view").addEventListener("wheel", (event) => {
  event.preventDefault();
  camera.distance = Math.max(0.7, Math.min(40, camera.distance * Math.exp(0.0012 * event.deltaY)));
  page.dirty = true;
}, { passive: false });
document.addEventListener("visibilitychange", () => { page.dirty = true; });

if (matchMedia("(max-width: 860px)").matches) { page.names = false; $("names").setAttribute("aria-pressed", "false"); }
link = new Link(location.hash.slice(1), { taken, changed: () => {
  page.linked = link ? link.open : false;
  if (page.linked && page.unsent && performance.now() - page.unsent < UNSENT_MS) stop(); // pressed while there was no connection
  panels.all();
} });
requestAnimationFrame(frame);
