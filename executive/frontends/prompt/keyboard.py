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
from prompt_toolkit.input.typeahead import clear_typeahead
from prompt_toolkit.input.vt100 import Vt100Input, raw_mode
from prompt_toolkit.key_binding import KeyPress

from executive.frontends.prompt.typed import COLOUR, Typed

STOPS = re.compile(rb"([\x03\x1c])")
"""Ctrl-C and Ctrl-\\, which end a program anywhere else."""
_CHUNK = 4096
MOST_CHUNKS = 4096
"""16 MiB that the library has not read yet; beyond that only stops are heard."""


class _Chunk(NamedTuple):
    """What was typed at once, by its number; nothing of a key to stop that was heeded."""

    data: bytes
    number: int
    is_key: bool


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
    ) -> None:
        """Listen to nothing yet.

        Args:
            stdin: the terminal.
            stop: called when a key to stop was pressed; whether there was something to stop.
            is_cry: whether a line that was entered, as far as that can be known, is to stop
                something.
            cried: called when such a line was entered.
        """
        super().__init__(stdin)
        self._stop = stop
        self._is_cry = is_cry
        self._cried = cried
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
            self._sent += 1
            is_key = STOPS.fullmatch(part) is not None
            heeded = self._heed_key() if is_key else self._heed_lines(part)
            if is_key or len(self._chunks) < MOST_CHUNKS:
                self._chunks.append(_Chunk(b"" if heeded and is_key else part, self._sent, is_key))
            self._tell()

    def _heed_key(self) -> bool:
        self._typed.clear()
        self._last_stop = self._sent  # first, so that no line of before slips in between
        return self._stop()

    def _heed_lines(self, part: bytes) -> bool:
        cried = any(self._is_cry(line) for line in self._typed.take(part))
        if cried:
            self._last_stop = self._sent
            self._cried()
        return cried

    def _tell(self) -> None:
        with contextlib.suppress(BlockingIOError):  # it is full: the library will look anyway
            os.write(self._wake, b"\0")

    # --- the library's side ---

    def read_keys(self) -> list[KeyPress]:
        """The keys since the last time.

        A Ctrl-C ends whatever sequence or paste was not over, and undoes what was typed before it
        and is not a line yet because the library has lines before that to see to.
        """
        with contextlib.suppress(BlockingIOError):
            os.read(self._ready, _CHUNK)
        while self._chunks:
            part = self._chunks.popleft()
            if part.is_key:
                self._drop()
            self.vt100_parser.feed(COLOUR.sub("", self._decoder.decode(part.data)))
            self._reached = part.number
        return super().flush_keys() if self._ended else self._keys()

    def _drop(self) -> None:
        self._decoder.reset()
        self.vt100_parser.reset()
        pending = [*self._buffer, *get_app().key_processor.input_queue]
        if any(
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
