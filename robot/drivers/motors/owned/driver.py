"""Motors whose buses another process owns, as a `MotorBus`: that one outlives the controller."""

from __future__ import annotations

import itertools
import os
from dataclasses import replace
from pathlib import Path
from typing import Self

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import Capability, MotorCommand, MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.naps import POLL_S, Naps
from robot.drivers.motors.owned.memory import NAME, Order, OwnerMemory, Ready
from robot.errors import DriverError
from robot.model.description import RobotDescription

PERIOD_S = 0.002
GOOD_FOR_S = 2 * PERIOD_S
"""A command may be carried out for so long after the state that it answers: one period late."""
OPEN_TIMEOUT_S, SILENCE_S = 20.0, 1.0
_numbers = itertools.count()


class OwnedMotors(Closing):
    """A controller's side of the owner's memory.

    The owner carries commands out, limited by its driver, in the period in which they come. So
    `write` returns what was handed over, and not, as other drivers do, what the frames say.
    """

    def __init__(
        self,
        robot: RobotDescription,
        folder: Path,
        *,
        clock: Clock,
        capabilities: frozenset[Capability],
    ) -> None:
        """Know where it is; nothing is opened. `capabilities`: of the motors that are owned."""
        self.capabilities = capabilities
        self._robot, self._folder, self._clock = robot, folder, clock
        self._memory: OwnerMemory | None = None
        self._state: MotorState | None = None
        self._given: MotorState | None = None
        self._heard_s = 0.0
        self._number = 0
        self._naps = Naps(clock)
        self._is_held = self._is_locked = False
        self._who = (os.getpid() << 16) + next(_numbers)

    def __enter__(self) -> Self:
        """Wait for the owner and its first state. Raises DriverError if it does not come."""
        until_s = self._clock.now_s() + OPEN_TIMEOUT_S
        while not (self._folder / NAME).exists():
            self._wait(until_s, "nobody owns the buses")
        memory = self._memory = OwnerMemory(self._robot, self._folder)
        self._heard_s = self._clock.now_s()
        while self._state is None:
            self._state = memory.news()
            self._wait(until_s, "the owner of the buses says nothing")
        self._heard_s = self._clock.now_s()
        return self

    def _wait(self, until_s: float, complaint: str) -> None:
        now_s = self._clock.now_s()
        if now_s > until_s:
            self.close()
            raise DriverError(f"{complaint}: {self._folder / NAME}")
        self._clock.sleep_until(now_s + 10 * POLL_S)

    def close(self) -> None:
        """Leave the motors damping, if they are commanded from here, and let go of the owner."""
        memory = self._memory
        if memory is None:
            return
        if self._is_held and self.claim() and self._state is not None:
            damping = MotorCommand.damping(memory.count, self._state.stamp_s)
            self._hand_over(memory, damping, leaves=True)
        self._memory = None
        self._is_held = self._is_locked = False
        self._state = self._given = None
        memory.close()

    def claim(self) -> bool:
        """Become the one that commands; False while another one does, or the owner lets nobody.

        Who waits so, asking again every millisecond, follows the states, and says that it is ready:
        the owner gives it the turn of a controller that falls silent, whether that one has died,
        is just dying or only stands still. Once the owner acts alone it lets nobody, until a person
        arms it again.
        """
        memory = self._mapped()
        standing = memory.standing()
        is_given = standing.turn == self._who
        if self._is_held:
            if not (is_given or standing.turn == 0):
                self._give_up(memory)
            elif not self._is_locked:  # who had it before may have held the lock until now
                self._is_locked = memory.lock()
            return self._is_held
        if standing.level >= Level.SIT:
            return False
        self._fetch(memory)
        if not is_given:
            if standing.turn == 0 and memory.lock():
                self._is_locked = True
            else:
                if self._state is not None:
                    memory.be_ready(Ready(self._who, self._state.stamp_s))
                return False
        self._is_held, self._number = True, memory.last_number()
        return True

    def _give_up(self, memory: OwnerMemory) -> None:
        """Another one was given the turn: this one stood still for too long."""
        self._is_held = False
        if self._is_locked:
            memory.unlock()
        self._is_locked = False

    def read(self) -> MotorState:
        """The next state, waited for at most one period; else the last one again, aged.

        Raises:
            DriverError: if it is not open, or the owner said nothing for a second.
        """
        memory, begun_s = self._mapped(), self._clock.now_s()
        self._naps.begin()
        while (state := self._fetch(memory)) is self._given:
            now_s = self._clock.now_s()
            if now_s >= begun_s + PERIOD_S:
                return replace(state, age_s=state.age_s + (now_s - self._heard_s))
            self._naps.nap()
        self._naps.end()
        self._given = state
        return state

    def _fetch(self, memory: OwnerMemory) -> MotorState:
        if (state := memory.news()) is not None:
            self._state, self._heard_s = state, self._clock.now_s()
        elif (silence_s := self._clock.now_s() - self._heard_s) > SILENCE_S:
            raise DriverError(f"the owner of the buses is silent for {silence_s:.1f} s")
        if self._state is None:
            raise DriverError("the owner of the buses has no whole state to give")
        return self._state

    def write(self, command: MotorCommand) -> MotorCommand:
        """Hand a command over; returns it.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is handed over), or
                another controller commands.
        """
        memory = self._mapped()
        for field in (command.q_des, command.qd_des, command.tau_ff, command.kp, command.kd):
            if field.shape != (memory.count,):
                raise DriverError(f"a command has shape {field.shape}, not ({memory.count},)")
            if not np.isfinite(field).all():
                raise DriverError("a command is not finite; it was not handed over")
        if not self.claim():
            raise DriverError("another controller commands the motors, or their owner lets nobody")
        self._hand_over(memory, command, leaves=False)
        return command

    def _hand_over(self, memory: OwnerMemory, command: MotorCommand, *, leaves: bool) -> None:
        self._number += 1
        good_until_s = command.stamp_s + GOOD_FOR_S
        memory.order(Order(self._number, good_until_s, leaves, command, self._who))

    def _mapped(self) -> OwnerMemory:
        if self._memory is None:
            raise DriverError("the motors are not open")
        return self._memory
