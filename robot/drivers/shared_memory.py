"""The motors of a simulated plant in another process, through a memory map.

The file begins with what both sides must agree on: a magic with the layout's version, the number
of motors, and the hash of the configuration; then the command and the state, each a `Seqlock`.
"""

from __future__ import annotations

import contextlib
import fcntl
import mmap
import struct
from pathlib import Path
from typing import Self

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.fingerprint import fingerprint
from robot.drivers.motors import MotorCommand, MotorState
from robot.drivers.seqlock import Seqlock
from robot.errors import DriverError
from robot.model.description import RobotDescription
from robot.se3 import Array

MAGIC = b"HUMOTOR1"
HEADER = struct.Struct("<8sQ32s16x")
PERIOD_S = 0.002
POLL_S = 0.0001
OPEN_TIMEOUT_S = 10.0
SILENCE_S = 1.0


def _command_size(count: int) -> int:
    return 1 + 5 * count


def _state_size(count: int) -> int:
    return 3 + 4 * count + 30


class MotorMemory:
    """The file, mapped: a header and two records."""

    def __init__(self, path: Path, *, count: int, configuration: bytes, create: bool) -> None:
        """Map the file; the plant creates it, the controller checks it.

        Raises:
            DriverError: if it is not there, or not of this layout, robot and configuration.
        """
        state_at = HEADER.size + Seqlock.bytes_for(_command_size(count))
        size = state_at + Seqlock.bytes_for(_state_size(count))
        header = HEADER.pack(MAGIC, count, configuration)
        if create:
            fresh = path.with_suffix(".new")
            fresh.write_bytes(header + bytes(size - len(header)))
            fresh.rename(path)  # a reader sees all of the header or no file
        try:
            with contextlib.ExitStack() as stack:
                file = stack.enter_context(path.open("r+b"))
                _check_header(file.read(HEADER.size), header)
                self._map = mmap.mmap(file.fileno(), size)
                self._file = file
                stack.pop_all()  # it stays open: the lock is the file's
        except (OSError, ValueError) as error:
            raise DriverError(f"the motors' memory {path} cannot be mapped: {error}") from error
        self.count = count
        self.command = Seqlock(self._map, HEADER.size, size=_command_size(count))
        self.state = Seqlock(self._map, state_at, size=_state_size(count))

    def lock(self) -> bool:
        """Become the one that commands, until `close` or the process's end; False: another is."""
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def close(self) -> None:
        """Let go of the memory; the file stays."""
        self.command.release()
        self.state.release()
        self._map.close()
        self._file.close()


class SharedMotors(Closing):
    """The controller's side: a `MotorBus`.

    One process at a time commands the motors; any may read them. The system takes the claim away
    from a process that dies, at once, and gives it to the next that asks.

    Attributes:
        repeats: reads that had to repeat the last state because no new one came in time.
    """

    def __init__(self, path: Path, *, count: int, configuration: bytes, clock: Clock) -> None:
        self.repeats = 0
        self._path = path
        self._count = count
        self._configuration = configuration
        self._clock = clock
        self._memory: MotorMemory | None = None
        self._claimed = False
        self._sequence: int = 0
        self._state: MotorState | None = None
        self._heard_s = 0.0

    @classmethod
    def of(cls, robot: RobotDescription, path: Path, *, clock: Clock) -> SharedMotors:
        """The motors of a robot."""
        count = len(robot.motors)
        return cls(path, count=count, configuration=fingerprint(robot), clock=clock)

    @property
    def torn(self) -> int:
        """Reads refused because the record was torn."""
        return self._memory.state.torn if self._memory else 0

    def __enter__(self) -> Self:
        """Wait for the plant and its first state. Raises DriverError if it does not come."""
        until_s = self._clock.now_s() + OPEN_TIMEOUT_S
        while not self._path.exists():
            self._wait(until_s, "the plant did not open its motors")
        self._memory = MotorMemory(
            self._path, count=self._count, configuration=self._configuration, create=False
        )
        while self._fetch(self._memory) is None:
            self._wait(until_s, "the plant's motors do not answer")
        return self

    def close(self) -> None:
        """Damp every motor, if it is this driver that commands them, and close."""
        if self._memory is None:
            return
        stamp_s = self._state.stamp_s if self._state else 0.0
        if self.claim():
            self.write(MotorCommand.damping(self._count, stamp_s))
        self._memory.close()
        self._memory, self._claimed = None, False

    def claim(self) -> bool:
        """Become the one that commands the motors; False while another one is."""
        self._claimed = self._claimed or self._opened().lock()
        return self._claimed

    def read(self) -> MotorState:
        """The next state, waited for at most one period; else the last one again.

        Raises:
            DriverError: if the driver is closed, or nothing came for a second.
        """
        memory = self._opened()
        until_s = self._clock.now_s() + PERIOD_S
        while (state := self._fetch(memory)) is None:
            now_s = self._clock.now_s()
            if now_s - self._heard_s > SILENCE_S:
                raise DriverError(f"the motors are silent for {now_s - self._heard_s:.1f} s")
            if now_s >= until_s and self._state is not None:
                self.repeats += 1
                return self._state
            self._clock.sleep_until(now_s + POLL_S)
        return state

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command.

        Raises:
            DriverError: if it is not finite or of a wrong shape, or another driver commands.
        """
        memory = self._opened()
        if not self.claim():
            raise DriverError("another controller commands the motors")
        fields = (command.q_des, command.qd_des, command.tau_ff, command.kp, command.kd)
        for field in fields:
            if field.shape != (self._count,):
                raise DriverError(f"a command has shape {field.shape}, not ({self._count},)")
        values = np.concatenate(((command.stamp_s,), *fields))
        if not np.isfinite(values).all():
            raise DriverError("a command is not finite; it was not sent")
        memory.command.write(values)
        return command

    def _fetch(self, memory: MotorMemory) -> MotorState | None:
        """A state newer than the last one, if there is one."""
        if memory.state.sequence == self._sequence:
            return None
        record = memory.state.read()
        if record is None:
            return None
        sequence, values = record
        self._sequence = sequence
        self._state = _unpack_state(values, self._count)
        self._heard_s = self._clock.now_s()
        return self._state

    def _wait(self, until_s: float, complaint: str) -> None:
        now_s = self._clock.now_s()
        if now_s > until_s:
            raise DriverError(f"{complaint} at {self._path}")
        self._clock.sleep_until(now_s + 10 * POLL_S)

    def _opened(self) -> MotorMemory:
        if self._memory is None:
            raise DriverError("the motors are not open")
        return self._memory


class MotorServer:
    """The plant's side: publishes states, takes commands."""

    def __init__(self, path: Path, *, count: int, configuration: bytes) -> None:
        """Create the file anew. Raises DriverError if that cannot be done."""
        self._count = count
        self._memory = MotorMemory(path, count=count, configuration=configuration, create=True)
        self._sequence = 0

    @classmethod
    def of(cls, robot: RobotDescription, path: Path) -> MotorServer:
        """For the motors of a robot."""
        return cls(path, count=len(robot.motors), configuration=fingerprint(robot))

    @property
    def torn(self) -> int:
        """Commands refused because the record was torn."""
        return self._memory.command.torn

    def publish(self, state: MotorState) -> None:
        """Make a state readable."""
        self._memory.state.write(_pack_state(state))

    def take(self) -> MotorCommand | None:
        """A command newer than the last one taken, None if there is none."""
        if self._memory.command.sequence == self._sequence:
            return None
        record = self._memory.command.read()
        if record is None:
            return None
        sequence, values = record
        self._sequence = sequence
        rows = values[1:].reshape(5, self._count)
        return MotorCommand(float(values[0]), *rows)

    def close(self) -> None:
        """Let go of the memory."""
        self._memory.close()


def _check_header(found: bytes, expected: bytes) -> None:
    """Both sides must be of one layout, robot and configuration."""
    if len(found) != HEADER.size:
        raise DriverError("the motors' memory is too short to be one")
    magic, count, configuration = HEADER.unpack(found)
    wanted_magic, wanted_count, wanted_configuration = HEADER.unpack(expected)
    if magic != wanted_magic:
        raise DriverError(f"the motors' memory has layout {magic!r}, not {wanted_magic!r}")
    if configuration != wanted_configuration or count != wanted_count:
        raise DriverError(
            "the plant and the controller were started with different robots: configuration "
            f"{configuration.hex()[:16]} ({count} motors) in the plant, "
            f"{wanted_configuration.hex()[:16]} ({wanted_count} motors) here"
        )


def _pack_state(state: MotorState) -> Array:
    return np.concatenate(
        (
            (state.stamp_s, state.command_stamp_s, float(state.watchdog)),
            state.q,
            state.qd,
            state.tau,
            state.temperature_c,
            state.gyro_rad_s,
            state.accel_m_s2,
            state.ankle_wrench.ravel(),
            state.wrist_wrench.ravel(),
        )
    )


def _unpack_state(values: Array, count: int) -> MotorState:
    rows = values[3 : 3 + 4 * count].reshape(4, count)
    rest = values[3 + 4 * count :]
    return MotorState(
        stamp_s=float(values[0]),
        q=rows[0],
        qd=rows[1],
        tau=rows[2],
        temperature_c=rows[3],
        gyro_rad_s=rest[:3],
        accel_m_s2=rest[3:6],
        ankle_wrench=rest[6:18].reshape(2, 6),
        wrist_wrench=rest[18:30].reshape(2, 6),
        watchdog=bool(values[2]),
        command_stamp_s=float(values[1]),
    )
