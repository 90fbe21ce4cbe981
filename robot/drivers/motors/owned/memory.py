"""The memory that a controller shares with the owner of the buses: commands in, states out.

A file in the run's private folder. It begins as the motors' memory of a simulated plant does, with
a magic, the number of motors, and the hash of the configuration; then come its records, each a
`Seqlock` with one writer.
"""

from __future__ import annotations

import contextlib
import mmap
import struct
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np

from robot.closing import Closing
from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.simulation.seqlock import Seqlock
from robot.drivers.simulation.turns import Turns
from robot.errors import DriverError
from robot.messages import MotorAlarm
from robot.model.description import RobotDescription
from robot.se3 import Array

MAGIC = b"HUOWNER2"
HEADER = struct.Struct("<8sQ32s16x")
NAME = "owner"
"""Of the file."""
ALARM_WORDS = 512
"""Room for alarms, in eights of bytes; what does not fit is left out, the mildest first."""
CHANGES = 16
"""So many of the last changes of level are kept."""


class Order(NamedTuple):
    """A controller's command.

    Attributes:
        number: grows by one a command, over all controllers.
        deadline_s: until when it may be carried out, by the stamps of the motors.
        leaves: whether it is its controller's last, who is no more missed after it.
        command: what the motors are to do.
        by: who gives it (`OwnedMotors`).
    """

    number: int
    deadline_s: float
    leaves: bool
    command: MotorCommand
    by: int = 0


class Standing(NamedTuple):
    """How the owner is.

    Attributes:
        level: what it does.
        peak: the largest torque since it acts alone, as a share of the joint's limit.
        answered: number of the last wish for a reset that was answered.
        refused: why that one was refused; "" if it was not.
        turn: the spare to which the owner gave the turn of a controller that fell silent; all
            others' commands are refused. 0: it gave it to none, and the lock says whose turn it is.
    """

    level: Level = Level.OK
    peak: float = 0.0
    answered: int = 0
    refused: str = ""
    turn: int = 0


class Ready(NamedTuple):
    """A spare that follows the states, ready to command: who, and the newest that it has seen."""

    who: int
    stamp_s: float


class Change(NamedTuple):
    """A change of level: when, to what, by which row of the ladder ("" at OK)."""

    stamp_s: float
    level: Level
    code: str


class Reported(msgspec.Struct, frozen=True):
    """What is said in words: alarms of the motors, changes of level, why a reset was refused."""

    alarms: tuple[MotorAlarm, ...] = ()
    changes: tuple[Change, ...] = ()
    refused: str = ""


class OwnerMemory(Turns, Closing):
    """The file, mapped. The owner creates it; controllers, and who looks on, open it."""

    def __init__(self, robot: RobotDescription, folder: Path, *, create: bool = False) -> None:
        """Map the file.

        Raises:
            DriverError: if it is not there, or not of this layout, robot and configuration.
        """
        path, count = folder / NAME, len(robot.motors)
        sizes = (5 + 5 * count, 7 + 5 * count, 1 + ALARM_WORDS, 1, 2)
        places = np.cumsum([HEADER.size, *(Seqlock.bytes_for(size) for size in sizes)]).tolist()
        header = HEADER.pack(MAGIC, count, robot.digest())
        if create:
            fresh = path.with_suffix(".new")
            fresh.write_bytes(header + bytes(places[-1] - len(header)))
            fresh.rename(path)  # a reader sees all of the header or no file
        try:
            with contextlib.ExitStack() as stack:
                self._file = stack.enter_context(path.open("r+b"))
                if self._file.read(HEADER.size) != header:
                    raise DriverError(f"{path} is of another robot, or of another version of it")
                self._map = mmap.mmap(self._file.fileno(), places[-1])
                stack.pop_all()  # it stays open: the lock is the file's
        except (OSError, ValueError) as error:
            raise DriverError(f"the owner's memory {path} cannot be mapped: {error}") from error
        self.count = count
        self._orders, self._states, self._words, self._wishes, self._ready = (
            Seqlock(self._map, place, size=size)
            for place, size in zip(places[:-1], sizes, strict=True)
        )
        self._told, self._stood = Reported(), Standing()

    @property
    def torn(self) -> int:
        """Records refused because they were torn."""
        return sum(one.torn for one in self._records)

    @property
    def _records(self) -> tuple[Seqlock, ...]:
        return self._orders, self._states, self._words, self._wishes, self._ready

    def close(self) -> None:
        """Let go of the memory; the file stays."""
        for one in self._records:
            one.release()
        self._map.close()
        self._file.close()

    # --- who commands ----------------------------------------------------------------------------

    def is_claimed(self) -> bool:
        """Whether a process that lives commands; asked by the owner, who never does."""
        if self.lock():
            self.unlock()
            return False
        return True

    # --- a controller's side ---------------------------------------------------------------------

    def last_number(self) -> int:
        """Of the newest order; 0 before the first."""
        record = self._orders.read()
        return 0 if record is None else int(record[1][0])

    def command_stamp_s(self) -> float:
        """Of the state that the newest order answers; -inf before the first."""
        record = self._orders.read()
        return -np.inf if record is None else float(record[1][1])

    def order(self, order: Order) -> None:
        """Leave an order."""
        c = order.command
        head = (
            float(order.number), c.stamp_s, order.deadline_s, float(order.leaves), float(order.by),
        )  # fmt: skip
        self._orders.write(np.concatenate((head, c.q_des, c.qd_des, c.tau_ff, c.kp, c.kd)))

    def news(self) -> MotorState | None:
        """A state newer than the last one given; None if there is none."""
        values = self._states.news()
        if values is None:
            return None
        q, qd, tau, temperature_c, age_s = values[7:].reshape(5, self.count)
        return MotorState(
            float(values[0]), q, qd, tau, temperature_c, age_s,
            watchdog=bool(values[2]), command_stamp_s=float(values[1]), alarms=self.said().alarms,
        )  # fmt: skip

    def stamp_s(self) -> float:
        """Of the newest state; -inf before the first."""
        record = self._states.read()
        return -np.inf if record is None else float(record[1][0])

    def standing(self) -> Standing:
        """How the owner is, as of its newest state."""
        if (record := self._states.read()) is not None:  # else it is torn, and the last one counts
            _, values = record
            level, peak, answered = Level(int(values[3])), float(values[4]), int(values[5])
            turn = int(values[6])
            self._stood = Standing(level, peak, answered, self.said().refused, turn)
        return self._stood

    def said(self) -> Reported:
        """What the owner said last in words."""
        values = self._words.news()
        if values is not None:
            self._told = msgspec.msgpack.decode(
                values[1:].tobytes()[: int(values[0])], type=Reported
            )
        return self._told

    def be_ready(self, ready: Ready) -> None:
        """Say that a spare has seen this state, and could command."""
        self._ready.write(np.array(ready, float))

    def wish_reset(self) -> int:
        """Ask for a reset; returns the wish's number, by which its answer is known."""
        record = self._wishes.read()
        number = 1 if record is None else int(record[1][0]) + 1
        self._wishes.write(np.array([float(number)]))
        return number

    # --- the owner's side ------------------------------------------------------------------------

    def take(self) -> Order | None:
        """An order newer than the last one taken, None if there is none."""
        values = self._orders.news()
        if values is None:
            return None
        number, stamp_s, deadline_s, leaves, by = values[:5].tolist()
        command = MotorCommand(stamp_s, *values[5:].reshape(5, self.count))
        return Order(int(number), deadline_s, bool(leaves), command, int(by))

    def publish(self, state: MotorState, standing: Standing) -> None:
        """Make a state readable, and how the owner is."""
        head = (
            state.stamp_s, state.command_stamp_s, float(state.watchdog),
            float(standing.level), standing.peak, float(standing.answered), float(standing.turn),
        )  # fmt: skip
        rows: tuple[Array, ...] = (
            np.array(head), state.q, state.qd, state.tau, state.temperature_c, state.age_s,
        )  # fmt: skip
        self._states.write(np.concatenate(rows))

    def say(self, words: Reported) -> None:
        """Say something else in words, before the state that it belongs to."""
        alarms = list(words.alarms)
        while len(said := msgspec.msgpack.encode(words)) > 8 * ALARM_WORDS and alarms:
            alarms.pop()
            words = msgspec.structs.replace(words, alarms=tuple(alarms))
        padded = said.ljust(8 * ALARM_WORDS, b"\0")
        self._words.write(np.concatenate(((float(len(said)),), np.frombuffer(padded))))

    def ready(self) -> Ready | None:
        """The spare that was ready last; None: there was none, or its word is torn."""
        record = self._ready.read()
        return None if record is None else Ready(int(record[1][0]), float(record[1][1]))

    def wish(self) -> int | None:
        """Number of a wish for a reset that was not seen before."""
        values = self._wishes.news()
        return None if values is None else int(values[0])
