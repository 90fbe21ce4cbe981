"""Where the executive takes orders from pages: a socket that only this user reaches.

What comes is a line of JSON, an `Order`; what goes back, to all who are connected, is what the
robot answers. It is the prompt's shell that does it, so a stop is a stop and words mean what they
mean at the prompt. A stop acts in the thread that reads it; who does not read is let go.
"""

from __future__ import annotations

import os
import socket
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

import msgspec

from executive.frontends.emergency import AT_THE_ROBOT, undoes
from executive.frontends.line_server import LineServer, is_own
from executive.frontends.output import as_mistake
from executive.frontends.printer import Printer
from executive.frontends.reading_back import Risk, doubtful_risk, heard_risk
from robot.closing import Closing
from robot.errors import RobotError
from robot.printable import printable_line

FILE = "desk.json"
"""In the folder of a run: where its desk is."""
SOCKET = "desk.sock"
OF = "desk.of"
MOST_CLIENTS = 16
"""A console is two: what it hands on, and stops."""
MOST_LINES = 50
"""Lines that may wait; who types faster is told."""
MAX_LINE = 1 << 14
MAX_ORDER = 1 << 16
LOOK_S = 0.2
"""How often it is looked whether the robot asks something."""
LEAVING = ("quit", "exit")
GOING_ON = ("release", "reset", "resume")
"""Buttons after which the robot may move: a stop that was pressed after them has the last word."""


class Place(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Where a desk is: the path of its socket."""

    socket: str


class Of(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Whose desk it is, beside its socket: the folder of its run, which nobody else's file names.

    A run may come from anywhere, and name any socket; only the executive of that very folder says
    so here.
    """

    device: int
    inode: int


class Order(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """What a page wants: a button that was pressed (`do`), or a `line` as at the prompt, or words.

    Attributes:
        heard: what was said into the page's microphone, in place of a line; with `do` "stop" a cry.
        doubtful: the words of it that were not heard well; `sure`: whether it was heard well.
        begun_s: when it came from the page, in seconds since boot. Stops overtake what a page said
            before them, and that is about them still when it arrives (None: as when it arrives).
    """

    do: str = ""
    line: str = ""
    heard: str = ""
    doubtful: tuple[str, ...] = ()
    sure: bool = True
    begun_s: float | None = None


class Steered(Protocol):
    """What does as it is told: the prompt's shell.

    Attributes:
        out: says a line to people.
    """

    out: Callable[[str], None]

    @property
    def stops(self) -> int:
        """How often it was told to stop."""
        ...

    @property
    def asked(self) -> tuple[str, tuple[str, ...]] | None:
        """What a person is asked, and what can be answered."""
        ...

    def stops_by(self, begun_s: float | None) -> int:
        """How often it had been told to stop by then, in seconds since boot (None: by now)."""
        ...

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs; from any thread."""
        ...

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop; never waits."""
        ...

    @property
    def asks(self) -> bool:
        """Whether a person is asked something."""
        ...

    def halt_at_once(self, text: str, *, busy: bool | None = None, spoken: bool = False) -> bool:
        """Halt if a line is a cry that ends nothing; never waits."""
        ...

    def help(self, text: str) -> bool:
        """Tell a job that asks for help what a line answers; whether it is an answer."""
        ...

    def hear(self, text: str, *, stops: int, risk: Risk | None = None) -> None:
        """Do what a sentence says that was heard when `stops` was so much."""
        ...

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Do what a line says that was typed when `stops` was so much."""
        ...

    def command(self, name: str) -> None:
        """Do what a command of the prompt does that takes no words."""
        ...


class Desk(Closing):
    """A context manager: takes orders inside."""

    def __init__(self, shell: Steered, *, folder: Path, private: Path) -> None:
        """Listen in a private folder, and say in the run's folder where.

        Raises:
            OSError: if there is no room for a socket.
        """
        self._shell = shell
        self._folder = folder
        self._path = private / SOCKET
        self._path.unlink(missing_ok=True)  # what an executive before this one left
        listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        listening.bind(str(self._path))
        listening.listen(MOST_CLIENTS)
        self._closing = threading.Event()
        self._asks: bytes = _news(asks=None)
        self._waiting = 0
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="page lines")
        self._server = LineServer(
            listening,
            heed=lambda _, line: self._take_order(line),
            is_welcome=is_own,
            greet=lambda client: client.send(self._asks),
            most_clients=MOST_CLIENTS,
            longest=MAX_ORDER,
        )
        self._out = shell.out
        self._printer = Printer(shell.out)  # a terminal that is full keeps no stop back
        shell.out = self._tee(self._printer)
        _write(private / OF, of(folder))
        _write(folder / FILE, Place(socket=str(self._path)))
        threading.Thread(target=self._look, name="desk", daemon=True).start()

    def close(self) -> None:
        """Take no more orders."""
        if self._closing.is_set():
            return
        self._closing.set()
        self._shell.out = self._out
        self._printer.close()
        with suppress(OSError):
            (self._folder / FILE).unlink(missing_ok=True)
        self._server.close()
        self._path.unlink(missing_ok=True)
        with suppress(OSError):
            self._path.with_name(OF).unlink(missing_ok=True)
        self._worker.shutdown(wait=False, cancel_futures=True)

    # --- what goes back ---

    def _tee(self, out: Callable[[str], None]) -> Callable[[str], None]:
        def tell(text: str) -> None:
            out(text)
            self._server.tell(_news(out=text))

        return tell

    def _look(self) -> None:
        """Tell what is asked of a person whenever that is something else."""
        while not self._closing.wait(LOOK_S):
            asks = _news(asks=self._question())
            if asks != self._asks:
                self._asks = asks
                self._server.tell(asks)

    def _question(self) -> dict[str, Any] | None:
        asked = self._shell.asked
        return {"question": asked[0], "choices": asked[1]} if asked else None

    # --- what comes ---

    def _take_order(self, line: bytes) -> None:
        with suppress(msgspec.DecodeError, RecursionError):
            self._heed(msgspec.json.decode(line, type=Order))

    def _heed(self, order: Order) -> None:
        """Do what can be done at once, here; a mistake in it ends nothing."""
        try:
            stops = self._shell.stops_by(order.begun_s)
            if order.do:
                self._press(order.do, stops)
            elif order.heard.strip():
                self._take_heard(order, stops)
            elif order.line.strip():
                self._take(order.line, stops)
        except RobotError as error:
            self._shell.out(f"Not done: {error}")
        except Exception as error:
            self._shell.out(as_mistake(error))

    def _press(self, button: str, stops: int) -> None:
        shell = self._shell
        if button == "stop":
            shell.stop("STOP was pressed on the page")
        elif button == "estop":
            shell.stop_at_once("estop")
        elif button in GOING_ON and stops != shell.stops:
            shell.out(f"Not done: {button} was pressed before the robot was told to stop.")
        elif button in ("release", "reset"):
            shell.stop_at_once(f"estop {button}")
        elif button in ("pause", "resume", "cancel"):
            shell.command(button)

    def _take(self, text: str, stops: int) -> None:
        """A line: a stop and a halt act here, whatever else is being worked off."""
        shell = self._shell
        late = stops != shell.stops and undoes(text)
        stopped = not late and shell.stop_at_once(text)  # first of all, of the whole of it
        text = text[:MAX_LINE]
        if not stopped and self._waiting >= MOST_LINES:
            shell.out("Too many lines at once: that one is left out.")
            return
        self._server.tell(_news(you=text))
        self._printer(f"(page) > {printable_line(text)}")
        if stopped:
            return
        if text.strip().casefold() in LEAVING:
            shell.out("That is for the terminal; the page is just closed.")
            return
        shell.halt_at_once(text)
        self._work_off(lambda: shell.line(text, stops=stops))

    def _take_heard(self, order: Order, stops: int) -> None:
        """What was said into a page: as `humanoid listen` takes it; no command of the prompt."""
        shell, text = self._shell, order.heard[:MAX_LINE]
        if undoes(text):
            shell.out(AT_THE_ROBOT)
            return
        stopped = shell.stop_at_once(text)
        if not stopped and self._waiting >= MOST_LINES:
            shell.out("Too many lines at once: that one is left out.")
            return
        self._server.tell(_news(you=f"“{text}”"))
        self._printer(f"(page, said) > {printable_line(text)}")
        if stopped:
            return
        if shell.asks and not order.sure:
            shell.out("I did not hear that well. Please say it again.")
        elif not shell.help(text):
            shell.halt_at_once(text, spoken=True)
            risk = heard_risk if order.sure else doubtful_risk(order.doubtful)
            self._work_off(lambda: shell.hear(text, stops=stops, risk=risk))

    def _work_off(self, does: Callable[[], None]) -> None:
        """Do it after what came before it, in the worker's thread."""
        self._waiting += 1
        try:
            self._worker.submit(self._done, does)
        except RuntimeError:  # the run is over
            if not self._closing.is_set():
                raise

    def _done(self, does: Callable[[], None]) -> None:
        try:
            does()
        except Exception as error:  # in this software: the robot goes on
            self._shell.out(as_mistake(error))
        finally:
            self._waiting -= 1


def _news(**news: Any) -> bytes:
    return msgspec.json.encode(news) + b"\n"


def of(folder: Path) -> Of:
    """The folder of a run, as long as it is there."""
    found = folder.stat()
    return Of(device=found.st_dev, inode=found.st_ino)


def _write(path: Path, place: Place | Of) -> None:
    """Say where it is; without, pages only look on."""
    with suppress(OSError):
        path.unlink(missing_ok=True)
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
        with os.fdopen(os.open(path, flags, 0o600), "wb") as file:
            file.write(msgspec.json.encode(place))
