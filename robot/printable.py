"""Text that may be a stranger's, made fit for a terminal or a page.

A terminal obeys what it is sent: an escape sequence in the name of a cup can clear the screen,
retitle the window or fill the clipboard, and characters that turn the direction of writing around
make a line read as what it is not.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import cast

_CONTROL = "\x00-\x08\x0b-\x1f\x7f-\x9f"  # C0 but for tab and new line, DEL, C1
_DIRECTION = "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"  # https://trojansource.codes
_BREAKS = "\u2028\u2029"  # ends of lines to some readers and not to others
_UNSEEN = (  # of no width: two names that look the same are not, and text hides in tags
    "\u00ad\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200d\u2060-\u2065\u206a-\u206f"
    "\u2800\u3164\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a"
    "\U000e0000-\U000e0fff"
)
_NO_CHARACTERS = "\ufffe\uffff"  # XML forbids them
_SURROGATES = "\ud800-\udfff"  # no text: writing them raises
_UNFIT = re.compile(f"[{_CONTROL}{_DIRECTION}{_BREAKS}{_UNSEEN}{_NO_CHARACTERS}{_SURROGATES}]")


def printable(text: str) -> str:
    r"""The text with what a terminal would obey written out, as in `\x1b[31m`."""
    return _UNFIT.sub(_written_out, text)


def printable_line(text: str) -> str:
    """The same on one line: new lines and tabs are spaces like others."""
    return " ".join(printable(text).split())


def printable_data(data: object, fit: Callable[[str], str] = printable) -> object:
    """Plain data with every text in it made fit."""
    if isinstance(data, str):
        return fit(data)
    if isinstance(data, dict):
        entries = cast("dict[object, object]", data).items()
        return {printable_data(key, fit): printable_data(value, fit) for key, value in entries}
    if isinstance(data, list | tuple):
        return [printable_data(item, fit) for item in cast("list[object]", data)]
    return data


def is_printable(text: str) -> bool:
    """Whether nothing of it has to be written out."""
    return _UNFIT.search(text) is None


def printable_json(json: str) -> str:
    r"""JSON that means the same, with what a terminal would obey as `\u001b`."""
    return _UNFIT.sub(_escaped, json)


def _written_out(found: re.Match[str]) -> str:
    code = ord(found[0])
    if code > 0xFFFF:
        return f"\\U{code:08x}"
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"


def _escaped(found: re.Match[str]) -> str:
    """As JSON writes it: beyond 16 bits as a pair of surrogates."""
    units = found[0].encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[i : i + 2].hex()}" for i in range(0, len(units), 2))
