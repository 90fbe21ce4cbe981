"""What happened, as one JSON line an event; what reports, `why`, replay and resume read.

Two files stand side by side in a run folder:

- ``journal.jsonl`` holds events with the runtime's stamps only, so that the same `fast` run twice
  gives the same bytes;
- ``wall.jsonl`` holds, for each event's number, the wall-clock time at which it was written.

Every event is handed to the operating system before `write` returns, or, in the background, within
milliseconds: a `kill -9` loses at most the last tick. A disk that is full or stalled never stops
the robot: lines wait in memory, the oldest are dropped and counted, and they are written as soon as
that is possible again (`executive.journal.files`).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Container, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import msgspec

from executive.journal import holding
from executive.journal.files import BackgroundFile, LineFile, Lines, is_open
from robot.closing import Closing
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import open_ordinary

FILE, WALL_FILE = "journal.jsonl", "wall.jsonl"
CAPACITY = 20_000
MAX_LINE = 256_000
"""Bytes of a line; the longest are those of a tree and of a map, of 5 kB in a furnished flat."""
MAX_BYTES = 50_000_000
"""Of a journal that is gone on with or repeated: a day and a night of work."""
MOST_BYTES = 1_000_000_000
"""Of a journal that is read at all, at some 200 s for the longest."""
MOST_EVENTS, MOST_S = 2**53, 1e9
"""Numbers and times beyond are none."""
STALLED_S = 0.5

Listener = Callable[["Event"], None]


class Event(msgspec.Struct, frozen=True):
    """One line: number, stamp [s] of the runtime's clock, kind, and what belongs to the kind."""

    n: int
    t_s: float
    event: str
    data: dict[str, Any] = {}


class Journal(Closing):
    """The journal of one run: a context manager that closes its files."""

    def __init__(
        self,
        folder: Path | None = None,
        *,
        wall_s: Callable[[], float] | None = None,
        capacity: int = CAPACITY,
        background: bool = False,
        first: int = 0,
        wall_from: int = 0,
        lines: Lines | None = None,
    ) -> None:
        """Keep a journal.

        Args:
            folder: of the run; None keeps it in memory only.
            wall_s: reads the time of day.
            capacity: how many lines may wait for a disk that is full or stalled.
            background: write in a thread, so that a stalled disk cannot stop the caller.
            first: number of the first event, when a journal is gone on with.
            wall_from: events before that number get no time of day: it stands there already.
            lines: where the lines go in place of a file in `folder`.
        """
        kind = BackgroundFile if background else LineFile
        self._lines = lines
        self._wall: Lines | None = None
        if folder is not None and lines is None:
            self._lines = kind(folder / FILE, capacity=capacity)
        if folder is not None and wall_s is not None:
            self._wall = kind(folder / WALL_FILE, capacity=capacity)
        self._wall_s = wall_s
        self._wall_from = wall_from
        self._count = first
        self._behind_since_s: float | None = None
        self._problem = ""
        self._listeners: list[Listener] = []
        self.recent: deque[Event] = deque(maxlen=1000)

    def listen(self, listener: Listener) -> None:
        """Call `listener` with every event after it is written."""
        self._listeners.append(listener)

    @property
    def problem(self) -> str:
        """Why lines wait in memory instead of being on the disk; empty when all is well."""
        return self._problem

    @property
    def dropped(self) -> int:
        """How many lines were lost because they could not be written."""
        return self._lines.dropped if self._lines else 0

    def write(self, now_s: float, event: str, **data: Any) -> None:
        """Add an event. `data` must be deterministic: no wall-clock times, no memory addresses."""
        entry = Event(self._count, round(now_s, 4), event, data)
        self._count += 1
        self.recent.append(entry)
        problem = ""
        if self._lines is not None:
            waited = self._lines.waiting
            self._lines.append(encode(entry))
            problem = self._lines.problem or self._stalled(min(waited, self._lines.waiting), now_s)
        timed = entry.n >= self._wall_from
        if timed and self._wall is not None and self._wall_s is not None:
            wall = {"n": entry.n, "wall_s": round(self._wall_s(), 3)}
            self._wall.append(msgspec.json.encode(wall))
        for listener in self._listeners:
            listener(entry)
        self._judge(now_s, problem)

    def _stalled(self, waiting: int, now_s: float) -> str:
        """What is wrong when lines of a while ago still wait, though nothing failed."""
        if not waiting:
            self._behind_since_s = None
        elif self._behind_since_s is None:
            self._behind_since_s = now_s
        elif now_s - self._behind_since_s > STALLED_S:
            return f"the disk has taken nothing for {now_s - self._behind_since_s:.1f} s"
        return ""

    def _judge(self, now_s: float, problem: str) -> None:
        """Warn when the disk stops taking lines, and when it takes them again."""
        before, self._problem = self._problem, problem
        if problem and not before:
            self._tell(now_s, f"the journal cannot be written: {problem}")
        elif before and not problem:
            self._tell(now_s, f"the journal is written again, {self.dropped} lines lost")

    def _tell(self, now_s: float, text: str) -> None:
        """Warn people, without a line: a full disk must not change the journal's content."""
        warning = Event(-1, round(now_s, 4), "warning", {"text": text})
        for listener in self._listeners:
            listener(warning)

    def close(self) -> None:
        """Close the files; safe to call twice."""
        for lines in (self._lines, self._wall):
            if lines is not None:
                lines.close()


def encode(event: Event) -> bytes:
    """An event as its line in the file, without the line's end; always the same bytes."""
    flat = {"n": event.n, "t_s": event.t_s, "event": event.event, **event.data}
    return msgspec.json.encode(flat, enc_hook=str, order="deterministic")


def decode(line: bytes) -> Event | None:
    """The event of a line; None if it is none, such as a line that was cut."""
    try:
        flat = msgspec.json.decode(line, type=dict[str, Any])
        n, t_s, kind = flat.pop("n"), flat.pop("t_s"), flat.pop("event")
    except (msgspec.DecodeError, UnicodeDecodeError, KeyError, RecursionError):
        return None
    if not (isinstance(n, int) and isinstance(t_s, int | float) and isinstance(kind, str)):
        return None
    sane = 0 <= n < MOST_EVENTS and abs(t_s) < MOST_S
    return Event(n, float(t_s), kind, flat) if sane else None


PUT_BACK = "put the file itself in the place of the link"


def is_linked(folder: Path) -> bool:
    """Whether a run's journal is only a link, which is read but never written through."""
    return folder.is_dir() and (folder / FILE).is_symlink()


def lines(path: Path) -> Iterator[bytes]:
    """The lines of a journal, with their ends, one at a time; one that is too long is cut.

    Args:
        path: a run's folder, or the file itself.

    Raises:
        ConfigError: if there is no journal, or it is larger than any run's.
    """
    file = path / FILE if path.is_dir() else path
    try:
        if file.stat().st_size > MOST_BYTES:
            text = f"{file} is larger than {MOST_BYTES / 1e6:g} MB"
            raise ConfigError([Problem(text, suggestion="look at the journal of another run")])
        with open_ordinary(file) as source:
            while line := source.readline(MAX_LINE):
                end = line
                while len(end) == MAX_LINE and not end.endswith(b"\n"):  # more of the same line
                    end = source.readline(MAX_LINE)
                yield line if end is line else line[:-1] + b"\n"
    except OSError as error:
        raise ConfigError(f"{path} holds no journal: {error.strerror}") from error


def read(path: Path, *, without: Container[str] = ()) -> list[Event]:
    """The events of a journal that is finished, still written, or was cut off.

    Args:
        path: a run's folder, or the file itself.
        without: kinds of events that are left out; the last event stays, of whatever kind it is.

    Raises:
        ConfigError: if there is no journal, or it is too large to be held in memory.
    """
    check_size(path)
    found: list[Event] = []
    last: Event | None = None
    for line in lines(path):
        event = decode(line)
        last = event or last
        if event is not None and event.event not in without:
            found.append(event)
    return found if last is None or last in found[-1:] else [*found, last]


def size_bytes(path: Path) -> int:
    """Of the journal in a run's folder, or of the file itself; 0 where there is none."""
    with suppress(OSError):
        return (path / FILE if path.is_dir() else path).stat().st_size
    return 0


def check_size(path: Path) -> None:
    """Refuse a journal that is too large to be gone on with. Raises ConfigError."""
    file = path / FILE if path.is_dir() else path
    if size_bytes(path) > MAX_BYTES:
        text = f"{file} is larger than {MAX_BYTES / 1e6:g} MB"
        cure = "it can be looked at with humanoid why, but neither repeated nor gone on with"
        raise ConfigError([Problem(text, suggestion=cure)])


def is_written(folder: Path) -> bool:
    """Whether a run is under way: a process holds its folder, or has its journal open."""
    held = holding.is_held(folder)
    return is_open(folder / FILE) if held is None else held
