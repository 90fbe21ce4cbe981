"""The console's end of the desk: hands on what pages want, and brings back what is answered.

A stop is not lost to an executive that dies: until it is answered it is left for the one that takes
over, as `humanoid stop` does (`robot.bringup.mailbox`), and said to it again.
"""

from __future__ import annotations

import asyncio
import os
import stat
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path

import msgspec

from executive.frontends.console.desk import FILE, OF, SOCKET, Of, Order, Place, of
from executive.frontends.console.pace import is_cry
from robot.bringup import mailbox
from robot.files.ordinary_files import read_secret

AGAIN_S = 0.3
TAKE_OVER_S = 60.0
"""So long a stop waits for an executive that takes over."""
MAX_ANSWER = 1 << 20
MOST_WORDS = 300
"""What was answered, the newest; a page that comes later is told that much."""


class Steering:
    """A connection to the desk of a run, as long as there is one, and one for stops alone.

    Attributes:
        words: what was said and answered, as JSON.
        count: how many there were so far.
        asks: what the robot asks a person, as JSON; empty before it is known.
    """

    def __init__(self, folder: Path, *, now_s: Callable[[], float]) -> None:
        """Connect to nothing yet; `now_s` is the run's time, by which words are ordered."""
        self._now_s = now_s
        self.words: deque[bytes] = deque(maxlen=MOST_WORDS)
        self.count = 0
        self.asks = b""
        self._folder = folder
        self._writer: asyncio.StreamWriter | None = None
        self._cries: asyncio.StreamWriter | None = None
        self._private: Path | None = None
        self._cry: tuple[float, Order] | None = None

    @property
    def reaches(self) -> bool:
        """Whether a stop arrives, be it at an executive that only takes over."""
        if self.open:
            return True
        private = self._private
        return private is not None and private.is_dir() and _place(self._folder) is not None

    @property
    def open(self) -> bool:
        """Whether what is sent arrives."""
        return self._writer is not None and not self._writer.is_closing()

    def send(self, order: Order) -> bool:
        """Hand on an order at once; whether there is anybody to take it, now or soon."""
        cried = is_cry(order)
        if cried and self.reaches:
            self._cry = (time.monotonic(), order)
        if self._writer is None or not self.open:
            return self._cried_again()
        past = self._cries if cried else None  # all that was said before may take its time
        writer = self._writer if past is None or past.is_closing() else past
        writer.write(msgspec.json.encode(order) + b"\n")
        return True

    def _cried_again(self) -> bool:
        """Leave a stop that was not answered for the executive that takes over, if one may."""
        if self._cry is None or self._private is None:
            return False
        if not self.reaches or time.monotonic() > self._cry[0] + TAKE_OVER_S:
            self._cry = None
            return False
        mailbox.leave_stop_for_next(self._private)
        return True

    async def work(self) -> None:
        """Keep a connection, for ever."""
        while True:
            with suppress(OSError, ValueError, asyncio.IncompleteReadError):
                await self._converse()
            self._writer = self._cries = None
            self._cried_again()
            await asyncio.sleep(AGAIN_S)

    async def _converse(self) -> None:
        path = _place(self._folder)
        if path is None:
            return
        reader, writer = await asyncio.open_unix_connection(path, limit=MAX_ANSWER)
        try:
            unheard, self._cries = await asyncio.open_unix_connection(path)
        except OSError:
            writer.close()
            raise
        emptying = asyncio.create_task(_empty(unheard, self._cries))
        self._writer = writer
        self._private = Path(path).parent
        if self._cry is not None:
            writer.write(msgspec.json.encode(self._cry[1]) + b"\n")
        try:
            while line := await reader.readline():
                self._take(line.strip())
        finally:
            emptying.cancel()
            self._cries.close()
            writer.close()

    def _take(self, line: bytes) -> None:
        news = msgspec.json.decode(line, type=dict[str, msgspec.Raw])
        if "asks" in news:
            self.asks = bytes(news["asks"])
            return
        if "out" in news:
            self._cry = None
        self._keep(news)

    def say(self, text: str) -> None:
        """Tell every page something that is not the robot's."""
        self._keep({"out": text})

    def _keep(self, news: Mapping[str, object]) -> None:
        told = {"t_s": round(self._now_s(), 3), **news}
        self.words.append(msgspec.json.encode({"word": told}))
        self.count += 1

    @property
    def asked(self) -> bool:
        """Whether the robot asks a person something."""
        return self.asks not in (b"", b"null")

    @property
    def first(self) -> int:
        """Number of the oldest word that is kept."""
        return self.count - len(self.words)


async def _empty(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Read, and forget, what is told on a connection that is only spoken on, until it ends."""
    with suppress(OSError):
        while await reader.read(MAX_ANSWER):
            pass
    writer.close()


def _place(folder: Path) -> str | None:
    """The socket of a run's desk, if it is this user's own, and is the desk of that very run."""
    try:
        owner = folder.stat().st_uid
        place = msgspec.json.decode(read_secret(folder / FILE, limit=4096), type=Place)
        path = Path(place.socket)
        private, found = path.parent.lstat(), path.lstat()
        whose = msgspec.json.decode(read_secret(path.with_name(OF), limit=4096), type=Of)
        is_its_own = whose == of(folder) and path.name == SOCKET
    except (OSError, msgspec.DecodeError, ValueError):
        return None
    own = owner == os.geteuid() == found.st_uid == private.st_uid
    closed = stat.S_ISDIR(private.st_mode) and not private.st_mode & 0o077
    return place.socket if own and closed and is_its_own and stat.S_ISSOCK(found.st_mode) else None
