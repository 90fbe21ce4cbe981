"""What brings the robot to a stand: stops, halts, the emergency stop, and whoever leaves.

All of it may be called from any thread, and waits for nobody.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from executive.blackboard import BODY
from executive.engine.executive import JobError
from executive.engine.jobs import Job
from executive.frontends.prompt.answering import Answering
from executive.frontends.prompt.halt import Halt
from executive.frontends.prompt.robot import AtWork
from executive.frontends.prompt.stance import standing
from executive.frontends.since_boot import now_s
from intents.dialogue import Dialogue
from intents.parser import asks_to_stop
from intents.stopping import is_stay, is_stop

if TYPE_CHECKING:
    from intents.language_model import LanguageModel

ESTOP_IS_ON = (
    "The emergency stop is on, and nothing moves: `estop release`, then `estop reset`, undo it."
)
REMEMBERED = 1000
"""Stops of which it is known when they were."""


class Brake:
    """Stops and halts a robot that is spoken to.

    Attributes:
        halt: whether it has halted for a cry, and waits to be told more.
        stops_before: what `stops` was when the line that is being done was entered (None: as now).
    """

    def __init__(
        self,
        robot: AtWork,
        dialogue: Dialogue,
        *,
        people: Answering,
        model: LanguageModel | None,
    ) -> None:
        """Nobody has said stop yet.

        Args:
            robot: that is stopped.
            dialogue: is forgotten with a stop.
            people: are answered; a stop silences what is said to them.
            model: is waited for no longer.
        """
        self.halt = Halt(robot.executive)
        self._stops = 0
        self._left = False
        self._stopped_s: deque[float] = deque(maxlen=REMEMBERED)
        self.stops_before: int | None = None
        self._robot = robot
        self._dialogue = dialogue
        self._people = people
        self._model = model
        self._lock = threading.Lock()

    def is_cry(self, text: str) -> bool:
        """Whether a line is a cry to stop; a wish to stay is one to a robot that is at work."""
        if not self._robot.busy:
            return is_stop(text, at_rest=True)
        read = self._dialogue.vocabulary
        return is_stop(text) or is_stay(text) or asks_to_stop(text, read)

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs, be silent, and say so."""
        busy = self._robot.busy
        self.stop_unsaid(why)
        self._people.out("Stopping." if busy else self.standing())

    def stop_unsaid(self, why: str) -> None:
        """Stop without a word; first the robot, then what only is in the way of hearing."""
        with self._lock:
            self._note_stop()
            self._robot.executive.stop(why)
            self.halt.forget()
        self._ask_model_no_more()
        self._people.speech.hush()
        self._dialogue.forget()

    def press(self) -> None:
        """Press the emergency stop; lines from before it come to nothing."""
        self._people.speech.hush()
        self._robot.executive.press_estop("the operator pressed the emergency stop")
        with self._lock:
            self._note_stop()

    def halt_robot(self) -> None:
        """Come to a stand at once and keep the jobs, until it is known what is wanted."""
        with self._lock:
            self.halt.begin()
        self._people.speech.hush()

    def settle_halt(self) -> None:
        """It was said what is to become of the jobs that were halted; it is asked no more."""
        if self.halt.on:
            self.halt.forget()
            self._dialogue.unask()

    def give_up(self, jobs: list[Job]) -> None:
        """End jobs; where the robot has halted, what is left of it is asked about anew."""
        self.halt.give_up(jobs, "cancelled on request")
        if self.halt.on:
            self._dialogue.unask()

    def give_up_halted(self) -> None:
        """End what was halted; what waits after it is asked about next."""
        self.halt.give_up(self.halt.kept, "cancelled on request")
        self._dialogue.unask()

    def ask_no_more(self) -> bool:
        """Close what was asked of the person; whether there was anything."""
        if self._dialogue.question is None:
            return False
        self._dialogue.forget()
        self._people.out("I ask no more.")
        return True

    def leave(self) -> None:
        """Let nothing begin any more, and bring the robot to a stand."""
        with self._lock:
            self._note_stop()
            self._left = True
            if self._robot.busy:
                self._robot.executive.stop("the operator leaves")
        self._ask_model_no_more()
        self._people.speech.hush()

    @property
    def stops(self) -> int:
        """How often it was told to stop, signals included; a line from before comes to nothing."""
        return self._stops + self._robot.interrupts.pressed

    def stops_by(self, begun_s: float | None) -> int:
        """How often it had been told to stop by then, in seconds since boot (None: by now).

        Signals come from the robot's own terminal, and end it; they are counted as before it.
        """
        later = 0 if begun_s is None else sum(at_s > begun_s for at_s in tuple(self._stopped_s))
        return self.stops - later

    def _note_stop(self) -> None:
        """Count a stop, and when it was."""
        self._stopped_s.append(now_s())
        self._stops += 1

    def stopped_since(self, stops: int | None) -> bool:
        """Whether there was a stop since there had been so many (None: since now).

        After `leave` there was, for whatever comes from wherever.
        """
        return self._left or stops not in (None, self.stops)

    @property
    def stopped(self) -> bool:
        """Whether there was a stop since the line that is being done was entered."""
        return self.stopped_since(self.stops_before)

    def unless_stopped(self, begin: Callable[[], int]) -> int | None:
        """What `begin` returns; None, and it is not called, if this line was `stopped`."""
        with self._lock:
            if self.stopped:
                return None
            number = begin()
        if self.stopped:  # by a signal in between, which waits for no lock
            with suppress(JobError):
                self._robot.executive.cancel(number, "stopped on request")
        return number

    def standing(self) -> str:
        """What is true of a robot that has nothing to stop."""
        return standing(self._robot.executive, self._robot.view)

    @property
    def fallen(self) -> str:
        """That it lies on the floor, and what helps; empty if it does not."""
        body = self._robot.executive.board.read(BODY)
        return self.standing() if body is not None and body.mode == "fallen" else ""

    def _ask_model_no_more(self) -> None:
        if self._model is not None:
            self._model.give_up()
