"""Compares what a run writes with what it wrote the first time, byte for byte."""

from __future__ import annotations

import msgspec

from executive.journal.files import Lines
from executive.journal.journal import Event, decode

CONTEXT = 3


class Difference(msgspec.Struct, frozen=True, kw_only=True):
    """The first event that is another one: `recorded` and `now` as lines, None where there is none.

    `before` are the events that led up to it.
    """

    number: int
    recorded: str | None
    now: str | None
    before: tuple[Event, ...] = ()

    @property
    def fields(self) -> dict[str, tuple[object, object]]:
        """What differs, field by field: as recorded, and now."""
        then, now = _flat(self.recorded), _flat(self.now)
        names = [*then, *(name for name in now if name not in then)]
        return {n: (then.get(n), now.get(n)) for n in names if then.get(n) != now.get(n)}


class Checked:
    """`Lines` that are compared with recorded ones; what comes after those goes to `onward`.

    Attributes:
        difference: the first one; None while all is the same.
        count: lines that were the same.
    """

    dropped = 0

    def __init__(self, recorded: list[bytes], *, onward: Lines | None = None) -> None:
        """Compare with `recorded`; without `onward`, a line after the last of them differs."""
        self.difference: Difference | None = None
        self.count = 0
        self._recorded = recorded
        self._onward = onward

    @property
    def complete(self) -> bool:
        """Whether everything that was recorded has come."""
        return self.count == len(self._recorded)

    @property
    def waiting(self) -> int:
        """How many lines of the part after the recorded ones are in memory only."""
        return self._onward.waiting if self._onward is not None else 0

    @property
    def problem(self) -> str:
        """Why they wait."""
        return self._onward.problem if self._onward is not None else ""

    def append(self, line: bytes) -> None:
        """Compare a line, or pass it on."""
        if self.difference is not None:
            return
        if not self.complete and self._recorded[self.count] == line:
            self.count += 1
        elif self.complete and self._onward is not None:
            self._onward.append(line)
        else:
            recorded = None if self.complete else self._recorded[self.count]
            self._differs(recorded, line)

    def end(self) -> None:
        """Nothing more comes: what was recorded and has not come is a difference."""
        if self.difference is None and not self.complete:
            self._differs(self._recorded[self.count], None)

    def close(self) -> None:
        """Close what comes after."""
        if self._onward is not None:
            self._onward.close()

    def _differs(self, recorded: bytes | None, now: bytes | None) -> None:
        before = [
            decode(line) for line in self._recorded[max(0, self.count - CONTEXT) : self.count]
        ]
        self.difference = Difference(
            number=self.count,
            recorded=recorded.decode() if recorded is not None else None,
            now=now.decode() if now is not None else None,
            before=tuple(event for event in before if event is not None),
        )


def _flat(line: str | None) -> dict[str, object]:
    event = decode(line.encode()) if line is not None else None
    return {} if event is None else {"event": event.event, "t_s": event.t_s, **event.data}
