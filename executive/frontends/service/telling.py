"""What a robot says, to all who want to hear it: its own output, its log, and whoever watches.

None of them may hold the robot up: lines are printed and written in threads of their own, and a
watcher that does not read is let go.
"""

from __future__ import annotations

import time
from pathlib import Path

from executive.journal.files import BackgroundFile
from robot.files.ordinary_files import make_below
from robot.printable import printable_line

LOG = "service.log"
"""In `logs` of a run's folder: what was said to the robot and by it."""
MOST_LOG_BYTES = 20_000_000
MOST_WAITING = 5_000
"""Lines for a disk that takes none; further ones are left out."""


class Log:
    """The file of what was said, with the time of day; it ends growing somewhere."""

    def __init__(self, run: Path) -> None:
        """Write into the folder of a run, if that can be."""
        folder = run / "logs"
        try:
            make_below(run, folder)
            self._room = MOST_LOG_BYTES - file_size(folder / LOG)
        except OSError:
            self._room = 0
        self._file = BackgroundFile(folder / LOG, capacity=MOST_WAITING)

    def append(self, text: str) -> None:
        """Add the lines of a text."""
        for line in text.split("\n"):
            stamped = f"{time.strftime('%Y-%m-%d %H:%M:%S')}  {printable_line(line)}".encode()
            self._room -= len(stamped)
            if self._room > 0:
                self._file.append(stamped)

    def close(self) -> None:
        """Write what can be written soon."""
        self._file.close()


def file_size(path: Path) -> int:
    """Bytes of a file; none where there is none."""
    try:
        return path.stat().st_size
    except OSError:
        return 0
