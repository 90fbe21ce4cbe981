"""Every format of a dump, as one table: a run and a time in, a file's bytes out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal

import msgspec

from executive.journal.dumps.dot import dot
from executive.journal.dumps.html import page
from executive.journal.dumps.svg import svg
from executive.journal.dumps.text import Style, picture
from executive.journal.run import Run
from executive.journal.snapshot import snapshot
from robot.printable import printable_json

Format = Literal["html", "svg", "png", "dot", "json", "text"]


class Wish(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be drawn.

    `t_s` is the time of a picture of the tree (None: the end); the page and the JSON have all
    times in them. `everything` also shows what only holds the tree together. `why` are the lines
    of the run's explanation, and `began` the time of day it began at, for the page.
    """

    t_s: float | None = None
    style: Style = "unicode"
    everything: bool = False
    why: tuple[str, ...] = ()
    began: str = ""


def _title(run: Run, wish: Wish) -> str:
    t_s = run.end_s if wish.t_s is None else wish.t_s
    return f"{run.text or 'tree'}, at {t_s:.2f} s"


def _html(run: Run, wish: Wish) -> bytes:
    return page(run, why=list(wish.why), began=wish.began).encode()


def _svg(run: Run, wish: Wish) -> bytes:
    roots = snapshot(run, wish.t_s, everything=wish.everything)
    return svg(roots, title=_title(run, wish)).encode()


def _png(run: Run, wish: Wish) -> bytes:
    from executive.journal.dumps.png import png  # Pillow is only loaded where it is needed

    return png(snapshot(run, wish.t_s, everything=wish.everything))


def _dot(run: Run, wish: Wish) -> bytes:
    roots = snapshot(run, wish.t_s, everything=wish.everything)
    return dot(roots, title=_title(run, wish)).encode()


def _json(run: Run, _wish: Wish) -> bytes:
    return printable_json(msgspec.json.encode(run.dumped()).decode()).encode() + b"\n"


def _text(run: Run, wish: Wish) -> bytes:
    roots = snapshot(run, wish.t_s, everything=wish.everything)
    return (picture(roots, style=wish.style) + "\n").encode()


FORMATS: Mapping[Format, tuple[str, Callable[[Run, Wish], bytes]]] = {
    "html": ("html", _html),
    "svg": ("svg", _svg),
    "png": ("png", _png),
    "dot": ("dot", _dot),
    "json": ("json", _json),
    "text": ("txt", _text),
}
"""Name of a format to the ending of its files and how it is made."""


def render(run: Run, kind: Format, wish: Wish | None = None) -> bytes:
    """A run in a format."""
    return FORMATS[kind][1](run, wish or Wish())
