"""What `humanoid motors` has to know of a family of motors: a row of `motor_families`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from robot.bringup.motor_reports import Reading, Seen
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MotorBus
from robot.drivers.motors.alarms import Alarms
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import Motor, MotorMap
from robot.drivers.motors.speed_check import SpeedCheck


class Heard(Protocol):
    """What motors told."""

    lost: int
    """Replies that did not come in their period."""

    def forget_where(self) -> None:
        """Believe whatever position comes next."""
        ...


class MapDriver(MotorBus, Protocol):
    """A driver of the motors of a joint map."""

    @property
    def joints(self) -> MotorMap:
        """The map, in the order of every array."""
        ...

    @property
    def alarms(self) -> Alarms:
        """What is wrong now."""
        ...

    @property
    def speeds(self) -> SpeedCheck:
        """How reported speeds compare with reported positions."""
        ...

    @property
    def reception(self) -> Heard:
        """What motors told last."""
        ...

    @property
    def late(self) -> int:
        """Periods that began late by more than one."""
        ...

    def status_of(self, index: int) -> str:
        """What a joint's motor says of itself, in one word."""
        ...

    def reset(self) -> None:
        """Forget every alarm."""
        ...


M = TypeVar("M", bound=MotorMap)
P = TypeVar("P", bound=Closing)
M_contra = TypeVar("M_contra", bound=MotorMap, contravariant=True)
P_contra = TypeVar("P_contra", bound=Closing, contravariant=True)


class MakesDriver(Protocol[M_contra, P_contra]):
    """A family's driver, as its class."""

    def __call__(
        self,
        joints: M_contra,
        clock: Clock,
        *,
        ports: Callable[[], P_contra],
        lets_go: bool = False,
    ) -> MapDriver:
        """Know the motors of a map; `lets_go`: at the end they give no torque, and do not damp."""
        ...


@dataclass(frozen=True, kw_only=True)
class MotorFamily(Generic[M, P]):
    """A family of motors. `P`: the buses or ports that its driver talks over.

    Attributes:
        driver: its row in `robot.drivers.registry`.
        title: for people.
        file: its map beside a robot's description.
        lines: what a map of it calls its buses or ports, and no other family's.
        map: of its motors.
        load: reads one; raises ConfigError.
        elsewhere: the same map with its lines at other channels, opened by this interface.
        check_user: raises DriverError where the user does not let robots open one of its lines.
        most_load: share of a line's time that is safe.
        ports: makes what is opened by entering.
        motors: makes a driver.
        scan: who answers to identifiers up to a number, on lines that are open.
        readings: what every motor says once.
        findings: what motors say of themselves where the map says otherwise.
        late_cure, speed_cure: what a person does about late replies, about wrong speeds.
        jog_hz: how often one joint is commanded at most while it is moved from a workbench.
        bare: the motor of a joint by its own angles, as far as they go.
        resting: the status of the only joint's motor while it gives torque; "" while it does not.
        set_zero: lets the only joint's motor call this position zero, where its map says the angle
            at which it stands; raises DriverError where that is no good.
        measures: whether its motors say where they are.
    """

    driver: str
    title: str
    file: str
    lines: str
    map: type[M]
    load: Callable[[Path], M]
    elsewhere: Callable[[M, Mapping[str, str], str], M]
    check_user: Callable[[M], None]
    most_load: float
    ports: Callable[[M, Clock], P]
    motors: MakesDriver[M, P]
    scan: Callable[[P, Clock, M, int], list[Seen]]
    readings: Callable[[P, Clock, M], list[Reading]]
    findings: Callable[[P, Clock, M], list[Finding]]
    late_cure: str
    speed_cure: str
    jog_hz: int
    bare: Callable[[Motor], Motor]
    resting: Callable[[MapDriver, P, Clock], str]
    set_zero: Callable[[P, Clock, M, float], None]
    measures: bool = True
