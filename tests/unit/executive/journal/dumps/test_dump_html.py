"""The page holds the run and nothing else: no request, no script of a stranger."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import msgspec
import pytest

from executive.journal.dumps.formats import render
from executive.journal.dumps.html import Page, embedded, page
from executive.journal.run import Run
from executive.journal.snapshot import inner
from executive.journal.why import why
from executive.skills.pick import PickParams
from robot.printable import printable, printable_data
from tests.fakes.long_run import LongRun
from tests.fakes.recorded import Recorded, read
from tests.fakes.rig import PICK, WAIT
from tests.fakes.scripted_skills import Script
from tests.fakes.waiting import HANG_S

HOSTILE = (
    "</script><script>document.title='owned'</script>",
    "<img src=x onerror=\"document.title='owned'\">",
    "<!--<script>",
    "]]>\u2028\u2029'\"&amp;&lt;\\u003c",
    "$title ${data} $$",
    "__proto__",
    "\x1b]0;title\x07\x9b31m\x00\x7fcup\u202egnp",
)
REACHING_OUT = (
    "http:", "https:", "fetch(", "XMLHttpRequest", "import(", "eval(", "url(", "innerHTML",
    "outerHTML", "insertAdjacentHTML", "document.write", "new Function",
)  # fmt: skip
BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), ""
)


def line(event: str, t_s: float = 0.0, **data) -> bytes:
    return msgspec.json.encode({"n": 0, "t_s": t_s, "event": event, **data}) + b"\n"


def hostile_run() -> Run:
    """A run in which every text that comes from outside would like to be a script."""
    nodes = [[0, -1, "jobs", "jobs"]]
    nodes += [[k + 1, 0, "skill", name] for k, name in enumerate(HOSTILE)]
    lines = [line("run", text=HOSTILE[0], world=HOSTILE[1], seed=HOSTILE[2])]
    lines.append(line("tree", nodes=nodes))
    for k, name in enumerate(HOSTILE):
        t_s = float(k + 1)
        lines += [
            line("node", t_s=t_s, id=k + 1, status="running", note=name),
            line("said", t_s=t_s, text=name),
            line("board", t_s=t_s, key=name, value={name: name}),
            line("health", t_s=t_s, name=name, level="WARN", code=name, cause=name),
            line("failure", t_s=t_s, step=name, code=name, cause=name, evidence={name: name}),
            line("pose", t_s=t_s, x_m=0.0, y_m=float(k), objects={name: {"x_m": 1.0, "y_m": 1.0}}),
            line(name, t_s=t_s, **{name: name}),
        ]
    area = {"name": HOSTILE[1], "outline_m": [[0, 0], [1, 0], [1, 1]]}
    lines.append(line("map", name=HOSTILE[0], rooms=[area], furniture=[area],
                      objects=[{"id": HOSTILE[0], "name": HOSTILE[1], "color": HOSTILE[2]}],
                      people=[{"name": HOSTILE[1], "x_m": 0, "y_m": 0}]))  # fmt: skip
    lines.append(line("outcome", t_s=9.0, code=HOSTILE[0], cause=HOSTILE[1]))
    return read(lines)


class Parts(HTMLParser):
    """Elements of a page, with the text of scripts and styles."""

    def __init__(self, text: str):
        super().__init__()
        self.elements: list[tuple[str, dict]] = []
        self.texts: list[tuple[str, str]] = []
        self._open = ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        self._open = tag

    def handle_endtag(self, tag):
        self._open = ""

    def handle_data(self, data):
        if self._open:
            self.texts.append((self._open, data))

    def script(self, kind: str | None) -> str:
        scripts = [attrs for tag, attrs in self.elements if tag == "script"]
        texts = [text for tag, text in self.texts if tag == "script"]
        return next(t for a, t in zip(scripts, texts, strict=True) if a.get("type") == kind)


@pytest.fixture(scope="module")
def recovered() -> Run:
    rig = Recorded({PickParams: [Script(steps=2, code="grasp_missed"), Script(steps=5)]})
    rig.begin(PICK, WAIT).run()
    return rig.read()


def rounded(data):
    if isinstance(data, dict):
        return {key: rounded(value) for key, value in data.items()}
    if isinstance(data, list):
        return [rounded(item) for item in data]
    return round(data, 4) if isinstance(data, float) else data


def test_numbers_in_the_page_are_no_finer_than_what_is_measured():
    run = read([line("run", text="x", speed=0.1 + 0.2, t=[1 / 3, {"x_m": 2 / 3}])])
    data = Parts(page(run)).script("application/json")
    assert "0.3333" in data
    assert not re.search(r"\.\d{5}", data)


def test_the_data_in_the_page_is_the_run(recovered):
    for run in (recovered, hostile_run(), read(LongRun(nodes=60, duration_s=60.0).lines)):
        data = Parts(page(run, why=["because"])).script("application/json")
        told = msgspec.json.decode(data, type=Page)
        assert told.run == rounded(printable_data(msgspec.json.decode(render(run, "json"))))
        assert (told.inner, told.why) == (sorted(inner(run)), ["because"])


@pytest.mark.parametrize("make", [hostile_run, Run])
def test_nothing_in_a_journal_becomes_markup(make):
    text, plain = page(make(), why=list(HOSTILE)), page(read([line("run", text="x")]))
    tags = [tag for tag, _ in Parts(text).elements]
    assert tags == [tag for tag, _ in Parts(plain).elements]
    assert len(re.findall("<script", text)) == len(re.findall("</script", text)) == 2


def test_the_page_asks_nobody_for_anything(recovered):
    parts = Parts(page(recovered))
    assert not {"link", "img", "iframe", "object", "form", "a", "base"} & {
        t for t, _ in parts.elements
    }
    for _, attrs in parts.elements:
        assert not {"src", "href", "style", "srcset"} & attrs.keys()
        assert not any(name.startswith("on") for name in attrs)
    code = "".join(text for tag, text in parts.texts if tag in ("script", "style"))
    for word in REACHING_OUT:
        assert word not in code, word


def test_the_policy_allows_the_pages_own_script_and_style_only(recovered):
    parts = Parts(page(recovered))
    policy = next(a["content"] for t, a in parts.elements if a.get("http-equiv"))
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    style = next(text for tag, text in parts.texts if tag == "style")
    for rule, text in (("script-src", parts.script(None)), ("style-src", style)):
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert rules.pop(rule) == f"'sha256-{digest}'"
    assert set(rules.values()) == {"'none'"}
    assert "default-src" in rules


def test_embedded_json_means_the_same():
    for text in HOSTILE:
        safe = embedded(json.dumps(text, ensure_ascii=False))
        assert json.loads(safe) == text
        assert not set("<>&\u2028\u2029") & set(safe)


# --- in a real browser --------------------------------------------------------------------------

TRIES = 5
"""A browser that is starved of the processor gives its elements before it has drawn a frame."""

needs_browser = pytest.mark.skipif(not BROWSER, reason="needs chromium or chrome")


def seen(tmp_path, run: Run, place: str = "") -> str:
    """The page's elements after its script has run, as the browser has them."""
    path = tmp_path / "page.html"
    path.write_text(page(run), encoding="utf-8")
    command = [
        BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1400,900",
        f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=2000", "--dump-dom",
        f"{path.as_uri()}{place}",
    ]  # fmt: skip
    for _ in range(TRIES):
        done = subprocess.run(command, capture_output=True, text=True, timeout=HANG_S, check=True)
        if 'role="treeitem"' in done.stdout:
            break
    return done.stdout


def rows(dom: str) -> list[tuple[str, str]]:
    """State and name of every row of the tree as it is then, in the order of the screen."""
    row = r'<div role="treeitem" class="row (\w+)(?: selected)?".*?class="name"[^>]*>([^<]*)<'
    return [(state, html.unescape(name)) for state, name in re.findall(row, dom, re.DOTALL)]


@needs_browser
@pytest.mark.slow
def test_the_browser_shows_the_states_that_the_run_had(recovered, tmp_path):
    for t_s in (0.0, 0.15, recovered.end_s):
        expected = [
            (node.at(t_s).state, node.title or node.name)
            for _, node in recovered.walk()
            if node.id not in inner(recovered) and node.in_view(t_s)
        ]
        assert rows(seen(tmp_path, recovered, f"#t={t_s}")) == expected


@needs_browser
@pytest.mark.slow
def test_hostile_names_are_shown_as_they_are(tmp_path):
    dom = seen(tmp_path, hostile_run(), "#t=8&tab=why")
    title = re.search("<title>(.*?)</title>", dom, re.DOTALL)
    assert title is not None
    assert html.unescape(title.group(1)) == HOSTILE[0]
    assert [name for _, name in rows(dom)] == [printable(name) for name in HOSTILE]
    assert "<img" not in dom
    assert dom.count("<script") == 2


def six_jobs() -> Run:
    """A prompt's run: four jobs that were cancelled, and two that are done, the last among them."""
    lines = [line("run", text="prompt", world="kitchen", robot="juno", seed=1)]
    lines.append(line("tree", nodes=[[0, -1, "jobs", "jobs"], [1, 0, "skill", "nod"]]))
    for job in range(1, 7):
        how = "cancelled" if job < 5 else "done"
        lines.append(line("job", t_s=job, job=job, state="running", text=f"errand {job}"))
        lines.append(line("job", t_s=job + 0.5, job=job, state=how, text=f"errand {job}"))
        lines.append(line("outcome", t_s=job + 0.5, code=how))
    return read(lines)


def test_a_run_of_several_jobs_is_told_by_all_of_them_without_scripts_too():
    run = six_jobs()
    assert run.of_jobs == (2, 6)
    assert "2 of 6 jobs done." in page(run)
    assert "That is of one job; 2 of 6 jobs are done." in why(run).lines
    began = Parts(page(run, began="2026-01-01 12:00")).script("application/json")
    assert json.loads(began)["began"] == "2026-01-01 12:00"


@needs_browser
@pytest.mark.slow
def test_the_browser_shows_all_jobs_and_when_and_with_what_robot_it_was(tmp_path):
    dom = seen(tmp_path, six_jobs())
    badge = re.search(r'id="badge" class="([^"]*)"[^>]*>([^<]*)<', dom)
    assert badge is not None
    assert badge.groups() == ("badge failed", "2 of 6 jobs done")
    assert "juno · kitchen" in dom
    for job in range(1, 7):
        assert f"errand {job}" in dom
