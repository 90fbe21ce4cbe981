// What stands around the picture. Everything that comes is text, and is only ever made text of.

const $ = (id) => document.getElementById(id);
const MARKS = { waiting: "·", running: "▸", done: "✓", failed: "✗", stopped: "■" };

function element(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

const seconds = (t) => (t >= 3600 ? `${Math.floor(t / 3600)}:${String(Math.floor(t / 60) % 60).padStart(2, "0")}` : `${Math.floor(t / 60)}`)
  + `:${(t % 60).toFixed(1).padStart(4, "0")}`;

// Rows that are as they were stay as they are: a tree of a thousand nodes costs what is new in it.
function showTree(rows) {
  const list = $("tree");
  if (!rows.length) { list.replaceChildren(element("li", "empty", "Nothing is to be done.")); return; }
  while (list.children.length > rows.length) list.lastChild.remove();
  let running = null;
  rows.forEach((row, k) => {
    const [depth, kind, name, state, note, took, id] = row, key = JSON.stringify(row);
    let item = list.children[k];
    if (!item || item.key !== key) {
      const fresh = element("li", state);
      fresh.key = key;
      fresh.style.setProperty("--d", Math.min(depth, 14));
      fresh.title = `${kind}, ${state}${note ? `: ${note}` : ""}`;
      const words = element("span", "", name);
      if (note && note !== name && (state === "failed" || state === "running")) words.append(element("em", "", note));
      fresh.append(element("i", "", MARKS[state] || "·"), words);
      if (took != null && state !== "waiting") fresh.append(element("small", "", `${took.toFixed(took < 10 ? 1 : 0)} s`));
      if (item) item.replaceWith(fresh); else list.append(fresh);
      item = fresh;
    }
    if (state === "running") running = item;
  });
  if (running && running !== showTree.last) running.scrollIntoView({ block: "nearest" });
  showTree.last = running;
}

// The newest line stays in sight until somebody scrolls up: while the list is not shown, and when its size changes, too.
const talk = $("talk"), toNewest = () => { if (talk.follows) talk.scrollTop = talk.scrollHeight; };
talk.follows = true;
talk.addEventListener("scroll", () => { if (talk.clientHeight) talk.follows = talk.scrollHeight - talk.scrollTop - talk.clientHeight < 40; });
new ResizeObserver(toNewest).observe(talk);

function showTalk(lines) {
  const inOrder = lines.map((line, k) => [line, k]).sort(([a, i], [b, j]) => a[0] - b[0] || i - j).map(([line]) => line);
  const items = inOrder.map(([t, kind, text, who]) => {
    const said = who && kind !== "help" ? text.replace(/^says: /, "") : text;
    const item = element("li", `${kind.replace(/[^a-z]/g, "")} ${who === "robot" ? "robot" : ""} ${kind === "outcome" ? "ended" : ""}`, said);
    item.prepend(element("time", "", seconds(t)));
    return item;
  });
  talk.replaceChildren(...items);
  toNewest();
  motors.draw();
}

function facts(pairs) {
  const list = element("dl");
  for (const [name, value] of pairs) if (value !== "" && value != null) list.append(element("dt", "", name), element("dd", "", value));
  return list;
}

function showHealth(health, troubles, head, motion, stands) {
  const parts = [element("h3", "", "Health")];
  if (!health.length) parts.push(element("p", "", "All is well."));
  for (const [level, name, cause] of health) {
    const card = element("div", level === "SLOW" ? "card warn" : "card", cause || name);
    card.append(element("small", "", `${level.toLowerCase()}: ${name}`));
    parts.push(card);
  }
  const held = Object.entries(head.held || {}).map(([side, id]) => `${side}: ${id}`).join(", ");
  const pose = stands ? `x ${stands.base[0].toFixed(2)} m, y ${stands.base[1].toFixed(2)} m` : "";
  parts.push(element("h3", "", "Body"), facts([
    ["mode", head.mode], ["pelvis", pose], ["in the hands", held || "nothing"],
    ["battery", motion.charge == null ? "" : `${Math.round(100 * motion.charge)} %`],
    ["late periods", motion.late == null ? "" : `${(100 * motion.late).toFixed(1)} % of the controller's`],
  ]));
  parts.push(element("h3", "", "Failures"));
  if (!troubles.length) parts.push(element("p", "", "None so far."));
  for (const one of [...troubles].reverse()) {
    const card = element("div", `card ${one.ended}`, `${one.step}: ${one.cause}`);
    const became = { recovered: "recovered", "not recovered": "not recovered" }[one.ended] || "being dealt with";
    card.append(element("small", "", `${seconds(one.t_s)}  ${one.code}${one.measured ? `  (${one.measured})` : ""}`));
    if (one.tried.length) card.append(element("small", "", `tried: ${one.tried.join("; ")}`));
    card.append(element("small", "", became + (one.suggestion ? `; ${one.suggestion}` : "")));
    parts.push(card);
  }
  $("well").replaceChildren(...parts);
  $("unwell").hidden = !health.length;
  $("unwell").textContent = health.length;
}

function showJobs(jobs) {
  const parts = [element("h3", "", "What was asked for")];
  if (!jobs.length) parts.push(element("p", "", "Nothing yet."));
  for (const [number, text, state] of [...jobs].reverse()) {
    const card = element("div", `card ${state}`, text);
    card.append(element("small", "", `${number}: ${state}`));
    parts.push(card);
  }
  $("jobs").replaceChildren(...parts);
}

// How it stands, in a word and a colour.
function standing(head, live, linked, jobs, then) {
  if (!linked && live !== false) return ["lost", "no connection"];
  if (!live && head.text === undefined) return ["open", "waiting"];
  const ending = head.ending, working = jobs.some(([, , state]) => ["running", "interrupted", "paused"].includes(state));
  if (head.stop) return ["paused", "stopping"];
  if (head.paused) return ["paused", "paused"];
  if (head.pause) return ["paused", "pausing"];
  if (working && (live || then)) return ["working", head.mode === "walk" ? "walking" : "at work"];
  if (ending) {
    const how = { done: "done", cancelled: "stopped" }[ending.code] || "failed";
    return [how === "stopped" ? "paused" : how, how];
  }
  return live || then ? ["open", "ready"] : ["failed", "cut off"];
}

function showTab(name) {
  const tree = $("tree");
  (name === "tree" ? $("small") : $("left")).append(tree);
  for (const pane of document.querySelectorAll("#right > .pane")) pane.hidden = pane.dataset.tab !== (name === "tree" ? "small" : name);
  for (const tab of document.querySelectorAll("#tabs button")) tab.setAttribute("aria-selected", tab.dataset.show === name);
  toNewest();
  motors.draw();
}
