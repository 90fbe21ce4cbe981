"""The families of motors that are emulated on a bench: a row each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from robot.bringup import motor_families
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.registry import CAN, DYNAMIXEL, ETHERNET, PWM
from sim.devices import bench, ethernet_bench, pwm_bench, servo_bench
from sim.devices.bench import Bench
from sim.devices.ethernet_bench import EthernetBench
from sim.devices.i2c_server import I2cServer
from sim.devices.pwm_bench import PwmBench
from sim.devices.serial_server import SerialServer
from sim.devices.server import CanServer
from sim.devices.servo_bench import ServoBench
from sim.devices.udp_server import UdpServer

B = TypeVar("B")
B_co = TypeVar("B_co", covariant=True)


class Server(Closing, Protocol):
    """Plays devices in time with a clock."""

    def serve(self, until_s: float) -> None:
        """Until a time."""
        ...


class Builds(Protocol[B_co]):
    """Makes the motors of a map."""

    def __call__(
        self,
        wanted: Any,
        *,
        now_s: float = 0.0,
        flaws: Mapping[str, str] | None = None,
        is_still: bool = False,
    ) -> B_co:
        """In the middle of their joints' ranges; raises ConfigError as `bench.build`."""
        ...


@dataclass(frozen=True, kw_only=True)
class EmulatedFamily(Generic[B]):
    """How one family is emulated.

    Attributes:
        build: makes its motors.
        serve: puts them at paths, as many as there are lines.
    """

    build: Builds[B]
    serve: Callable[[Sequence[Path], B, Clock], Server]


def _on_sockets(paths: Sequence[Path], built: Bench, clock: Clock) -> Server:
    return CanServer(list(zip(paths, built.wires.values(), strict=True)), built.devices, clock)


def _on_terminals(paths: Sequence[Path], built: ServoBench, clock: Clock) -> Server:
    return SerialServer(list(zip(paths, built.lines.values(), strict=True)), clock)


def _on_udp(paths: Sequence[Path], built: EthernetBench, clock: Clock) -> Server:
    return UdpServer(list(zip(paths, built.cables.values(), strict=True)), clock)


def _on_i2c(paths: Sequence[Path], built: PwmBench, clock: Clock) -> Server:
    return I2cServer(list(zip(paths, built.buses.values(), strict=True)), built, clock)


EMULATED: Mapping[str, EmulatedFamily[Any]] = {
    CAN: EmulatedFamily(build=bench.build, serve=_on_sockets),
    DYNAMIXEL: EmulatedFamily(build=servo_bench.build, serve=_on_terminals),
    PWM: EmulatedFamily(build=pwm_bench.build, serve=_on_i2c),
    ETHERNET: EmulatedFamily(build=ethernet_bench.build, serve=_on_udp),
}


class Loaded(NamedTuple):
    """A joint map, its family, and how that is emulated."""

    joints: MotorMap
    family: LineFamily[Any, Any]
    emulated: EmulatedFamily[Any]


def loaded(file: Path) -> Loaded:
    """A joint map, and how its motors are emulated.

    Raises:
        ConfigError: with everything that is wrong in the map.
    """
    family = motor_families.of_file(file)
    return Loaded(family.of.load(file), family.of, EMULATED[family.driver])
