"""What was typed or pasted, as text: without what only tells a terminal how to show it."""

from __future__ import annotations

import os
import re
import select
import termios
import threading
from collections.abc import Callable
from typing import TextIO

from intents.letters import without_sequences
from intents.stopping import is_stay, is_stop

STOPS = re.compile(rb"([\x03\x1c])")
"""Ctrl-C and Ctrl-\\, which end a program anywhere else."""

COLOUR = re.compile(r"\x1b\[[\d;:]*m")
"""Nobody types one, so that it was pasted; the input library takes it for a report of a mouse."""
_KEYS = re.compile("[\x00-\x07\x0b-\x1f]")
KEPT = 4096
"""Bytes of a line that are kept: a cry stands at its beginning or its end."""


LOOK_S = 0.02
MOST_AHEAD = 1 << 16
"""Bytes that are taken of what was typed while nobody read."""
_REPORT = re.compile(rb"\x1b\[\d+;\d+R")
"""Where the cursor is, as the terminal answers the library, in between what people type."""


def typed_ahead(terminal: TextIO) -> bytes:
    """What was typed while nobody read it; nothing of a terminal that gathers lines."""
    fd, found = terminal.fileno(), b""
    try:
        if termios.tcgetattr(fd)[3] & termios.ICANON:
            return b""
        while len(found) < MOST_AHEAD and select.select([fd], [], [], 0)[0]:
            data = os.read(fd, MOST_AHEAD - len(found))
            if not data:
                break
            found += data
    except (OSError, termios.error):
        pass
    return found


class Ahead:
    """What is typed before the prompt of an executive that takes over reads the keyboard itself.

    That takes seconds on a busy machine, and the robot goes on meanwhile: a stop is heard at once.
    """

    def __init__(self, terminal: TextIO) -> None:
        """Take what was typed by now."""
        self._terminal = terminal
        self._data = typed_ahead(terminal)
        self._taken = threading.Event()
        self._thread: threading.Thread | None = None

    def hear(self, stop: Callable[[], None]) -> None:
        """Follow what is typed from now on, in a thread; `stop` is called once, if it asks for it.

        It is called here where that was typed already.
        """
        heard = asks_to_stop(self._data)
        if heard:
            stop()
        follow = threading.Thread(target=self._follow, args=(stop, heard), daemon=True)
        self._thread = follow
        follow.start()

    def take(self) -> bytes:
        """All that was typed; from here on the prompt reads."""
        self._taken.set()
        if self._thread is not None:
            self._thread.join()
        self._data += typed_ahead(self._terminal)
        return self._data

    def _follow(self, stop: Callable[[], None], heard: bool) -> None:
        while not self._taken.wait(LOOK_S) and len(self._data) < MOST_AHEAD:
            more = typed_ahead(self._terminal)
            self._data += more
            if more and not heard and asks_to_stop(self._data):
                heard = True
                stop()


def asks_to_stop(data: bytes) -> bool:
    """Whether what was typed to a robot at work has a stop in it: a key, or a line."""
    lines = Typed().take(data)
    return STOPS.search(data) is not None or any(is_stop(one) or is_stay(one) for one in lines)


class Typed:
    """Follows what is typed, byte by byte, and says which lines were entered.

    It knows nothing of how the line is edited but for the keys that rub out, so a line may have
    more in it than the one on the screen; that is enough to hear a cry to stop.
    """

    def __init__(self) -> None:
        """Nothing was typed yet."""
        self._line = b""

    def clear(self) -> None:
        """Forget what was typed so far."""
        self._line = b""

    def take(self, data: bytes) -> list[str]:
        """The lines that end in what was typed now, each as people may have meant it.

        A line with keys in it that are no letters is several: what follows an escape may be meant
        as text or not, and what follows the last such key may be meant by itself.
        """
        *ended, rest = re.split(rb"[\r\n]", _REPORT.sub(b"", self._line + data))
        self._line = rest if len(rest) <= KEPT else rest[: KEPT // 2] + rest[-KEPT // 2 :]
        return [text for line in ended for text in _readings(line)]


def _readings(line: bytes) -> list[str]:
    text = line.decode(errors="ignore").rpartition("\x15")[2]  # Ctrl-U
    readings = list(dict.fromkeys((without_sequences(text), text)))
    if tail := _KEYS.split(text)[1:]:
        readings.append(tail[-1])
    return [_rubbed_out(reading) for reading in readings]


def _rubbed_out(text: str) -> str:
    """What is left of a text with the keys in it that rub out a letter."""
    left: list[str] = []
    for one in text:
        if one in "\x7f\b":
            del left[-1:]
        elif one >= " ":
            left.append(one)
    return "".join(left)
