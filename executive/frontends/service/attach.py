"""`humanoid attach`: the prompt, before a robot that another process keeps up.

It is the prompt's own terminal; what it talks to is here. Leaving it leaves the robot as it is.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Mapping
from contextlib import suppress
from typing import NamedTuple

import msgspec

from executive.engine.loop import Interrupts
from executive.frontends.output import say
from executive.frontends.prompt.command import Command, anything
from executive.frontends.prompt.plain import lines_until, work_off
from executive.frontends.prompt.terminal import LEAVING, Terminal, history_at_home
from executive.frontends.prompt.view import View
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service import views
from executive.frontends.service.client import AGAIN_S, ANSWER_S, Connection, Cut, leave_stop
from executive.frontends.service.place import Place
from intents.halting import is_halt
from intents.letters import bare, without_sequences
from intents.stopping import is_stay, is_stop
from intents.vocabulary import Vocabulary
from robot.errors import RobotError
from robot.exit_status import ExitStatus

WAY_BACK_S = 60.0
"""So long a line waits for an executive that takes over."""


def attach(place: Place) -> int:
    """Talk to a robot that is up until the person leaves; returns the exit status.

    Raises:
        RobotError: the robot does not answer.
    """
    on_terminal = sys.stdin.isatty() and sys.stdout.isatty()
    shell = RemoteShell(place, waits=not on_terminal)
    with shell.robot.interrupts.listen():
        shell.connect()
        try:
            if on_terminal:
                named = f"{place.name}: {shell.hello.robot} in {shell.hello.world}"
                say(f"{named}. `help` shows what can be said; Ctrl-D leaves, the robot goes on.")
                Terminal(shell, history=history_at_home()).run()
                say(shell.gone or f"{place.name} goes on: humanoid attach comes back to it.")
            else:
                interrupts = shell.robot.interrupts
                if not work_off(shell, lines_until(sys.stdin, lambda: interrupts.pressed > 0)):
                    shell.status = max(shell.status, ExitStatus.FAILED)
        finally:
            shell.close()
    return ExitStatus.BROKEN if shell.gone else shell.status


class Names(NamedTuple):
    """What is completed."""

    vocabulary: Vocabulary


class Silence:
    """It is the robot's own process that speaks aloud."""

    def hush(self) -> None:
        """A stop silences it there."""


class RemoteRobot:
    """A robot, as it is told of."""

    def __init__(self) -> None:
        """Nothing is known yet."""
        self.interrupts = Interrupts()
        self.view = View()
        self.busy = False

    def wait(self) -> None:
        """A line that waits for its jobs has done so already."""


class RemoteShell:
    """A `Talk` with a shell of another process.

    Attributes:
        place: of the robot.
        robot: as it is told of.
        hello: what is known of it from the beginning.
        leaving: whether the person wants to go.
        status: the worst that came of a line.
    """

    hello: views.Hello

    def __init__(self, place: Place, *, waits: bool) -> None:
        """Connect to nothing yet; `waits`: a line is done when all that comes of it is over."""
        self.robot = RemoteRobot()
        self.leaving = False
        self.speech = Silence()
        self.gone = ""
        self.status: int = ExitStatus.DONE
        self.asks = m.Asks()
        self.place = place
        self._waits = waits
        self._connection: Connection | None = None
        self._pending: dict[int, threading.Event] = {}
        self._lock = threading.Lock()
        self._ready = threading.Event()
        self._closing = False
        self.brake = RemoteBrake(self)

    # --- the connection ---

    def connect(self) -> None:
        """Begin to watch. Raises RobotError if the robot does not answer."""
        connection = self._watch()
        threading.Thread(target=self._receive, args=(connection,), daemon=True).start()
        if not self._ready.wait(ANSWER_S):
            raise Cut(f"{self.place.name} is up, and does not answer")

    def close(self) -> None:
        """Hang up; the robot goes on."""
        self._closing = True
        if self._connection is not None:
            self._connection.close()

    def _watch(self) -> Connection:
        connection = Connection(self.place)
        connection.send(m.Watch(views=not self._waits))
        self._connection = connection
        return connection

    def _receive(self, connection: Connection) -> None:
        """What is told, from one executive after the other."""
        while True:
            for line in connection.lines():
                with suppress(msgspec.DecodeError):  # of a newer one
                    self._take(views.told(line))
            self._connection = None
            with self._lock:
                pending, self._pending = self._pending, {}
            for one in pending.values():
                one.set()
            if self._closing:
                return
            try:
                if not places.is_up(self.place):
                    raise Cut("it is down")
                self.out("Nobody listens just now: the executive is replaced. Stops are kept.")
                connection = self._watch()
            except RobotError:
                self.gone = f"{self.place.name} is up no more."
                return
            self.out(f"{self.place.name} listens again.")

    def _take(self, told: m.Told | views.Seen | views.Hello) -> None:
        match told:
            case m.Words(text=text):
                self.out(text)
            case views.Hello():
                self.hello = told
                self.dialogue = Names(told.vocabulary)
                self._ready.set()
            case views.Seen(view=view, busy=busy):
                self.robot.view, self.robot.busy = view, busy
            case m.Asks():
                self.asks = told
            case m.Ended(number=number, status=status):
                self.status = max(self.status, status)
                with self._lock:
                    over = self._pending.pop(number, None)
                if over is not None:
                    over.set()
            case m.Queued():
                pass

    def send(self, request: m.Request, *, over: threading.Event | None = None) -> bool:
        """Send a request; whether somebody takes it."""
        with self._lock:
            connection = self._connection
            if connection is None:
                return False
            with suppress(RobotError):
                number = connection.send(request)
                if over is not None:
                    self._pending[number] = over
                return True
        return False

    # --- what a prompt does with it ---

    def out(self, text: str, /) -> None:
        """Say a line to people."""
        say(text)

    def answer(self, text: str) -> None:
        """Say a line to people."""
        self.out(text)

    @property
    def commands(self) -> Mapping[str, Command]:
        """Those of the prompt, for completion."""
        return {
            row.name: Command(
                name=row.name, usage=row.usage, summary=row.summary, run=self.line,
                accepts=anything, choices=lambda row=row: row.choices,
                takes_sentence=row.takes_sentence,
            )
            for row in self.hello.commands
        }  # fmt: skip

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop, before anything else looks at it."""
        if self.is_emergency(text):
            return True
        if not self.brake.is_cry(plain(text)):
            return False
        self.brake.stop("")
        return True

    def is_emergency(self, text: str) -> bool:
        """Whether a line is about the emergency stop; it is handed on here."""
        if not plain(text).startswith("estop"):
            return False
        if not self.send(m.Say(text=plain(text))):
            self.brake.stop_unsaid("")
        return True

    def halt_at_once(self, text: str, *, busy: bool | None = None) -> bool:
        """Halt a robot at work if a line is a cry that ends nothing."""
        at_work = self.robot.busy if busy is None else busy
        return at_work and is_halt(text) and self.send(m.Halt(text=text[: m.MAX_TEXT]))

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Hand a line on, and wait until it is understood."""
        if text.strip() in LEAVING:
            self.leaving = True
            return
        if stops not in (None, self.brake.stops):
            self.out(f"Not done: “{text}” was there when you said stop")
            return
        over = threading.Event()
        until_s = time.monotonic() + WAY_BACK_S
        while not self.send(m.Say(text=text[: m.MAX_TEXT], wait=self._waits), over=over):
            if self.gone or time.monotonic() > until_s:
                self.status = max(self.status, ExitStatus.BROKEN)
                self.out("Not done: nobody listens.")
                return
            time.sleep(AGAIN_S)
        while not over.wait(0.2):
            if self.gone or self.robot.interrupts.count:
                return

    def leave(self) -> None:
        """Nothing comes of it: the robot goes on."""


class RemoteBrake:
    """Stops a robot that another process keeps up."""

    def __init__(self, shell: RemoteShell) -> None:
        """Nobody has said stop here yet."""
        self.stops = 0
        self._shell = shell

    def is_cry(self, text: str) -> bool:
        """Whether a line is a cry to stop; a wish to stay is one to a robot that is at work."""
        return is_stop(text) or (self._shell.robot.busy and is_stay(text))

    def stop(self, why: str) -> None:
        """Bring the robot to a stand; the robot says so."""
        self.stop_unsaid(why)

    def stop_unsaid(self, why: str) -> None:
        """The same; where nobody listens, it is left for who comes next, and said again then."""
        del why  # the robot is told that it was another terminal
        self.stops += 1
        if self._shell.send(m.Press(button="stop")):
            return
        threading.Thread(target=self._stop_next, daemon=True).start()

    def _stop_next(self) -> None:
        while not self._shell.gone and not self._shell.send(m.Press(button="stop")):
            leave_stop(self._shell.place)
            time.sleep(AGAIN_S)

    def ask_no_more(self) -> bool:
        """Close what the robot asks; whether it asks anything."""
        return bool(self._shell.asks.question) and self._shell.send(m.Press(button="stop"))

    def standing(self) -> str:
        """What is true of a robot that has nothing to stop."""
        return "There is nothing to stop."


def plain(text: str) -> str:
    """A line without what cannot be seen."""
    return bare(without_sequences(text)).strip()
