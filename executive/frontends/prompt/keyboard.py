"""The keyboard, heard in a thread of its own before the input library gets what is typed.

The library may be anywhere when a person wants the robot to stand: in a paste without an end, half
an escape sequence, a search, a key that waits for another, a mistake of its own, or stuck writing
to a terminal that does not read. So Ctrl-C, and a line that is a cry to stop, act here.
"""

from __future__ import annotations

import codecs
import contextlib
import os
import re
import select
import threading
from collections import deque
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import NamedTuple, Self, TextIO

from prompt_toolkit.application import get_app
from prompt_toolkit.input.ansi_escape_sequences import ANSI_SEQUENCES
from prompt_toolkit.input.typeahead import clear_typeahead
from prompt_toolkit.input.vt100 import Vt100Input, raw_mode
from prompt_toolkit.key_binding import KeyPress
from prompt_toolkit.keys import Keys

from executive.frontends.prompt.typed import COLOUR, STOPS, Typed

_LINE_END = re.compile(rb"[\r\n]")
HEEDED = Keys.SIGINT
"""Tells the library of a stop that was heeded; no terminal can send it. Its data is the line that
was a cry, and empty for a key."""
ANSI_SEQUENCES.setdefault("\x1b[201~", Keys.Ignore)  # the end of a paste that a stop has ended
_CHUNK = 4096
MOST_CHUNKS = 4096
"""16 MiB that the library has not read yet; beyond that only stops are heard."""


class _Chunk(NamedTuple):
    """What was typed at once, by its number; a key to stop by itself, a heeded cry as its line."""

    data: bytes
    number: int
    is_key: bool = False
    heeded: str | None = None


class Keyboard(Vt100Input):
    """The terminal as the library's input; raw from entering to leaving, also between two lines.

    A terminal that is not raw would hand Ctrl-C to whoever is there as a signal, and a line only
    once it is ended.
    """

    def __init__(
        self,
        stdin: TextIO,
        *,
        stop: Callable[[], bool],
        is_cry: Callable[[str], bool],
        cried: Callable[[], None],
        ahead: bytes = b"",
    ) -> None:
        """Listen to nothing yet.

        Args:
            stdin: the terminal.
            stop: called when a key to stop was pressed; whether there was something to stop.
            is_cry: whether a line that was entered, as far as that can be known, is to stop
                something.
            cried: called when such a line was entered.
            ahead: what was typed before.
        """
        super().__init__(stdin)
        self._stop = stop
        self._is_cry = is_cry
        self._cried = cried
        self._ahead = ahead
        self._sent = self._last_stop = self._reached = 0
        self._typed = Typed()
        self._terminal = stdin.fileno()
        self._raw = raw_mode(self._terminal)
        self._decoder = codecs.getincrementaldecoder("utf-8")(errors="replace")
        self._chunks: deque[_Chunk] = deque()
        self._ended = False
        self._ready, self._wake = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
        self._left, self._leave = os.pipe2(os.O_CLOEXEC)
        self._thread = threading.Thread(target=self._listen, name="keyboard", daemon=True)

    def __enter__(self) -> Self:
        """Listen."""
        self._raw.__enter__()
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """Listen no more; the terminal is as it was."""
        os.write(self._leave, b"\0")
        self._thread.join()
        self._raw.__exit__()
        for fd in (self._ready, self._wake, self._left, self._leave):
            os.close(fd)

    # --- the thread ---

    def _listen(self) -> None:
        if self._ahead:
            self._take(self._ahead)
        poll = select.poll()
        poll.register(self._terminal, select.POLLIN)
        poll.register(self._left, select.POLLIN)
        while not any(fd == self._left for fd, _ in poll.poll()):
            try:
                data = os.read(self._terminal, _CHUNK)
            except OSError:  # the terminal was closed
                data = b""
            if not data:
                self._ended = True
                self._tell()
                return
            self._take(data)

    def _take(self, data: bytes) -> None:
        """Act on what stops, and pass everything on."""
        for part in STOPS.split(data):
            if STOPS.fullmatch(part):
                self._heed_key(part)
            elif part:
                self._heed_lines(part)
            self._tell()

    def _heed_key(self, part: bytes) -> None:
        self._typed.clear()
        self._sent += 1
        self._last_stop = self._sent  # first, so that no line of before slips in between
        heeded = "" if self._stop() else None
        self._chunks.append(_Chunk(part, self._sent, is_key=True, heeded=heeded))

    def _heed_lines(self, part: bytes) -> None:
        """A heeded line is passed on as what was heard: the editor may have half of it."""
        begin = at = 0
        for end in [*(found.end() for found in _LINE_END.finditer(part)), len(part)]:
            cry = next((line for line in self._typed.take(part[at:end]) if self._is_cry(line)), "")
            at = end
            if not cry:
                continue
            self._sent += 1
            self._last_stop = self._sent
            self._cried()
            self._chunks.append(_Chunk(part[begin:end], self._sent, heeded=cry))
            begin = end
        if begin < len(part) and len(self._chunks) < MOST_CHUNKS:
            self._sent += 1
            self._chunks.append(_Chunk(part[begin:], self._sent))

    def _tell(self) -> None:
        with contextlib.suppress(BlockingIOError):  # it is full: the library will look anyway
            os.write(self._wake, b"\0")

    # --- the library's side ---

    def read_keys(self) -> list[KeyPress]:
        """The keys since the last time.

        A stop ends whatever sequence or paste was not over, and undoes what was typed before it:
        a key all of that, a line what is not a line yet because the library has lines before that
        to see to.
        """
        with contextlib.suppress(BlockingIOError):
            os.read(self._ready, _CHUNK)
        while self._chunks:
            part = self._chunks.popleft()
            if part.is_key or part.heeded is not None:
                self._drop(all_of_it=part.is_key)
            if part.heeded is not None:
                self._buffer.append(KeyPress(HEEDED, part.heeded))
            else:
                self.vt100_parser.feed(COLOUR.sub("", self._decoder.decode(part.data)))
            self._reached = part.number
        return super().flush_keys() if self._ended else self._keys()

    def _drop(self, *, all_of_it: bool) -> None:
        """Undo the keys that were not seen to: all, or only where there are lines among them."""
        self._decoder.reset()
        self.vt100_parser.reset()
        get_app().key_processor.key_buffer.clear()  # a key that waits for another
        pending = [*self._buffer, *get_app().key_processor.input_queue]
        if all_of_it or any(
            end in key.data for key in pending for end in "\r\n"
        ):  # else it is what is being edited
            self._buffer.clear()
            get_app().key_processor.empty_queue()
            clear_typeahead(self)

    @property
    def behind(self) -> bool:
        """Whether the library is at keys from before a stop, so that their lines do not count."""
        return self._reached < self._last_stop

    def _keys(self) -> list[KeyPress]:
        keys, self._buffer = self._buffer, []
        return keys

    @property
    def closed(self) -> bool:
        """Whether nothing will come any more."""
        return self._ended and not self._chunks

    def fileno(self) -> int:
        """What is ready to be read when there are keys."""
        return self._ready

    def raw_mode(self) -> AbstractContextManager[None]:
        """It is raw."""
        return contextlib.nullcontext()

    def cooked_mode(self) -> AbstractContextManager[None]:
        """It stays raw, also while something is written above the prompt."""
        return contextlib.nullcontext()
