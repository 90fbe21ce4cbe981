"""Every driver in one table. A new one is a file in its family's folder and a row here.

The description names a driver for each device (`drivers: {motors: can}`); one that it does not name
is simulated, or is not there if it has no simulated driver. What a driver needs (a CAN library, a
camera's) is imported when it is made, so that it is wanted of nobody else.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from robot.bus import topics
from robot.bus.topics import Topic
from robot.drivers.body_sample import ForceReading, ImuReading
from robot.drivers.motor_bus import MotorBus
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError
from robot.files import config, yaml_nodes
from robot.messages import DepthImage, LidarScan, PowerState, RgbdImage
from robot.model.description import Battery, Camera, Imu, Lidar, RobotDescription

R = TypeVar("R")
D_co = TypeVar("D_co", covariant=True)
SIMULATED, CAN, DYNAMIXEL, ETHERNET, PWM = "simulated", "can", "dynamixel", "ethernet", "pwm"


@dataclass(frozen=True)
class Family(Generic[D_co]):
    """The drivers of one device.

    Attributes:
        device: its key in the description's `drivers`.
        drivers: name to what makes one, which opens nothing.
    """

    device: str
    drivers: Mapping[str, Callable[[Wiring], D_co]]

    def make(self, wiring: Wiring) -> D_co:
        """The driver that the description names.

        Raises:
            ConfigError: if there is none of that name, with file, line and the nearest name, or if
                none is named and nobody simulates the device.
            DriverError: if what it is plugged into is missing.
        """
        robot = wiring.robot
        check(robot)
        name = robot.drivers.get(self.device, SIMULATED)
        if name not in self.drivers:  # one that is named was checked
            text = f"no driver of the device {self.device!r} is named, and nobody simulates it"
            cure = f"name one of {', '.join(self.drivers)} in drivers, or do without the device"
            raise ConfigError(
                [config.place(yaml_nodes.read(robot.path()), "$").problem(text, cure)]
            )
        return self.drivers[name](wiring)

    def is_simulated(self, robot: RobotDescription) -> bool:
        """Whether a robot's device is, or would be."""
        return robot.drivers.get(self.device, SIMULATED) == SIMULATED


@dataclass(frozen=True)
class Sense(Family[SensorSource[R, object]], Generic[R]):
    """The drivers of a sensor whose readings are published.

    Attributes:
        topic: where; its source is the process that opens the sensor.
    """

    topic: Topic[R]

    def is_there(self, robot: RobotDescription) -> bool:
        """Whether a robot has one: what its description leaves out, and nobody simulates, not."""
        return self.device in robot.drivers or SIMULATED in self.drivers


def _simulated_motors(wiring: Wiring) -> MotorBus:
    from robot.drivers.motors.simulated import make

    return make(wiring)


def _can_motors(wiring: Wiring) -> MotorBus:
    from robot.drivers.motors.can.driver import FAMILY

    return FAMILY.make(wiring)


def _dynamixel_motors(wiring: Wiring) -> MotorBus:
    from robot.drivers.motors.servos_and_others import make

    return make(wiring)


def _ethernet_motors(wiring: Wiring) -> MotorBus:
    from robot.drivers.motors.ethernet.driver import FAMILY

    return FAMILY.make(wiring)


def _hobby_servos(wiring: Wiring) -> MotorBus:
    from robot.drivers.motors.pwm_and_others import make

    return make(wiring)


def _simulated_imu(wiring: Wiring) -> SensorSource[ImuReading, Imu]:
    from robot.drivers.imu.simulated import make

    return make(wiring)


def _simulated_force(wiring: Wiring) -> SensorSource[ForceReading, None]:
    from robot.drivers.force.simulated import make

    return make(wiring)


def _simulated_camera(wiring: Wiring) -> SensorSource[DepthImage, Camera]:
    from robot.drivers.camera.simulated import make

    return make(wiring)


def _simulated_rgbd(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    from robot.drivers.camera.simulated import make_rgbd

    return make_rgbd(wiring)


def _uvc_rgbd(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    from robot.drivers.camera.uvc import make

    return make(wiring)


def _realsense_rgbd(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    from robot.drivers.camera.realsense import make

    return make(wiring)


def _simulated_lidar(wiring: Wiring) -> SensorSource[LidarScan, Lidar]:
    from robot.drivers.lidar.simulated import make

    return make(wiring)


def _simulated_battery(wiring: Wiring) -> SensorSource[PowerState, Battery | None]:
    from robot.drivers.battery.simulated import make

    return make(wiring)


MOTORS = Family(
    "motors",
    {
        SIMULATED: _simulated_motors,
        CAN: _can_motors,
        DYNAMIXEL: _dynamixel_motors,
        ETHERNET: _ethernet_motors,
        PWM: _hobby_servos,
    },
)

# What the controller reads in every period (`robot.drivers.body_devices`).
IMU = Family("imu", {SIMULATED: _simulated_imu})
FORCE = Family("force", {SIMULATED: _simulated_force})

# Whole pictures: perception opens it where somebody looks at them (`robot.perception.eye`).
RGBD = Family("rgbd", {SIMULATED: _simulated_rgbd, "uvc": _uvc_rgbd, "realsense": _realsense_rgbd})

# What is published: its topic's source is the process that opens it
# (`robot.drivers.published_sensors`).
SENSES: tuple[Sense[Any], ...] = (
    Sense("camera", {SIMULATED: _simulated_camera}, topics.DEPTH),
    Sense("lidar", {SIMULATED: _simulated_lidar}, topics.LIDAR),
    Sense("battery", {SIMULATED: _simulated_battery}, topics.POWER),
)

FAMILIES: tuple[Family[object], ...] = (MOTORS, IMU, FORCE, RGBD, *SENSES)


def commanded_motors(wiring: Wiring) -> MotorBus:
    """What a controller commands: the motors, or the process that owns their buses, if one does.

    Raises:
        ConfigError, DriverError: as `Family.make`, also where somebody else opens them.
    """
    motors = MOTORS.make(wiring)  # opens nothing
    if wiring.owner is None:
        return motors
    from robot.drivers.motors.owned.driver import OwnedMotors

    return OwnedMotors(
        wiring.robot, wiring.owner, clock=wiring.clock, capabilities=motors.capabilities
    )


OWNED = frozenset({CAN, ETHERNET})
"""Motors that a process of its own commands (`robot.owner`), where a description says nothing."""


def is_owned(robot: RobotDescription) -> bool:
    """Whether a process of its own commands a robot's motors, and outlives the controller."""
    if robot.bus_owner is not None:
        return robot.bus_owner.enabled
    return robot.drivers.get(MOTORS.device, SIMULATED) in OWNED


def check(robot: RobotDescription) -> None:
    """Whether every driver that a description names is in the table.

    Raises:
        ConfigError: naming each device and driver that is not, with file, line and nearest name.
    """
    families = {family.device: family for family in FAMILIES}
    wrong: dict[str, tuple[str, str]] = {}
    for device, driver in robot.drivers.items():
        if device not in families:
            cure = config.nearest(device, list(families))
            wrong[device] = f"unknown device {device!r} in drivers", cure
        elif driver not in (known := families[device].drivers):
            cure = config.nearest(driver, list(known))
            wrong[device] = f"unknown driver {driver!r} of the device {device!r}", cure
    if not wrong:
        return
    node = yaml_nodes.read(robot.path())
    raise ConfigError(
        [
            config.place(node, f"$.drivers.{device}").problem(text, cure)
            for device, (text, cure) in wrong.items()
        ]
    )
