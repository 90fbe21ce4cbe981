"""What ROS 2 machines want of the robot, handed to its executive as another terminal would.

A stop, a task and a velocity have a thread and a connection each, so none waits for another; of
each only so much waits, the newest velocity takes the place of the one before. What the executive
tells of itself is kept, the newest.
"""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress

import msgspec

from executive.frontends.service import messages as m
from executive.frontends.service import views
from executive.frontends.service.client import Connection, press
from executive.frontends.service.place import Place
from executive.frontends.since_boot import now_s
from robot.closing import Closing
from robot.errors import RobotError

WHY = "a ROS 2 machine said stop"
MOST_TASKS = 8
"""That wait for the executive to read them."""
MOST_TEXT = 1000
"""Letters of a task."""
MOST_WORDS = 100
PATIENCE_S = 2.0
"""So long an executive is waited for that takes over from another one."""
AGAIN_S = 0.3
STATUS_S = 1.0
FRESH_S = 0.5
"""A velocity that has waited for longer is none any more."""


class Told(msgspec.Struct, frozen=True, kw_only=True):
    """What the executive tells of itself; `seen` is None while it is not reached."""

    seen: views.Seen | None = None
    asks: m.Asks = m.Asks()
    stops: int = 0
    standing: m.Standing | None = None


class Orders(Closing):
    """A context manager: hands orders on inside.

    Attributes:
        told: what the executive tells of itself, the newest.
        refused: why the newest velocity was not walked; empty if it was.
        left_out: how many tasks were too many, too long, or not read in time.
    """

    def __init__(self, place: Place) -> None:
        """Begin to listen to the robot of a place."""
        self.told = Told()
        self.refused = ""
        self.left_out = 0
        self._place = place
        self._words: deque[str] = deque(maxlen=MOST_WORDS)
        self._tasks: deque[tuple[str, float]] = deque()
        self._velocity: tuple[float, m.Drive] | None = None
        self._buttons: list[m.Button] = []
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._stop_wanted, self._task_wanted, self._drive_wanted = (
            threading.Event(), threading.Event(), threading.Event(),
        )  # fmt: skip
        for name, work in (
            ("stops", self._press_buttons), ("tasks", self._say_tasks),
            ("velocities", self._drive), ("views", self._look_on),
        ):  # fmt: skip
            threading.Thread(target=work, name=name, daemon=True).start()

    def close(self) -> None:
        """Hand nothing on any more."""
        self._closing.set()
        for event in (self._stop_wanted, self._task_wanted, self._drive_wanted):
            event.set()

    def words(self) -> list[str]:
        """What the robot said since this was asked last, oldest first."""
        found: list[str] = []
        with suppress(IndexError):
            while True:
                found.append(self._words.popleft())
        return found

    # --- from the bridge, never waiting ---

    def press(self, button: m.Button) -> None:
        """Stop it; one that is under way already is not asked for twice."""
        with self._lock:
            if button not in self._buttons:
                self._buttons.append(button)
            self._velocity = None  # of before it
        self._stop_wanted.set()

    def say(self, text: str) -> None:
        """Have it do what a sentence says."""
        plain = "".join(one if one.isprintable() else " " for one in text).strip()
        with self._lock:
            if not plain or len(plain) > MOST_TEXT or len(self._tasks) >= MOST_TASKS:
                self.left_out += 1
                return
            self._tasks.append((plain, now_s()))
        self._task_wanted.set()

    def drive(self, forward_m_s: float, left_m_s: float, turn_rad_s: float) -> None:
        """Have it walk at a velocity; what is not finite is none."""
        rates = (forward_m_s, left_m_s, turn_rad_s)
        if not all(math.isfinite(one) for one in rates):
            self.refused = "that is no velocity"
            return
        forward, left, turn = (max(-100.0, min(100.0, one)) for one in rates)
        wanted = m.Drive(forward_m_s=forward, left_m_s=left, turn_rad_s=turn)
        with self._lock:
            self._velocity = (time.monotonic(), wanted)
        self._drive_wanted.set()

    # --- the threads ---

    def _press_buttons(self) -> None:
        while self._woken(self._stop_wanted):
            with self._lock:
                buttons, self._buttons = self._buttons, []
            for button in sorted(buttons):  # the emergency stop first
                with suppress(RobotError):
                    press(self._place, button, lambda _: None, why=WHY)

    def _say_tasks(self) -> None:
        while self._woken(self._task_wanted):
            while self._tasks and not self._closing.is_set():
                text, begun_s = self._tasks.popleft()
                self._ask(m.Say(text=text, spoken=True, begun_s=begun_s), wait_s=None)

    def _ask(self, request: m.Request, *, wait_s: float | None) -> None:
        try:
            with Connection(self._place, patience_s=PATIENCE_S) as connection:
                connection.ask(request, lambda _: None, wait_s=wait_s)
        except RobotError:
            self.left_out += 1

    def _drive(self) -> None:
        while not self._closing.is_set():
            with suppress(RobotError), Connection(self._place, patience_s=PATIENCE_S) as robot:
                while self._woken(self._drive_wanted):
                    with self._lock:
                        told, self._velocity = self._velocity, None
                    if told is not None and time.monotonic() - told[0] < FRESH_S:
                        words: list[str] = []
                        robot.ask(told[1], _into(words))
                        self.refused = " ".join(words)
            self._closing.wait(AGAIN_S)

    def _look_on(self) -> None:
        while not self._closing.is_set():
            with suppress(RobotError, msgspec.DecodeError):
                self._watch()
            self.told = Told(stops=self.told.stops)
            self._closing.wait(AGAIN_S)

    def _watch(self) -> None:
        with Connection(self._place, patience_s=PATIENCE_S) as robot:
            robot.send(m.Watch(views=True, recent=False))
            asking = threading.Thread(target=self._ask_how_it_is, args=(robot,), daemon=True)
            asking.start()
            for line in robot.lines():
                self._take(views.told(line))
                if self._closing.is_set():
                    return

    def _ask_how_it_is(self, robot: Connection) -> None:
        """Once a second; it also keeps the connection from being the one silent longest."""
        with suppress(RobotError):
            while not self._closing.wait(STATUS_S):
                robot.send(m.Status())

    def _take(self, told: m.Told | views.Seen | views.Hello) -> None:
        match told:
            case views.Seen():
                self.told = msgspec.structs.replace(self.told, seen=told)
            case m.Asks():
                self.told = msgspec.structs.replace(self.told, asks=told)
            case m.Stopped(stops=stops):
                self.told = msgspec.structs.replace(self.told, stops=stops)
            case m.Ended(standing=standing) if standing is not None:
                self.told = msgspec.structs.replace(self.told, standing=standing)
            case m.Words(number=0, text=text):
                self._words.append(text)
            case _:
                pass  # the answer to what was asked for

    def _woken(self, wanted: threading.Event) -> bool:
        wanted.wait()
        wanted.clear()
        return not self._closing.is_set()


def _into(words: list[str]) -> Callable[[m.Told], None]:
    def hear(told: m.Told) -> None:
        if isinstance(told, m.Words):
            words.append(told.text)

    return hear
