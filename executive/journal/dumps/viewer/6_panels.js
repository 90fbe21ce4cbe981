// Beside the rows, at the time that is looked at: how things stand, why, all events, one node.

const BAD = new Set(["failure", "abort", "no recovery"]);
const GROUPS = {
  steps: ["step", "done", "stopping", "stopped", "job", "run", "outcome"],
  trouble: ["failure", "recovery", "no recovery", "abort", "hold", "fault", "health", "warning"],
  people: ["said", "pause", "paused", "resume", "stop", "cancel", "help", "answer"],
  board: ["board"],
};
const happened = [
  ...list(run.log),
  ...list(run.board).map(([t, key, value]) => [t, "board", `${key} = ${words(value)}`]),
].sort((a, b) => a[0] - b[0]);
const groupOf = (kind) => Object.keys(GROUPS).find((name) => GROUPS[name].includes(kind)) || "other";

let tab = "now";
const chosen = new Set();
let long = null;

const when = (t) => el("button", { class: "time", textContent: clock(t), onclick: () => setNow(t, { follow: true }) });
const heading = (text) => el("h2", { textContent: text });
function table(pairs, isFresh = () => false) {
  const body = el("table");
  for (const [key, value, since] of pairs) {
    body.append(el("tr", { class: isFresh(since) ? "fresh" : "" },
      el("td", { textContent: key }), el("td", {}, typeof value === "string" ? value : value)));
  }
  return body;
}

const TABS = {
  now: ["Now", nowPanel], why: [`Why (${troubles.length})`, whyPanel],
  events: [`Events (${happened.length})`, eventsPanel], node: ["Node", nodePanel],
};

function drawTabs() {
  $("tabs").replaceChildren(...Object.entries(TABS).map(([name, [title]]) => el("button", {
    role: "tab", textContent: title, "aria-selected": name === tab, onclick: () => openTab(name),
  })));
}
function openTab(name) {
  tab = name;
  long = null;
  $("panel").scrollTop = 0;
  drawTabs();
  drawPanel({ force: true });
}

let drawnFor = "";
function drawPanel({ force = false } = {}) {
  const mark = `${tab} ${now} ${selected}`;
  if (mark === drawnFor && !force) return;
  drawnFor = mark;
  if (tab === "events" && long && !printing) { long.render(); long.reveal(Math.max(0, lastBefore(long.items, now))); return; }
  if (printing) $("panel").replaceChildren(...nowPanel(), heading("Why"), ...whyPanel());
  else $("panel").replaceChildren(...TABS[tab][1]());
}

function nowPanel() {
  const parts = [], leaves = order.filter((node) => !node.inner && inView(node, now) && stateAt(node, now) === "running"
    && !node.children.some((id) => stateAt(nodes.get(id), now) === "running"));
  parts.push(heading("At work"));
  parts.push(table(leaves.map((node) => ["▸", el("span", {}, node.label, el("span", { class: "dim", textContent: noteAt(node, now) ? `  ${noteAt(node, now)}` : "" }))])));
  if (!leaves.length) parts.push(el("div", { class: "dim", textContent: "nothing" }));
  const pose = poses[lastBefore(poses, now)], wrong = healthAt(now), facts = [];
  const job = list(run.jobs).filter((j) => list(j.states).length && j.states[0][0] <= now);
  for (const j of job) facts.push([`job ${j.number}`, `${j.text}: ${j.states[lastBefore(j.states, now)][1]}${j.urgent ? " (urgent)" : ""}`]);
  if (pose) facts.push(["pose", `x ${fixed(pose[1], 2)} m, y ${fixed(pose[2], 2)} m, heading ${fixed(pose[3] * 180 / Math.PI, 0)}°`]);
  const mode = modes[lastBefore(modes, now)];
  if (mode) facts.push(["body", mode[2]]);
  facts.push(["health", wrong.length ? wrong.map((f) => `${f[2].toLowerCase()}: ${f[4] || f[1]}`).join("; ") : "all is well"]);
  const words_ = list(run.log).filter((line) => line[1] === "said" && line[0] <= now);
  if (words_.length) facts.push(["said", words_[words_.length - 1][2].replace(/^says: /, "")]);
  parts.push(heading("The robot"), table(facts));
  const board = [...boardAt(now)].map(([key, [value, since]]) => [key, words(value), since]);
  if (board.length) parts.push(heading("Blackboard"), table(board, (since) => now - since < 0.5));
  return parts;
}

function whyPanel() {
  const parts = [];
  if (list(page.why).length) parts.push(el("div", { class: "why pre", textContent: page.why.join("\n") }));
  for (const trouble of troubles) parts.push(card(trouble));
  if (!troubles.length) parts.push(el("p", { class: "dim", textContent: "No step failed." }));
  return parts;
}

function card(trouble) {
  const ended = trouble.ended || "open", items = [];
  const evidence = Object.entries(trouble.evidence || {});
  if (evidence.length) items.push(el("div", { class: "dim", textContent: `measured: ${evidence.map(([k, v]) => measured(k, v)).join(", ")}` }));
  const around = list(trouble.around).map((text) => el("li", { textContent: text }));
  if (around.length) items.push(el("div", { textContent: "known to be wrong then:" }), el("ul", {}, ...around));
  const tried = list(trouble.tried).map(([t, text]) => el("li", {}, when(t), ` ${text}`));
  if (tried.length) items.push(el("div", { textContent: "tried:" }), el("ul", {}, ...tried));
  const close = el("div", {}, ended);
  if (trouble.ended_s !== undefined) close.append(" at ", when(trouble.ended_s));
  items.push(close);
  if (trouble.suggestion && ended !== "recovered") items.push(el("div", { textContent: `What to do: ${trouble.suggestion}` }));
  const name = trouble.node >= 0 && nodes.has(trouble.node)
    ? el("button", { class: "time", textContent: trouble.step, onclick: () => select(trouble.node, { reveal: true }) })
    : el("span", { textContent: trouble.step });
  return el("div", { class: `card ${ended === "recovered" ? "recovered" : ""} ${trouble.t_s > now ? "later" : ""}` },
    el("div", {}, when(trouble.t_s), "  ", name), el("div", { class: "cause", textContent: `✗ ${trouble.cause} (${trouble.code})` }), ...items);
}

function eventsPanel() {
  const chips = [...Object.keys(GROUPS), "other"].map((name) => el("button", {
    textContent: name, "aria-pressed": chosen.has(name),
    onclick: () => { if (chosen.has(name)) chosen.delete(name); else chosen.add(name); openTab("events"); },
  }));
  const holder = el("div", { class: "list" }), panel = $("panel");
  const items = happened.filter((entry) => !chosen.size || chosen.has(groupOf(entry[1])));
  long = new LongList(panel, holder, 20, (entry) => el("div", {
    class: `entry${entry[0] > now ? " later" : ""}${BAD.has(entry[1]) ? " bad" : ""}`, title: entry[2],
    onclick: () => setNow(entry[0], { follow: true }),
  }, el("span", { class: "when", textContent: clock(entry[0]) }), el("span", { class: "kind", textContent: entry[1] }),
  el("span", { class: "what", textContent: entry[2] })));
  requestAnimationFrame(() => { long?.set(items); long?.reveal(Math.max(0, lastBefore(items, now))); });
  return [el("div", { class: "chips" }, ...chips), holder];
}

function nodePanel() {
  const node = nodes.get(selected);
  if (!node) return [el("p", { class: "dim", textContent: "Click a name to see all there is about a node." })];
  const ran = node.spans.filter((entry) => entry[2] === "running");
  const total = ran.reduce((sum, [begin, end]) => sum + end - begin, 0);
  const facts = [["kind", node.kind.replaceAll("_", " ")], ["state now", inView(node, now) ? stateAt(node, now) : "not in the tree"]];
  if (node.label !== node.name) facts.push(["name", node.name]);
  if (node.step) facts.push(["step", node.step]);
  facts.push(["ran", ran.length ? `${ran.length} ${ran.length === 1 ? "time" : "times"}, ${span(total)} in all` : "never"]);
  const changes = node.changes.slice(0, 400).map(([t, state, note]) => el("tr", {},
    el("td", {}, when(t)), el("td", {}, el("span", { class: `mark ${state}`, textContent: MARKS[state] }), ` ${state}${note ? `: ${note}` : ""}`)));
  return [heading(node.label), table(facts), heading("Changes"), el("table", {}, ...changes)];
}
