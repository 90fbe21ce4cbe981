"""A real terminal: a program on a pty, keys that go in, and the screen as a person sees it."""

import contextlib
import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
import threading
from pathlib import Path

import pyte

from robot.closing import Closing
from tests.fakes.waiting import eventually

COLUMNS, ROWS = 100, 30
ENTER, TAB, UP = "\r", "\t", "\x1b[A"
CTRL_C, CTRL_D, CTRL_U = "\x03", "\x04", "\x15"


class Terminal(Closing):
    """Runs `humanoid ARGUMENTS` on a terminal of its own; a context manager."""

    def __init__(self, *arguments: str, folder: Path) -> None:
        self.screen = pyte.Screen(COLUMNS, ROWS)
        self._stream = pyte.ByteStream(self.screen)
        self._lock = threading.Lock()
        main, child = pty.openpty()
        fcntl.ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, COLUMNS, 0, 0))
        environment = {**os.environ, "TERM": "xterm-256color", "HOME": str(folder)}
        environment["PYTHONPATH"] = str(Path(__file__).parents[2])
        self._main = main
        self.process = subprocess.Popen(
            [sys.executable, "-m", "executive", *arguments],
            stdin=child, stdout=child, stderr=child, cwd=folder, env=environment,
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),  # noqa: PLW1509
        )  # fmt: skip
        os.close(child)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        while True:
            try:
                if not select.select([self._main], [], [], 0.2)[0]:
                    continue
                data = os.read(self._main, 65536)
            except OSError:
                return
            if not data:
                return
            with self._lock:
                self._stream.feed(data)
            if b"\x1b[6n" in data:  # where is the cursor?
                where = f"\x1b[{self.screen.cursor.y + 1};{self.screen.cursor.x + 1}R"
                os.write(self._main, where.encode())

    def press(self, keys: str) -> None:
        os.write(self._main, keys.encode())

    def enter(self, line: str) -> None:
        self.press(line + ENTER)

    @property
    def lines(self) -> list[str]:
        with self._lock:
            return [line.rstrip() for line in self.screen.display]

    @property
    def text(self) -> str:
        return "\n".join(self.lines)

    def shows(self, words: str) -> bool:
        return eventually(lambda: words in self.text)

    def close(self) -> None:
        if self.process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        os.close(self._main)
        self._reader.join()
