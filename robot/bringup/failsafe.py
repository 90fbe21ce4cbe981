"""A trial of the bus owner: a simulated robot stands, its controller is lost, and it is watched."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Literal

import msgspec

from robot.bringup import rearming
from robot.bringup.live import LiveRuntime
from robot.bringup.processes import CONTROLLER, PROCESSES
from robot.clock import Clock
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import Change, OwnerMemory
from robot.errors import ProcessError
from robot.model import description
from robot.owner.reactions import DOES
from robot.reality.contract import World

How = Literal["kill", "stop", "press"]
HAPPENS: dict[How, str] = {
    "kill": "the controller is killed (SIGKILL)",
    "stop": "the controller is stopped (SIGSTOP)",
    "press": "the emergency stop is pressed (emulated)",
}
ALONE = tuple(replace(row, spare_after_s=None) if row is CONTROLLER else row for row in PROCESSES)
"""Without spares: one would take over, and there would be nothing to see."""
STANDS_S, LOOKS_S, PATIENCE_S = 1.0, 0.02, 180.0
GOES_ON_S = 0.5
RELEASED, PRESSED = "1\n", "0\n"


class Step(msgspec.Struct, frozen=True):
    """A rung of the ladder: how long after the loss it was reached, by which row, what it does."""

    after_s: float
    level: str
    code: str
    does: str


class Trial(msgspec.Struct, frozen=True):
    """What was seen. Times are the robot's.

    Attributes:
        happened: to the controller, or to the stop.
        steps: in order.
        most: the largest torque since the owner acted alone, as a share of its joint's limit.
        refusals: of resets that were asked for too early.
        ignored: whether no command was carried out between the loss and the arming.
        obeyed_s: how long after the arming a controller commanded again.
    """

    happened: str
    steps: tuple[Step, ...]
    most: float
    refusals: tuple[str, ...]
    ignored: bool
    obeyed_s: float


class Player:
    """Plays one trial; a line is told of whatever happens."""

    def __init__(
        self,
        world: World,
        robot: str,
        *,
        folder: Path,
        driver: str,
        wall: Clock,
        tell: Callable[[str], None],
    ) -> None:
        """Know what is to be played; nothing is started.

        Args:
            world: where the robot stands.
            robot: name or path of its description.
            folder: takes logs, and the file that emulates the stop's contact.
            driver: of its motors.
            wall: the wall clock.
            tell: hears the lines.
        """
        self._tell, self._wall = tell, wall
        self._contact = folder / "stop"
        self._description = description.load(robot).driven_by(driver)
        self._runtime = LiveRuntime(
            world, robot, folder=folder, motors=driver, owned=True,
            stop_input=self._contact, processes=ALONE,
        )  # fmt: skip
        self._until_s = 0.0

    def play(self, how: How) -> Trial:
        """Play it.

        Raises:
            ProcessError: the robot does not come up, or what is to happen does not in 3 minutes.
        """
        self._contact.parent.mkdir(parents=True, exist_ok=True)
        self._contact.write_text(RELEASED)
        self._until_s = self._wall.now_s() + PATIENCE_S
        with self._runtime as runtime:
            self._wait("the robot does not stand", self._stands)
            with OwnerMemory(self._description, Path(runtime.run.sockets)) as memory:
                return self._watched(how, memory)

    def _stands(self) -> bool:
        body = self._runtime.link.body()
        return body is not None and body.mode == "stand" and body.stamp_s > STANDS_S

    def _watched(self, how: How, memory: OwnerMemory) -> Trial:
        lost_s, last = self._lose(how, memory)
        steps: list[Step] = []
        refusals: list[str] = []

        def is_off() -> bool:
            for change in memory.said().changes[len(steps) :]:
                steps.append(_step(change, lost_s))
                self._tell(_told(steps[-1]))
            if steps and not refusals:
                refusals.append(self._refused(memory))
            return bool(steps) and steps[-1].level == Level.OFF.name

        self._wait("the owner does not let go", is_off)
        ignored = self._is_ignored(how, memory, last)
        most = memory.standing().peak
        if how == "press":
            self._contact.write_text(RELEASED)
            self._tell("the stop is released: that alone arms nothing")
        obeyed_s = self._arm(memory)
        return Trial(HAPPENS[how], tuple(steps), most, tuple(refusals), ignored, obeyed_s)

    def _lose(self, how: How, memory: OwnerMemory) -> tuple[float, int]:
        """Let it happen; returns when, and the number of the last command before."""
        if how == "press":
            self._contact.write_text(PRESSED)
        else:
            number = signal.SIGKILL if how == "kill" else signal.SIGSTOP
            os.kill(self._runtime.supervisor.pid("controller"), number)
        lost_s, last = memory.command_stamp_s(), memory.last_number()
        self._tell(f"{lost_s:.3f} s: {HAPPENS[how]}")
        return lost_s, last

    def _refused(self, memory: OwnerMemory) -> str:
        refused = rearming.asked(memory, self._wall).refused
        self._tell(f"  a reset is refused: {refused}" if refused else "  a reset was taken")
        return refused

    def _is_ignored(self, how: How, memory: OwnerMemory, last: int) -> bool:
        """Whether whoever commands now, or would, moves nothing."""
        if how == "stop":
            os.kill(self._runtime.supervisor.pid("controller"), signal.SIGCONT)
        begun_s = self._wall.now_s()
        self._wait("", lambda: self._wall.now_s() > begun_s + GOES_ON_S)
        commands = memory.last_number() - last
        if how == "kill":
            self._tell("a new controller was started: it waits, and is not let")
            return commands == 0 and memory.standing().level == Level.OFF
        self._tell(f"{commands} commands came meanwhile: none was carried out")
        return memory.standing().level == Level.OFF

    def _arm(self, memory: OwnerMemory) -> float:
        """Arm the motors; returns how long after it they were commanded again."""
        before, armed_s = memory.last_number(), memory.stamp_s()
        refused = rearming.asked(memory, self._wall).refused
        if refused:
            raise ProcessError(f"the owner was not to be armed again: {refused}")
        self._tell("a person arms it again")
        self._wait("no controller commands again", lambda: memory.last_number() > before)
        after_s = memory.command_stamp_s() - armed_s
        self._tell("a controller commands again, and damps: the robot lies")
        return round(after_s, 6)

    def _wait(self, complaint: str, is_so: Callable[[], bool]) -> None:
        while not is_so():
            if (failed := self._runtime.failure()) is not None:
                raise ProcessError(failed.cause)
            if self._wall.now_s() > self._until_s:
                raise ProcessError(f"{complaint} within {PATIENCE_S:.0f} s")
            self._runtime.advance(LOOKS_S)


def _step(change: Change, lost_s: float) -> Step:
    return Step(
        round(change.stamp_s - lost_s, 6), change.level.name, change.code, DOES[change.level]
    )


def _told(step: Step) -> str:
    return f"+{step.after_s:.3f} s  {step.level:<4}  {step.code}: {step.does}"
