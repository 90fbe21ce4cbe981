"""Regular expressions out of files, which may be a stranger's: looked for in linear time.

The standard library's may take longer than anybody lives for a pattern of eight letters
(`(a|a)+$`). RE2 takes time that grows with the text alone, in memory that is bounded; it has no
backreferences and no assertions that look ahead or back.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from typing import Any, cast

MOST_LETTERS = 1000
"""Of a pattern: each bracket within another takes some of the stack while it is read."""
MOST_BYTES = 1 << 16
"""Of a pattern once it is read: 2000 letters and choices, which takes 0.1 ms."""
_UNICODE_CLASS = re.compile(r"(?<!\\)(?:\\\\)*\\[pP]")
"""Of `\\pL` RE2 makes thousands of ranges, each time that it stands there; `\\w` will do."""


def check(pattern: str) -> None:
    """Look whether a pattern can be looked for. Raises ValueError with what is wrong with it."""
    _finder(pattern)


def is_in(pattern: str, text: str) -> bool:
    """Whether a text contains what a pattern means. Raises ValueError if the pattern is none."""
    return _finder(pattern)(text)


@functools.lru_cache(maxsize=100)
def _finder(pattern: str) -> Callable[[str], bool]:
    if len(pattern) > MOST_LETTERS:
        raise ValueError(f"it has {len(pattern)} letters, at most {MOST_LETTERS} are taken")
    if _UNICODE_CLASS.search(pattern):
        raise ValueError(r"\p is not taken; use \w")
    import re2  # pyright: ignore[reportMissingTypeStubs]  # here: 20 ms, and few need it

    engine = cast("Any", re2)
    options = engine.Options()
    options.log_errors, options.never_capture, options.max_mem = False, True, MOST_BYTES
    try:
        found = engine.compile(pattern.encode(errors="replace"), options=options)
    except engine.error as error:
        raise ValueError(error.args[0].decode(errors="replace")) from None
    return lambda text: found.search(text.encode(errors="replace")) is not None
