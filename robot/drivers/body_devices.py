"""All that a controller has of its body: motors, IMU, forces, and the sensors that it publishes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import Self, TypeVar

from robot.closing import Closing
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import Capability, MotorCommand
from robot.drivers.published_sensors import PublishedSensors
from robot.drivers.registry import FORCE, IMU, commanded_motors
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError

R = TypeVar("R")
FIRST_S, POLL_S = 10.0, 0.001
"""How long the first reading of a sensor may take, and how often it is looked for."""


class BodyDevices(Closing):
    """Drivers out of the description, opened and read together.

    The motors' states set the pace; of the others the newest reading counts.
    """

    def __init__(
        self,
        wiring: Wiring,
        *,
        needs: frozenset[Capability],
        on_sample: Callable[[BodySample], None] | None = None,
    ) -> None:
        """Make the drivers; nothing is opened.

        Args:
            wiring: what they are made of.
            needs: what the motors must be able to do.
            on_sample: hears every sample that is read, for those who record.

        Raises:
            ConfigError: if the description names a driver that there is not.
            DriverError: if a driver cannot be, or the motors cannot do what the controller needs.
        """
        self._motors = commanded_motors(wiring)
        if lacking := needs - self._motors.capabilities:
            raise DriverError(
                f"the motors of {wiring.robot.name!r} lack what its controller needs: "
                + ", ".join(sorted(lacking))
            )
        self._imu, self._force = IMU.make(wiring), FORCE.make(wiring)
        self._senses = PublishedSensors(wiring, "controller")
        self._clock = wiring.clock
        self._on_sample = on_sample
        self._felt: ImuReading | None = None
        self._borne: ForceReading | None = None
        self._opened = ExitStack()

    def __enter__(self) -> Self:
        """Open them all. Raises DriverError if one is not there."""
        with ExitStack() as stack:
            for sensor in (self._imu, self._force, self._senses):
                stack.enter_context(sensor)
            stack.enter_context(self._motors)  # the last to be opened is the first to be let go
            self._opened = stack.pop_all()
        return self

    def claim(self) -> bool:
        """Become the one that commands the motors; False while another one is."""
        return self._motors.claim()

    def read(self) -> BodySample:
        """The next state of the motors, and the newest readings. Raises DriverError on silence."""
        motors = self._motors.read()
        self._felt = self._newest("IMU", self._imu, self._felt)
        self._borne = self._newest("force sensors", self._force, self._borne)
        sample = BodySample(motors, self._felt, self._borne)
        if self._on_sample is not None:
            self._on_sample(sample)
        return sample

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command every motor; see `MotorBus.write`."""
        return self._motors.write(command)

    def relay(self) -> None:
        """Publish what the controller's other sensors brought."""
        self._senses.relay()

    def close(self) -> None:
        """Damp the motors, if they are commanded from here, and let go of everything."""
        self._opened.close()

    def _newest(self, name: str, source: SensorSource[R, object], last: R | None) -> R:
        """The newest reading; a first one is waited for."""
        readings: Sequence[R] = source.read()
        if readings:
            return readings[-1]
        if last is not None:
            return last
        until_s = self._clock.now_s() + FIRST_S
        while not (readings := source.read()):
            if self._clock.now_s() > until_s:
                raise DriverError(f"the {name} gave nothing for {FIRST_S:.0f} s")
            self._clock.sleep_until(self._clock.now_s() + POLL_S)
        return readings[-1]
