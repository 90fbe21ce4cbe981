"""One period of the owner of the buses: states out, a command in, or none."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Protocol, Self, runtime_checkable

from robot.bus.run import Run
from robot.bus.timing import Lateness
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motors.alarms import NAMES, Level
from robot.drivers.motors.naps import Naps
from robot.drivers.motors.owned.driver import PERIOD_S
from robot.drivers.motors.owned.memory import (
    CHANGES,
    Change,
    Order,
    OwnerMemory,
    Reported,
    Standing,
)
from robot.drivers.registry import FORCE, IMU, MOTORS
from robot.drivers.stop_input import StopInput
from robot.drivers.wiring import Wiring
from robot.errors import DescriptionError, DriverError
from robot.messages import MotorAlarm
from robot.model.body import BodyModel
from robot.model.description import RobotDescription
from robot.owner import reactions
from robot.owner.owner import BusOwner
from robot.owner.reactions import BY_CODE, Refused, State
from robot.owner.sit import Squat, plan

WAITS_S = 0.0012
"""So long into a period of 2 ms a command is waited for; what comes later is for the next one."""
WAITS_SIMULATED_S = 0.008
"""Of the wall's time, in a simulation, which waits 10 ms for commands: a slow machine is no dead
controller, and a spare's millisecond is longer there. Else one that has died is not waited for."""

READY_S = 0.006
"""A spare that has seen no state for longer is not ready: it does not run just now."""
GIVES_AFTER_S = 0.008
"""So long a controller that lives may be late before a spare that is ready gets its turn: what it
was doing is then over, as if it had died."""


@runtime_checkable
class Resettable(Protocol):
    """A driver with alarms of its own, which end by a reset; its motors are armed anew then."""

    def reset(self) -> None:
        """Forget every alarm."""
        ...


class OwnedBody(Closing):
    """What the owner has of the body: the motors, and whatever tells it whether it stands."""

    def __init__(self, wiring: Wiring) -> None:
        """Make the drivers. Raises ConfigError, DriverError as `robot.drivers.registry`."""
        self.motors = MOTORS.make(wiring)
        self._imu, self._force = IMU.make(wiring), FORCE.make(wiring)
        self._felt: ImuReading | None = None
        self._borne: ForceReading | None = None
        self._opened = ExitStack()

    def __enter__(self) -> Self:
        """Open them, and claim the motors. Raises DriverError if one is not there, or not free."""
        with ExitStack() as stack:
            for device in (self._imu, self._force, self.motors):
                stack.enter_context(device)
            if not self.motors.claim():
                raise DriverError("another program commands the motors")
            self._opened = stack.pop_all()
        return self

    def close(self) -> None:
        """Leave the motors damping, and let go of everything."""
        self._opened.close()

    def read(self) -> BodySample | None:
        """The next state, with the newest readings; None as long as a sensor gave none."""
        state = self.motors.read()
        for felt in self._imu.read():
            self._felt = felt
        for borne in self._force.read():
            self._borne = borne
        if self._felt is None or self._borne is None:
            return None
        return BodySample(state, self._felt, self._borne)


class Serving:
    """The owner at work.

    Attributes:
        holds: how often a command was missed.
    """

    def __init__(
        self,
        owner: BusOwner,
        body: OwnedBody,
        memory: OwnerMemory,
        *,
        clock: Clock,
        tell: Callable[[str], None],
        is_simulated: bool,
        is_pressed: Callable[[], bool] = lambda: False,
    ) -> None:
        """Put the parts together; nothing is commanded before a controller does.

        Args:
            owner: decides.
            body: whose motors it owns.
            memory: that it shares with controllers.
            clock: of the wall.
            tell: hears a line of every change of level.
            is_simulated: whether the body's time waits for commands.
            is_pressed: looks at the stop input.
        """
        self._owner, self._body, self._memory = owner, body, memory
        self._clock, self._tell, self._is_pressed = clock, tell, is_pressed
        self._is_simulated = is_simulated
        self._naps = Naps(clock)
        self._lateness = Lateness("owner", PERIOD_S)
        self._stamp_s = -1.0
        self._words = Reported()
        self._held: Change | None = None
        self._answered = 0
        self._turn: int = 0
        self._gave_s = self._good_s = -math.inf
        self.holds = 0

    def period(self) -> None:
        """One period. Raises DriverError if the motors went away."""
        sample = self._body.read()
        if sample is None:
            return
        # Simulated time may stand still until the first command: that one is looked for.
        if sample.motors.stamp_s == self._stamp_s and self._owner.is_waited_for:
            return
        stamp_s = self._stamp_s = sample.motors.stamp_s
        self._lateness.tick(self._clock.now_s(), body_s=stamp_s if self._is_simulated else None)
        self._answer()
        self._publish(sample)
        order = self._await()
        self._give(sample, order)
        before = self._owner.state
        command = self._owner.decide(
            sample, order, is_pressed=self._is_pressed(), is_claimed=self._is_claimed(order)
        )
        if command is not None:
            self._body.motors.write(command)
        if (state := self._owner.state)[:2] != before[:2]:
            self._note(state)
        if state.latched:
            self._turn = 0  # who comes after a person's reset goes by the lock

    def _give(self, sample: BodySample, order: Order | None) -> None:
        """Give the turn of a controller that fell silent to a spare that is ready, if one is.

        One that has died has no lock any more: that is sure, and not waited for. One that is just
        dying still has it, as the system takes it apart, and so has one that stands still.
        """
        now_s = self._stamp_s
        if order is not None:
            self._good_s = now_s
            if order.leaves:
                self._turn = 0
            return
        if not self._owner.is_waited_for or now_s - self._gave_s < reactions.AT_MOST_S:
            return
        silent_s, ready = now_s - self._good_s, self._memory.ready()
        if ready is None or ready.who == self._turn or now_s - ready.stamp_s > READY_S:
            return
        if silent_s > GIVES_AFTER_S + reactions.SLACK_S or not self._memory.is_claimed():
            self._turn, self._gave_s = ready.who, now_s
            self._publish(sample)
            self._tell(f"{now_s:.3f} s, a spare controller has the turn")

    @property
    def is_lowering(self) -> bool:
        """Whether it sits the robot down just now: that is not broken off, but by a kill."""
        return self._owner.state.level == Level.SIT

    def close(self) -> None:
        """Say how well commands came."""
        self._tell(
            f"bus owner: {self.holds} holds for want of a command, {self._owner.stale} commands "
            f"too late, {self._memory.torn} torn records"
        )
        timing = self._lateness.report(self._stamp_s, self._clock.now_s())
        self._tell(
            f"bus owner: {timing.late} of {timing.count} periods late, by p50 "
            f"{1000 * timing.p50_s:.2f}, p99 {1000 * timing.p99_s:.2f}, p99.9 "
            f"{1000 * timing.p999_s:.2f} ms; {timing.missed} of them not for the simulation's sake"
        )

    def _publish(self, sample: BodySample) -> None:
        owner, state = self._owner, sample.motors
        own = _own_alarm(owner.state)
        alarms = state.alarms if own is None else (own, *state.alarms)
        if alarms != self._words.alarms:
            self._say(alarms=alarms)
        level, peak = owner.state.level, owner.peak
        self._memory.publish(state, Standing(level, peak, self._answered, turn=self._turn))

    def _await(self) -> Order | None:
        """The order of this period, waited for while a controller that lives is to give one."""
        memory = self._memory
        order = self._taken()
        if not self._owner.is_waited_for:
            return order
        until_s = self._clock.now_s() + (WAITS_SIMULATED_S if self._is_simulated else WAITS_S)
        self._naps.begin()
        # A late answer to an older state is waited past: else it would stay a period behind.
        while order is None or order.command.stamp_s < self._stamp_s:
            if self._clock.now_s() >= until_s:
                break
            if not self._is_simulated and not memory.is_claimed():
                break
            self._naps.nap()
            order = self._taken() or order
        self._naps.end()
        return order

    def _taken(self) -> Order | None:
        """A new order of the one whose turn it is."""
        order = self._memory.take()
        return order if order is None or self._turn in (0, order.by) else None

    def _is_claimed(self, order: Order | None) -> bool:
        """Whether a controller that lives has claimed the motors; not asked where one commands."""
        given = self._stamp_s - self._gave_s < reactions.AT_MOST_S
        return order is not None or given or self._memory.is_claimed()

    def _answer(self) -> None:
        """Answer a person's wish for a reset."""
        wish = self._memory.wish()
        if wish is None:
            return
        answer = self._owner.reset(is_pressed=self._is_pressed())  # as it is since the wish
        if isinstance(answer, Refused):
            self._say(refused=f"{answer.cause}: {answer.cure}")
            self._tell(f"{self._stamp_s:.3f} s, reset refused: {answer.cause} ({answer.cure})")
        else:
            if isinstance(motors := self._body.motors, Resettable):
                motors.reset()
            self._turn, self._gave_s = 0, -math.inf
            self._say(refused="")
            self._note(answer)
        self._answered = wish

    def _note(self, state: State) -> None:
        """Say what changed; a hold that a command ends is counted, and told with what follows."""
        change = Change(self._stamp_s, state.level, state.code)
        if state.level == Level.HOLD:
            self._held, self.holds = change, self.holds + 1
            return
        held, self._held = self._held, None
        if state.level == Level.OK and held is not None:
            return
        told = (change,) if held is None else (held, change)
        self._say(changes=(*self._words.changes, *told)[-CHANGES:])
        for one in told:
            self._tell(_line(one))

    def _say(
        self,
        *,
        alarms: tuple[MotorAlarm, ...] | None = None,
        changes: tuple[Change, ...] | None = None,
        refused: str | None = None,
    ) -> None:
        said = self._words
        self._words = Reported(
            said.alarms if alarms is None else alarms,
            said.changes if changes is None else changes,
            said.refused if refused is None else refused,
        )
        self._memory.say(self._words)


def _line(change: Change) -> str:
    """A change of level for people."""
    if not change.code:
        return f"{change.stamp_s:.3f} s, OK: the next controller is obeyed"
    row = BY_CODE[change.code]
    return f"{change.stamp_s:.3f} s, {row.level.name}: {row.code}: {row.when} ({row.cure})"


def _own_alarm(state: State) -> MotorAlarm | None:
    """What the owner does alone, for whoever still commands and for people."""
    if state.level < Level.SIT:
        return None
    row = BY_CODE[state.code]
    return MotorAlarm(row.code, "bus owner", NAMES[state.level], row.when, row.cure)


def squat_of(body: BodyModel, tell: Callable[[str], None]) -> Squat | None:
    """The squat of a robot; None, and said so, if it knows none: it damps instead."""
    try:
        return plan(body)
    except DescriptionError as error:
        tell(f"no controlled sit: {error}")
        return None


def stop_of(config: Run, robot: RobotDescription, stack: ExitStack) -> Callable[[], bool]:
    """Looks at the robot's stop input, opened for as long as the stack; where it has none, never.

    Raises:
        DriverError: if it is not there, or the user does not let robots open it.
    """
    named = "" if robot.bus_owner is None else robot.bus_owner.stop_input
    if not (path := config.stop_input or named):
        return lambda: False
    contact = StopInput(Path(path), is_emulated=bool(config.stop_input))
    contact.open()
    return stack.enter_context(contact).is_pressed
