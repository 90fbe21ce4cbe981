"""What happened, as one JSON line an event; what reports, `why`, replay and resume read.

Two files stand side by side in a run folder:

- ``journal.jsonl`` holds events with the runtime's stamps only, so that the same `fast` run twice
  gives the same bytes;
- ``wall.jsonl`` holds, for each event's number, the wall-clock time at which it was written.

Every event is handed to the operating system before `write` returns. A disk that is full never
stops the robot: lines wait in a ring in memory, the oldest are dropped and counted, and they are
written as soon as there is room again.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import msgspec

RING_LINES = 20_000

Listener = Callable[["Event"], None]


class Event(msgspec.Struct, frozen=True):
    """One line: number, stamp [s] of the runtime's clock, kind, and what belongs to the kind."""

    n: int
    t_s: float
    event: str
    data: dict[str, Any] = {}


class LineFile:
    """A file that lines are appended to, which never raises and never loses half a line."""

    def __init__(self, path: Path | None, *, capacity: int = RING_LINES) -> None:
        """Append to `path` (None: keep lines in memory only), holding back at most `capacity`."""
        self._waiting: deque[bytes] = deque()
        self._capacity = capacity
        self._begun = False
        self._file: int | None = None
        self.dropped = 0
        self.problem = ""
        if path is None:
            return
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC
            self._file = os.open(path, flags, 0o644)
        except OSError as error:
            self.problem = f"{path}: {error.strerror}"

    @property
    def waiting(self) -> int:
        """How many lines are in memory only."""
        return len(self._waiting)

    def append(self, line: bytes) -> None:
        """Write a line, and whatever waited for room before it."""
        self._waiting.append(line + b"\n")
        if len(self._waiting) > self._capacity:
            del self._waiting[1 if self._begun else 0]
            self.dropped += 1
        self._flush()

    def _flush(self) -> None:
        if self._file is None:
            return
        try:
            while self._waiting:
                written = os.write(self._file, self._waiting[0])
                if written < len(self._waiting[0]):
                    self._waiting[0] = self._waiting[0][written:]
                    self._begun = True
                else:
                    self._waiting.popleft()
                    self._begun = False
            self.problem = ""
        except OSError as error:
            self.problem = error.strerror or str(error)

    def close(self) -> None:
        """Close the file; safe to call twice."""
        if self._file is not None:
            self._flush()
            os.close(self._file)
            self._file = None


class Journal:
    """The journal of one run: a context manager that closes its files."""

    def __init__(
        self,
        folder: Path | None = None,
        *,
        wall_s: Callable[[], float] | None = None,
        capacity: int = RING_LINES,
    ) -> None:
        """Keep a journal in `folder` (None: in memory only); `wall_s` reads the time of day."""
        self._lines = LineFile(folder and folder / "journal.jsonl", capacity=capacity)
        self._wall = LineFile(folder and folder / "wall.jsonl" if wall_s else None, capacity=1000)
        self._wall_s = wall_s
        self._count = 0
        self._warned = False
        self._listeners: list[Listener] = []
        self.recent: deque[Event] = deque(maxlen=1000)

    def listen(self, listener: Listener) -> None:
        """Call `listener` with every event after it is written."""
        self._listeners.append(listener)

    @property
    def problem(self) -> str:
        """Why lines wait in memory instead of being on the disk; empty when all is well."""
        return self._lines.problem

    def write(self, now_s: float, event: str, **data: Any) -> None:
        """Add an event. `data` must be deterministic: no wall-clock times, no memory addresses."""
        entry = Event(self._count, round(now_s, 4), event, data)
        self._count += 1
        self.recent.append(entry)
        flat = {"n": entry.n, "t_s": entry.t_s, "event": event, **data}
        self._lines.append(msgspec.json.encode(flat, enc_hook=str, order="deterministic"))
        if self._wall_s is not None:
            wall = {"n": entry.n, "wall_s": round(self._wall_s(), 3)}
            self._wall.append(msgspec.json.encode(wall))
        for listener in self._listeners:
            listener(entry)
        if self._lines.problem and not self._warned:
            self._warned = True
            self._tell(now_s, f"the journal cannot be written: {self._lines.problem}")
        elif self._warned and not self._lines.problem:
            self._warned = False
            self._tell(now_s, f"the journal is written again, {self._lines.dropped} lines lost")

    def _tell(self, now_s: float, text: str) -> None:
        """Warn people, without a line: a full disk must not change the journal's content."""
        warning = Event(-1, round(now_s, 4), "warning", {"text": text})
        for listener in self._listeners:
            listener(warning)

    def close(self) -> None:
        """Close the files; safe to call twice."""
        self._lines.close()
        self._wall.close()

    def __enter__(self) -> Self:
        """Return the journal itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the files."""
        self.close()
