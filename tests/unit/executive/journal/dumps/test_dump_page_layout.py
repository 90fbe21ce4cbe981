"""What a browser draws of a page: one axis for all, every label legible, numbers for people."""

from __future__ import annotations

import html
import re
import shutil
import subprocess
from itertools import combinations

import msgspec
import pytest

from executive.journal.dumps.html import page
from executive.journal.run import Run
from tests.fakes.long_run import LongRun
from tests.fakes.recorded import read
from tests.fakes.waiting import HANG_S

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), ""
)
TRIES = 5
"""A browser that is starved of the processor gives its elements before it has drawn a frame."""

pytestmark = [
    pytest.mark.skipif(not BROWSER, reason="needs chromium or chrome"),
    pytest.mark.slow,
]

RECORD = """
const drawn = {};
const mine = (pen) => drawn[pen.canvas.id] ??= { texts: [], lines: [] };
const { clearRect, fillRect, fillText } = CanvasRenderingContext2D.prototype;
Object.assign(CanvasRenderingContext2D.prototype, {
  clearRect(...all) { delete drawn[this.canvas.id]; clearRect.apply(this, all); },
  fillRect(x, y, w, h) {
    if (w <= 1.5 && h >= 30) mine(this).lines.push(x + w / 2);
    fillRect.call(this, x, y, w, h);
  },
  fillText(text, x, y) {
    const w = this.measureText(text).width;
    const from = this.textAlign === "center" ? x - w / 2 : this.textAlign === "right" ? x - w : x;
    if (text) mine(this).texts.push({ text, box: [from, y - 9, from + w, y + 2] });
    fillText.call(this, text, x, y);
  },
});
"""
REPORT = """
setTimeout(() => {
  const rows = $("scroller"), whole = document.documentElement;
  const found = { canvases: {}, texts: [], bar: rows.scrollHeight > rows.clientHeight,
    wide: whole.scrollWidth, room: whole.clientWidth };
  for (const [id, { texts, lines }] of Object.entries(drawn)) {
    const canvas = $(id);
    if (!canvas) continue;
    const place = canvas.getBoundingClientRect();
    const { width } = place;
    found.canvases[id] = { texts, lines: lines.map((x) => place.left + x), width };
  }
  for (const name of Object.keys(TABS)) { openTab(name); found.texts.push($("panel").innerText); }
  parent.postMessage(JSON.stringify(found), "*");
}, 1000);
"""
WRAP = """<!doctype html><body><pre id="out"></pre>
<script>onmessage = (event) => { out.textContent = event.data; };</script>
<iframe src="page.html#t=3" style="width:{width}px;height:800px"></iframe></body>"""


class Text(msgspec.Struct):
    """A text and its box: left, top, right, bottom [px]."""

    text: str
    box: tuple[float, float, float, float]


class Canvas(msgspec.Struct):
    """What was drawn: boxes of texts, and where vertical lines are on the page [px]."""

    texts: list[Text]
    lines: list[float]
    width: float


class Found(msgspec.Struct):
    """What a browser made of a page; `bar` is whether the rows scroll."""

    canvases: dict[str, Canvas]
    texts: list[str]
    bar: bool
    wide: float
    room: float


def crowded() -> Run:
    """Things close together with long names, raw numbers, failures one upon the other."""
    names = ["red cup", "blue cup", "x" * 300, "a name of many words " * 8, "שלום " * 20, "👋" * 40]
    spots = {name: {"x_m": 1.0 + 0.02 * k, "y_m": 1.0 + 0.01 * k} for k, name in enumerate(names)}
    square = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]]
    areas = [{"name": name, "outline_m": square} for name in ("counter", "table", *names)]
    things = [{"id": name, "name": name, "color": "red"} for name in names]
    people = [{"name": name, "x_m": 1.0, "y_m": 1.2} for name in ("anna", "x" * 300)]
    raw = {"x_m": 0.1 + 0.2, "parts": [1 / 3, -1e-17, 123456.789012], "deep": {"yaw_rad": 2 / 3}}
    events: list[tuple[float, dict[str, object]]] = [
        (0.0, {"event": "run", "text": "x" * 300, "seed": 0.1 + 0.2}),
        (0.0, {"event": "map", "name": "x" * 300, "rooms": areas[:1], "furniture": areas,
               "objects": things, "people": people}),
        (0.0, {"event": "tree", "nodes": [[0, -1, "jobs", "jobs"], [1, 0, "skill", "x" * 300]]}),
        (0.0, {"event": "node", "id": 1, "status": "running", "note": names[3]}),
        (0.5, {"event": "board", "key": "home", "value": raw}),
    ]  # fmt: skip
    for k in range(12):
        t_s = 1.0 + 0.1 * k
        events += [
            (t_s, {"event": "pose", "x_m": 1 / 3, "y_m": -1e-9, "objects": spots}),
            (t_s, {"event": "failure", "step": "pick", "code": "slip", "cause": "it slipped",
                   "evidence": {"gap_m": 1 / 3, "tries": [0.1 + 0.2]}}),
            (t_s, {"event": "said", "text": "hello"}),
            (t_s, {"event": "health", "name": names[2], "level": "WARN", "cause": names[3]}),
        ]  # fmt: skip
    events.append((4.0, {"event": "custom", "value_s": 0.1 + 0.2, "all": raw}))
    return read([
        msgspec.json.encode({"n": n, "t_s": t_s, **event}) + b"\n"
        for n, (t_s, event) in enumerate(events)
    ])  # fmt: skip


RUNS = {
    "crowded": crowded,
    "short": lambda: read(LongRun(nodes=8, duration_s=60.0).lines),
    "long": lambda: read(LongRun(nodes=400, duration_s=4000.0).lines),
}


SHARE = {("crowded", 400), ("crowded", 1400), ("short", 800), ("long", 400), ("long", 1400)}


@pytest.fixture(
    scope="module",
    params=[
        pytest.param((run, width), marks=() if (run, width) in SHARE else pytest.mark.rest)
        for run in RUNS
        for width in (400, 800, 1400)
    ],
)
def found(request, tmp_path_factory) -> Found:
    """A page as a browser lays it out in a window of some width."""
    run, width = request.param
    folder = tmp_path_factory.mktemp("page")
    text = re.sub(r"<meta http-equiv[^>]*>", "", page(RUNS[run](), why=["because"]))
    text = text.replace("<head>", f"<head><script>{RECORD}</script>")
    text = text.replace("</body>", f"<script>{REPORT}</script></body>")
    (folder / "page.html").write_text(text, encoding="utf-8")
    (folder / "wrap.html").write_text(WRAP.replace("{width}", str(width)), encoding="utf-8")
    command = [
        BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1600,900",
        f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=4000", "--dump-dom",
        (folder / "wrap.html").as_uri(),
    ]  # fmt: skip
    told = None
    for _ in range(TRIES):
        done = subprocess.run(command, capture_output=True, text=True, timeout=HANG_S, check=True)
        told = re.search(r'<pre id="out">(\{.*?)</pre>', done.stdout, re.DOTALL)
        if told and '"bars"' in told[1]:
            break
    assert told is not None
    made = msgspec.json.decode(html.unescape(told[1]), type=Found)
    assert made.bar == (run == "long")
    return made


def test_a_time_is_at_the_same_place_above_and_beside_the_rows(found):
    above, beside = (found.canvases[name].lines for name in ("lane", "bars"))
    assert len(above) == len(beside) >= 3
    assert all(abs(a - b) < 1.0 for a, b in zip(above, beside, strict=True))
    assert abs(found.canvases["overview"].lines[-1] - above[-1]) < 1.0  # the time looked at


def test_no_text_lies_upon_another(found):
    for name, canvas in found.canvases.items():
        for one, other in combinations(canvas.texts, 2):
            a, b = one.box, other.box
            apart = a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
            assert apart, (name, one, other)


def test_every_text_is_in_sight(found):
    for name, canvas in found.canvases.items():
        for one in canvas.texts:
            left, _, right, _ = one.box
            assert left >= -1.0, (name, one)
            assert right <= canvas.width + 1.0, (name, one)
    assert found.wide <= found.room


def test_no_number_has_more_digits_than_were_measured(found):
    texts = found.texts + [one.text for c in found.canvases.values() for one in c.texts]
    assert any(re.search(r"\d\.\d", text) for text in texts)
    for text in texts:
        assert not re.search(r"\d\.\d{4}|\de-?\d|-0(?![.\d])", text), text
