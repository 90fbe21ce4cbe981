"""Journals of played runs, with what the recorder writes."""

from __future__ import annotations

from executive.engine.recorder import Recorder
from executive.journal.journal import encode
from executive.journal.reader import Reader
from tests.fakes.rig import Rig


class Recorded(Rig):
    """A rig whose journal the recorder writes to after every tick."""

    def __init__(self, scripts=None, **how):
        super().__init__(scripts, **how)
        self.written: list[bytes] = []
        self.journal.listen(lambda event: self.written.append(encode(event) + b"\n"))
        self.recorder = Recorder(self.executive)

    def tick(self, count: int = 1):
        for _ in range(count):
            super().tick()
            self.recorder.update()
        return self

    def read(self):
        """The run as its journal tells it."""
        return read(self.written)


def read(lines):
    """A run from the lines of a journal."""
    reader = Reader()
    for line in lines:
        reader.line(line)
    return reader.run
