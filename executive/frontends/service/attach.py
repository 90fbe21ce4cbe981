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
from msgspec.structs import replace

from executive.engine.loop import Interrupts
from executive.frontends.emergency import emergency, plain
from executive.frontends.output import as_mistake, say
from executive.frontends.prompt.command import Command, anything
from executive.frontends.prompt.plain import lines_until, work_off
from executive.frontends.prompt.terminal import LEAVING, Terminal, history_at_home
from executive.frontends.prompt.view import View
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service import views
from executive.frontends.service.client import AGAIN_S, ANSWER_S, Connection, Cut
from executive.frontends.service.place import Place
from executive.frontends.service.pulse import Pulse
from executive.frontends.service.remote_brake import RemoteBrake
from executive.frontends.since_boot import process_began_s
from executive.health import Level
from intents.halting import is_halt
from intents.vocabulary import Vocabulary
from robot.clock import Clock, WallClock
from robot.errors import RobotError
from robot.exit_status import ExitStatus

WAY_BACK_S = 60.0
"""So long a line waits for an executive that takes over."""
LOOK_S = 0.2
DEAF = "it does not answer"


def attach(place: Place) -> int:
    """Talk to a robot that is up until the person leaves, or it is down; returns the exit status.

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
                if not shell.gone:
                    say(f"{place.name} goes on: humanoid attach comes back to it.")
            elif not work_off(shell, lines_until(sys.stdin, shell.is_over), stops=0):
                shell.status = max(shell.status, ExitStatus.FAILED)
        finally:
            shell.close()
    if shell.gone:
        shell.warn(shell.gone)
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

    def wait(self, *, asked: bool = False) -> None:
        """A line that waits for its jobs has done so already."""


class Pending:
    """A line that was sent, until it is over.

    Attributes:
        over: whether it is.
        jobs: that came of it, as far as that was told.
    """

    def __init__(self) -> None:
        """It is under way."""
        self.over = threading.Event()
        self.jobs: tuple[int, ...] = ()


class RemoteShell:
    """A `Talk` with a shell of another process.

    Attributes:
        place: of the robot.
        robot: as it is told of.
        hello: what is known of it from the beginning.
        leaving: whether the person wants to go, or there is nobody to talk to any more.
        gone: that the robot is, empty while it is there.
        status: the worst that came of a line.
    """

    hello: views.Hello

    def __init__(self, place: Place, *, waits: bool, clock: Clock | None = None) -> None:
        """Connect to nothing yet; `waits`: a line is done when all that comes of it is over."""
        self.robot = RemoteRobot()
        self.leaving = False
        self.speech = Silence()
        self.gone = ""
        self.status: int = ExitStatus.DONE
        self.asks = m.Asks()
        self.place = place
        self._waits = waits
        self._clock = clock or WallClock()
        self._connection: Connection | None = None
        self._pending: dict[int, Pending] = {}
        self._lock = threading.Lock()
        self._ready = threading.Event()
        self._closing = threading.Event()
        self.brake = RemoteBrake(self)
        self._pulse = Pulse(self._ask_for_a_word, now_s=self._clock.now_s())

    # --- the connection ---

    def connect(self) -> None:
        """Begin to watch. Raises RobotError if the robot does not answer."""
        connection = self._watch()
        threading.Thread(target=self._receive, args=(connection,), daemon=True).start()
        if not self._ready.wait(ANSWER_S):
            raise Cut(f"{self.place.name} is up, and does not answer")
        threading.Thread(target=self._look_on, daemon=True).start()

    def close(self) -> None:
        """Hang up, once the stops that are under way are heard; the robot goes on."""
        self.brake.settled()
        self._closing.set()
        if self._connection is not None:
            self._connection.close()

    def _watch(self, *, again: bool = False) -> Connection:
        told: list[Place] = []

        def meanwhile(place: Place) -> None:
            if not told:
                told.append(place)
                self.out("Nobody listens just now; stops are kept for who comes next.")

        connection = Connection(self.place, meanwhile=meanwhile)
        begun_s = process_began_s()
        connection.send(m.Watch(views=not self._waits, recent=not again, begun_s=begun_s))
        if again:
            self.out(f"{self.place.name} listens again; something may have been left out.")
        with self._lock:
            lines = self._pending.values()
            followed = [(self._followed(one, connection), one) for one in lines]
            self._pending = {number: one for number, one in followed if number is not None}
            self._connection = connection
        return connection

    def _followed(self, one: Pending, connection: Connection) -> int | None:
        """Wait for what comes of a line that was said by a connection that is cut; its number."""
        if self._waits and one.jobs:
            return connection.send(m.Await(jobs=one.jobs))
        if self._waits:
            self.warn("It is not known what came of that line.")
            self.status = max(self.status, ExitStatus.BROKEN)
        one.over.set()
        return None

    def _receive(self, connection: Connection) -> None:
        """What is told, as long as the robot is up; whatever ends that is said."""
        try:
            self._receive_all(connection)
        except RobotError as error:
            up = places.is_up(self.place)
            self._lose(f"{error}" if up else f"{self.place.name} is up no more.")
        except Exception as error:  # in this software
            self._lose(as_mistake(error))

    def _receive_all(self, connection: Connection) -> None:
        """What is told by one executive after the other."""
        while True:
            for line in connection.lines():
                if self._pulse.heard(self._clock.now_s()):
                    self.out(f"{self.place.name} answers again.")
                with suppress(msgspec.DecodeError):  # of a newer one
                    self._take(views.told(line))
            with self._lock:
                self._connection = None
            connection.close()
            if self._closing.is_set():
                return
            if not places.is_up(self.place):
                raise Cut("it is down")
            with suppress(Cut):
                connection = self._watch(again=True)

    def _lose(self, why: str) -> None:
        """There is nobody to talk to any more."""
        self.gone = why
        self.leaving = True
        with self._lock:
            self._connection = None
            pending, self._pending = self._pending, {}
        for one in pending.values():
            one.over.set()
        self._ready.set()

    def _look_on(self) -> None:
        """Look after the connection, as long as there is one."""
        while not self.gone and not self._closing.wait(LOOK_S):
            self.look(self._clock.now_s())

    def look(self, now_s: float) -> None:
        """Say when a robot that is quiet does not answer either."""
        if self._pulse.look(now_s):
            self.robot.view = replace(
                self.robot.view, mode="unknown", phase="", level=Level.HOLD, unwell=DEAF
            )
            name = self.place.name
            self.warn(f"{name} is up, and does not answer; humanoid logs --name {name}")

    def _ask_for_a_word(self) -> None:
        self.send(m.Await(jobs=()))

    def _take(self, told: m.Told | views.Seen | views.Hello) -> None:
        match told:
            case m.Words(text=text):
                self.out(text)
            case views.Hello():
                self.hello = told
                self.dialogue = Names(told.vocabulary)
                self.brake.greet(told.stops, told.pid, begun=told.stops_begun)
                self._ready.set()
            case views.Seen(view=view, busy=busy):
                self.robot.view, self.robot.busy = view, busy
            case m.Asks():
                self.asks = told
            case m.Stopped(stops=stops):
                self.brake.hear(stops)
            case m.Queued(number=number, jobs=jobs):
                with self._lock:
                    if number in self._pending:
                        self._pending[number].jobs = jobs
            case m.Ended(number=number, status=status, stops=stops):
                self.status = max(self.status, status)
                self.brake.hear(stops)
                with self._lock:
                    over = self._pending.pop(number, None)
                if over is not None:
                    over.over.set()

    def send(self, request: m.Request, *, over: Pending | None = None) -> bool:
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

    # --- what is known of the robot ---

    @property
    def hears(self) -> bool:
        """Whether what the robot says is told here."""
        return self._connection is not None and not self._pulse.lost

    @property
    def at_work(self) -> bool:
        """Whether there may be something to stop: who does not answer may be at work."""
        return self.robot.busy or not self.hears

    @property
    def asks_something(self) -> bool:
        """Whether the robot asks the person something."""
        return bool(self.asks.question)

    def is_over(self) -> bool:
        """Whether no line is wanted any more."""
        return bool(self.gone) or self.robot.interrupts.pressed > 0

    # --- what a prompt does with it ---

    def out(self, text: str, /) -> None:
        """Say a line to people."""
        say(text)

    def answer(self, text: str) -> None:
        """Say a line to people."""
        self.out(text)

    def warn(self, text: str, /) -> None:
        """Say in red that something is wrong."""
        say(text, err=True, styled=(text, "bold red"))

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
        said = emergency(text)
        if said is not None:
            self.brake.press(said.wish)
            return True
        if not self.brake.is_cry(plain(text)):
            return False
        self.brake.stop("")
        return True

    def is_emergency(self, text: str) -> bool:
        """Whether a line is about the emergency stop; unless it undoes that, it is pressed here."""
        said = emergency(text)
        if said is not None and not said.undoes:
            self.brake.press("estop")
        return said is not None

    def halt_at_once(self, text: str, *, busy: bool | None = None) -> bool:
        """Halt a robot at work if a line is a cry that ends nothing."""
        at_work = self.at_work if busy is None else busy
        return at_work and is_halt(text) and self.send(m.Halt(text=text[: m.MAX_TEXT]))

    def unhelped(self, text: str = "") -> bool:  # noqa: ARG002
        """Whoever is at the robot may help it."""
        return False

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Hand a line on, and wait until it is understood."""
        if text.strip() in LEAVING:
            self.leaving = True
            return
        if self.stop_at_once(text):
            self.brake.settled()
            return
        before = self.brake.stops if stops is None else stops
        line = Pending()
        until_s = time.monotonic() + WAY_BACK_S
        while True:
            self.brake.settled()
            if before != self.brake.stops:
                self.out(f"Not done: “{text}” was there when you said stop")
                self.status = max(self.status, ExitStatus.INVALID)
                return
            said = m.Say(text=text[: m.MAX_TEXT], wait=self._waits, stops=self.brake.told)
            if self.send(said, over=line):
                break
            if self.gone or time.monotonic() > until_s:
                self.status = max(self.status, ExitStatus.BROKEN)
                self.warn("Not done: nobody listens.")
                return
            time.sleep(AGAIN_S)
        while not line.over.wait(LOOK_S):
            if self.gone or self.robot.interrupts.count:
                return

    def leave(self) -> None:
        """Nothing comes of it: the robot goes on."""
