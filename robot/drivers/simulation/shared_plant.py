"""A simulated plant in another process: a file in memory with a command and a sample.

It begins with what both sides must agree on: a magic with the layout's version, the number of
motors, and the hash of the configuration; then come its two records, each a `Seqlock`.
"""

from __future__ import annotations

import contextlib
import mmap
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.drivers.simulation.seqlock import Seqlock
from robot.drivers.simulation.turns import Turns
from robot.errors import DriverError
from robot.model.description import RobotDescription
from robot.se3 import Array

MAGIC = b"HUMOTOR2"
HEADER = struct.Struct("<8sQ32s16x")
NAME = "motors"
"""Of the file."""
PERIOD_S = 0.002
POLL_S = 0.0001
OPEN_TIMEOUT_S = 10.0
SILENCE_S = 1.0


def _command_size(count: int) -> int:
    return 1 + 5 * count


def _sample_size(count: int) -> int:
    return 4 + 4 * count + 30


class PlantMemory(Turns):
    """The file, mapped: a header and two records."""

    def __init__(self, robot: RobotDescription, folder: Path, *, create: bool) -> None:
        """Map the file; the plant creates it, a driver checks it.

        Raises:
            DriverError: if it is not there, or not of this layout, robot and configuration.
        """
        path, count = folder / NAME, len(robot.motors)
        sample_at = HEADER.size + Seqlock.bytes_for(_command_size(count))
        size = sample_at + Seqlock.bytes_for(_sample_size(count))
        header = HEADER.pack(MAGIC, count, robot.digest())
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
        self.sample = Seqlock(self._map, sample_at, size=_sample_size(count))

    def close(self) -> None:
        """Let go of the memory; the file stays."""
        self.command.release()
        self.sample.release()
        self._map.close()
        self._file.close()


class SharedPlant:
    """A driver's side: a `SimulatedPlant`.

    One process at a time commands the motors; any may read. The system takes the claim away from a
    process that dies, at once, and gives it to the next that asks.

    Attributes:
        repeats: reads that had to repeat the last sample because no new one came in time.
    """

    def __init__(self, robot: RobotDescription, folder: Path, *, clock: Clock) -> None:
        """Look for the file in `folder`, once it is opened."""
        self.repeats = 0
        self._robot, self._folder, self._clock = robot, folder, clock
        self._memory: PlantMemory | None = None
        self._opened = 0
        self._commander: object | None = None
        self._fresh: Array = np.zeros(len(robot.motors))
        self._sample: BodySample | None = None
        self._given: BodySample | None = None
        self._heard_s = 0.0

    @property
    def torn(self) -> int:
        """Reads refused because the record was torn."""
        return self._memory.sample.torn if self._memory else 0

    def open(self) -> None:
        """Wait for the plant and its first sample. Raises DriverError if it does not come."""
        if self._memory is None:
            self._memory = self._join()
        self._opened += 1

    def close(self) -> None:
        """Let go of the memory with the last of those who opened it."""
        self._opened -= 1
        if self._opened == 0 and self._memory is not None:
            self._memory.close()
            self._memory = self._sample = self._given = self._commander = None

    def claim(self, driver: object) -> bool:
        """Let this driver alone command the motors; False while another one does."""
        if self._commander is None and self._mapped().lock():
            self._commander = driver
        return self._commander is driver

    def release(self, driver: object) -> None:
        """Let another driver command, if this one did."""
        if self._commander is driver:
            self._mapped().unlock()
            self._commander = None

    @property
    def sample(self) -> BodySample:
        """The newest there is. Raises DriverError if nothing came for a second."""
        sample = self._fetch(self._mapped())
        if sample is None:
            raise DriverError("the plant has no whole sample to give")
        return sample

    def read(self) -> BodySample:
        """The next sample, waited for at most one period; else the last one again, aged.

        Raises:
            DriverError: if it is closed, or nothing came for a second.
        """
        memory = self._mapped()
        until_s = self._clock.now_s() + PERIOD_S
        while (sample := self._fetch(memory)) is self._given or sample is None:
            now_s = self._clock.now_s()
            if now_s >= until_s and sample is not None:
                self.repeats += 1
                age_s = np.full(memory.count, now_s - self._heard_s)
                return replace(sample, motors=replace(sample.motors, age_s=age_s))
            self._clock.sleep_until(now_s + POLL_S)
        self._given = sample
        return sample

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command; claim first.

        Raises:
            DriverError: if it is not finite or of a wrong shape.
        """
        memory = self._mapped()
        fields = (command.q_des, command.qd_des, command.tau_ff, command.kp, command.kd)
        for field in fields:
            if field.shape != (memory.count,):
                raise DriverError(f"a command has shape {field.shape}, not ({memory.count},)")
        values = np.concatenate(((command.stamp_s,), *fields))
        if not np.isfinite(values).all():
            raise DriverError("a command is not finite; it was not sent")
        memory.command.write(values)
        return command

    def _join(self) -> PlantMemory:
        """The plant's memory, once a first sample is in it."""
        until_s = self._clock.now_s() + OPEN_TIMEOUT_S
        while not (self._folder / NAME).exists():
            self._wait(until_s, "the plant did not open its motors")
        memory = PlantMemory(self._robot, self._folder, create=False)
        try:
            self._heard_s = self._clock.now_s()
            while memory.sample.sequence == 0:
                self._wait(until_s, "the plant's motors do not answer")
        except DriverError:
            memory.close()
            raise
        self._heard_s = self._clock.now_s()
        return memory

    def _fetch(self, memory: PlantMemory) -> BodySample | None:
        """The newest sample; raises DriverError if nothing came for a second."""
        if (values := memory.sample.news()) is not None:
            self._sample = _unpack(values, self._fresh)
            self._heard_s = self._clock.now_s()
        elif (silence_s := self._clock.now_s() - self._heard_s) > SILENCE_S:
            raise DriverError(f"the motors are silent for {silence_s:.1f} s")
        return self._sample

    def _wait(self, until_s: float, complaint: str) -> None:
        now_s = self._clock.now_s()
        if now_s > until_s:
            raise DriverError(f"{complaint} at {self._folder / NAME}")
        self._clock.sleep_until(now_s + 10 * POLL_S)

    def _mapped(self) -> PlantMemory:
        if self._memory is None:
            raise DriverError("the simulated plant is not open")
        return self._memory


class PlantServer(Closing):
    """The plant's side: publishes samples, takes commands."""

    def __init__(self, robot: RobotDescription, folder: Path) -> None:
        """Create the file anew. Raises DriverError if that cannot be done."""
        self._memory = PlantMemory(robot, folder, create=True)

    @property
    def torn(self) -> int:
        """Commands refused because the record was torn."""
        return self._memory.command.torn

    def publish(self, sample: BodySample) -> None:
        """Make a sample readable; it is of one instant, and a simulated motor always answers."""
        self._memory.sample.write(_pack(sample))

    def take(self) -> MotorCommand | None:
        """A command newer than the last one taken, None if there is none."""
        values = self._memory.command.news()
        if values is None:
            return None
        return MotorCommand(float(values[0]), *values[1:].reshape(5, self._memory.count))

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


def _pack(sample: BodySample) -> Array:
    state, imu, force = sample.motors, sample.imu, sample.force
    return np.concatenate(
        (
            (state.stamp_s, state.command_stamp_s, float(state.watchdog), imu.stamp_s),
            state.q,
            state.qd,
            state.tau,
            state.temperature_c,
            imu.gyro_rad_s,
            imu.accel_m_s2,
            force.ankle_wrench.ravel(),
            force.wrist_wrench.ravel(),
        )
    )


def _unpack(values: Array, age_s: Array) -> BodySample:
    count = len(age_s)
    stamp_s = float(values[0])
    rows = values[4 : 4 + 4 * count].reshape(4, count)
    rest = values[4 + 4 * count :]
    state = MotorState(
        stamp_s=stamp_s,
        q=rows[0],
        qd=rows[1],
        tau=rows[2],
        temperature_c=rows[3],
        age_s=age_s,
        watchdog=bool(values[2]),
        command_stamp_s=float(values[1]),
    )
    imu = ImuReading(float(values[3]), rest[:3], rest[3:6])
    force = ForceReading(stamp_s, rest[6:18].reshape(2, 6), rest[18:30].reshape(2, 6))
    return BodySample(state, imu, force)
