"""Stops a robot that another process keeps up: by a connection of its own, whatever else is so."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Protocol

from executive.frontends.service import messages as m
from executive.frontends.service.client import ANSWER_S, press
from executive.frontends.service.place import Place
from intents.stopping import is_stay, is_stop
from robot.errors import RobotError
from robot.exit_status import ExitStatus

AT_PROMPT = "the operator said stop at an attached prompt"


class Stopped(Protocol):
    """Whose robot is stopped: an attached prompt.

    Attributes:
        place: of the robot.
        status: the worst that came of a line.
    """

    place: Place
    status: int

    @property
    def at_work(self) -> bool:
        """Whether there may be something to stop, as far as is known."""
        ...

    @property
    def hears(self) -> bool:
        """Whether what the robot says is told here anyway."""
        ...

    @property
    def asks_something(self) -> bool:
        """Whether the robot asks the person something."""
        ...

    def out(self, text: str, /) -> None:
        """Say a line to people."""
        ...

    def warn(self, text: str, /) -> None:
        """Say in red that something is wrong."""
        ...


class RemoteBrake:
    """Stops a robot that another process keeps up, and says if that has not come to anything.

    It also knows how often the robot was told to stop by others, as far as that was told: what
    was typed before, and was not handed on yet, comes to nothing.
    """

    def __init__(self, shell: Stopped) -> None:
        """Nobody has said stop yet."""
        self._shell = shell
        self._lock = threading.Condition()
        self._own = self._others = 0
        self._told = self._heard = 0
        self._pid = 0
        self._open = self._answered = 0

    # --- how often ---

    @property
    def stops(self) -> int:
        """How often it was told to stop, here and elsewhere, since this prompt is there."""
        return self._own + self._others

    @property
    def told(self) -> int:
        """How often its executive has been told to stop, as far as that is known here."""
        return self._told

    def greet(self, stops: int, pid: int, *, begun: int | None = None) -> None:
        """An executive says how often it was told to stop; another one counts anew.

        Args:
            stops: by now.
            pid: of the executive.
            begun: when this prompt began, so that what was piped to it ends with a stop that came
                while it was loaded (None: as by now).
        """
        with self._lock:
            if self._pid not in (0, pid):
                self._told = self._heard = 0
            elif not self._pid:
                self._told = self._heard = stops if begun is None else begun
            self._pid = pid
        self.hear(stops)

    def hear(self, stops: int) -> None:
        """So often it was told to stop; while one from here is under way it may be that one."""
        with self._lock:
            self._take(stops)

    def _take(self, stops: int) -> None:
        """Answers may come in any order; that of the last one from here tells whose they were."""
        self._heard = max(self._heard, stops)
        if not self._open:
            self._others += max(0, self._heard - self._told - self._answered)
            self._told, self._answered = self._heard, 0

    def settled(self) -> None:
        """Wait until it is known what came of the stops from here, or that it is not."""
        with self._lock:
            self._lock.wait_for(lambda: not self._open, timeout=ANSWER_S)

    # --- stopping ---

    def is_cry(self, text: str) -> bool:
        """Whether a line is a cry to stop; a wish to stay is one to a robot that is at work."""
        at_work = self._shell.at_work
        return is_stop(text, at_rest=not at_work) or (at_work and is_stay(text))

    def stop(self, why: str) -> None:
        """Bring the robot to a stand; the robot says so."""
        self.press("stop", why)

    def stop_unsaid(self, why: str) -> None:
        """The same."""
        self.press("stop", why)

    def press(self, button: m.Button, why: str = "", *, quiet: bool = False) -> None:
        """Press a button, in a thread; where nobody listens a stop is left for who comes next.

        Args:
            button: which.
            why: what a job is told that ends by it.
            quiet: whether nothing is said where there is nothing to stop.
        """
        with self._lock:
            self._own += 1
            self._open += 1
        pressing = threading.Thread(
            target=self._press, args=(button, why or AT_PROMPT, quiet), name="stop"
        )
        pressing.daemon = True
        try:
            pressing.start()
        except RuntimeError:  # no room for a thread
            self._press(button, why or AT_PROMPT, quiet)

    def _press(self, button: m.Button, why: str, quiet: bool) -> None:
        words: list[str] = []

        def hear(told: m.Told) -> None:
            if isinstance(told, m.Words):
                words.append(told.text)

        stops: int | None = None
        try:
            stops = press(self._shell.place, button, hear, why=why, quiet=quiet).stops
            if not self._shell.hears:
                _say_each(self._shell.out, words)
        except RobotError as error:
            if self._shell.at_work or not quiet:
                self._shell.status = max(self._shell.status, ExitStatus.BROKEN)
                self._shell.warn(f"Nobody has heard the {button}: {error}")
        finally:
            with self._lock:
                self._open -= 1
                if stops is not None:
                    self._answered += 1
                    self._take(stops)
                self._lock.notify_all()

    def ask_no_more(self) -> bool:
        """Stop a robot that seems to have nothing to stop; whether it asked something.

        Nobody here can be sure of that: it may have begun something just now.
        """
        asked = self._shell.asks_something
        self.press("stop", "the operator pressed Ctrl-C", quiet=True)
        return asked

    def standing(self) -> str:
        """What is true of a robot that has nothing to stop."""
        return "There is nothing to stop."


def _say_each(say: Callable[[str], None], words: list[str]) -> None:
    for text in words:
        say(text)
