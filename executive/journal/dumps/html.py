"""A run as one HTML file that needs nothing else: no network, no other file, no server.

Everything from the journal is data: it travels as JSON in which no character can end the script
element, and the page only ever makes text of it. The policy in the page's head allows its own
script and style, by their hashes, and nothing else: no other script, no request, no form.
"""

from __future__ import annotations

import base64
import hashlib
import html
from importlib import resources
from string import Template
from typing import Any, cast

import msgspec

from executive.journal.failures import verdict
from executive.journal.run import Run
from executive.journal.snapshot import inner
from robot.printable import printable, printable_data

_SCRIPTS = (
    "1_run.js", "2_tools.js", "3_timeline.js", "4_lanes.js", "5_map.js", "6_panels.js", "7_main.js",
)  # fmt: skip

DECIMALS = 4
"""Of a number in a page: what is measured is a millimetre, what is timed 0.1 ms."""


class Page(msgspec.Struct, kw_only=True):
    """The data inside a page: the run, the nodes that only hold the tree together, and `why`.

    `began` is the time of day at which the run did, "" where nobody knows.
    """

    run: dict[str, Any]
    inner: list[int]
    why: list[str] = []
    began: str = ""


def page(run: Run, *, why: list[str] | None = None, began: str = "") -> str:
    """The page of a run; `why` are the lines of its explanation, `began` is when it was."""
    files = resources.files("executive.journal.dumps") / "viewer"
    script = "\n".join((files / name).read_text(encoding="utf-8") for name in _SCRIPTS)
    style = (files / "viewer.css").read_text(encoding="utf-8")
    template = Template((files / "page.html").read_text(encoding="utf-8"))
    told = Page(run=run.dumped(), inner=sorted(inner(run)), why=why or [], began=began)
    data = msgspec.json.encode(_rounded(printable_data(msgspec.to_builtins(told))))
    policy = (
        f"default-src 'none'; script-src {_hash(script)}; style-src {_hash(style)}; "
        "base-uri 'none'; form-action 'none'"
    )
    return template.substitute(
        policy=policy,
        title=html.escape(printable(run.text) or "a run"),
        fallback=html.escape(printable(fallback(run))),
        style=style,
        data=embedded(data.decode()),
        script=script,
    )


def _rounded(data: object) -> object:
    """Plain data with numbers no finer than anybody looks at them."""
    if isinstance(data, float):
        return round(data, DECIMALS)
    if isinstance(data, dict):
        entries = cast("dict[object, object]", data).items()
        return {key: _rounded(value) for key, value in entries}
    if isinstance(data, list):
        return [_rounded(item) for item in cast("list[object]", data)]
    return data


def embedded(json: str) -> str:
    """JSON that means the same and can stand in a script element whatever it contains."""
    for letter in "<>&\u2028\u2029":
        json = json.replace(letter, f"\\u{ord(letter):04x}")
    return json


def fallback(run: Run) -> str:
    """How it ended, for readers without scripts."""
    ending = run.outcome
    if ending is None:
        return "The run has no outcome yet. This page needs JavaScript to show it."
    done, count = run.of_jobs
    if count > 1:
        return f"{done} of {count} jobs done. This page needs JavaScript to show the rest."
    how = verdict(None) if ending.code == "done" else f"{verdict(ending)}."
    return f"{how} This page needs JavaScript to show the rest."


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
