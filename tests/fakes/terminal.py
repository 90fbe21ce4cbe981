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
WHERE = b"\x1b[6n"
"""By this a program asks where the cursor is."""


class Pty(Closing):
    """Runs a Python program on a pty, of which it is the whole session; a context manager.

    Attributes:
        reads: whether the terminal takes what the program writes; a stalled one does not.
    """

    def __init__(
        self, *arguments: str, folder: Path, columns: int = COLUMNS, pass_fds: tuple[int, ...] = ()
    ) -> None:
        self.reads = True
        self._main, child = pty.openpty()
        _set_size(child, columns, ROWS)
        environment = {**os.environ, "TERM": "xterm-256color", "HOME": str(folder)}
        environment["PYTHONPATH"] = str(Path(__file__).parents[2])
        self.process = subprocess.Popen(
            [sys.executable, *arguments],
            stdin=child, stdout=child, stderr=child, cwd=folder, env=environment,
            start_new_session=True, pass_fds=pass_fds,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),  # noqa: PLW1509
        )  # fmt: skip
        os.close(child)
        self._closing = threading.Event()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        before = b""
        while not self._closing.is_set():
            try:
                if not self.reads or not select.select([self._main], [], [], 0.2)[0]:
                    self._closing.wait(0.0 if self.reads else 0.01)
                    continue
                data = os.read(self._main, 65536)
                if not data:
                    return
                self._shown(data)
                if WHERE in before + data:  # which may come in two pieces
                    os.write(self._main, self._where_the_cursor_is())
                before = (before + data)[1 - len(WHERE) :]
            except OSError:
                return

    def _shown(self, data: bytes) -> None:
        """Take what the program writes."""

    def _where_the_cursor_is(self) -> bytes:
        return b"\x1b[1;1R"

    def press(self, keys: str | bytes) -> None:
        os.write(self._main, keys if isinstance(keys, bytes) else keys.encode())

    def enter(self, line: str) -> None:
        self.press(line + ENTER)

    def resize(self, columns: int, rows: int) -> None:
        _set_size(self._main, columns, rows)

    def hang_up(self) -> None:
        """Close the terminal, as a window is closed or a line is cut."""
        self._closing.set()
        self._reader.join()
        if self._main >= 0:
            os.close(self._main)
            self._main = -1

    def close(self) -> None:
        if self.process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.hang_up()


def _set_size(fd: int, columns: int, rows: int) -> None:
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))


class Terminal(Pty):
    """Runs `humanoid ARGUMENTS` on a terminal with a screen; a context manager."""

    def __init__(self, *arguments: str, folder: Path, columns: int = COLUMNS) -> None:
        self.screen = pyte.Screen(columns, ROWS)
        self._stream = pyte.ByteStream(self.screen)
        self._lock = threading.Lock()
        super().__init__("-m", "executive", *arguments, folder=folder, columns=columns)

    def _shown(self, data: bytes) -> None:
        with self._lock:
            self._stream.feed(data)

    def _where_the_cursor_is(self) -> bytes:
        return f"\x1b[{self.screen.cursor.y + 1};{self.screen.cursor.x + 1}R".encode()

    @property
    def lines(self) -> list[str]:
        with self._lock:
            return [line.rstrip() for line in self.screen.display]

    @property
    def text(self) -> str:
        return "\n".join(self.lines)

    def shows(self, words: str) -> bool:
        return eventually(lambda: words in self.text)
