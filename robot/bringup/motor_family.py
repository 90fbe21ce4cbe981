"""What `humanoid motors` has to know of a family of motors: a row of `motor_families`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeAlias, TypeVar

from robot.bringup.motor_reports import Reading, Seen
from robot.clock import Clock
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.line_motors import LineMotors, Lines
from robot.drivers.motors.motor_map import Motor, MotorMap

AnyMotors: TypeAlias = LineMotors[Any, Any, Any, Any]
"""A driver, of whatever family."""

M = TypeVar("M", bound=MotorMap)
L = TypeVar("L", bound=Lines)
M_contra = TypeVar("M_contra", bound=MotorMap, contravariant=True)
L_contra = TypeVar("L_contra", bound=Lines, contravariant=True)


class Tools(Protocol[M_contra, L_contra]):
    """What a person with a screwdriver asks of a family's motors: a module."""

    def scan(self, ports: L_contra, clock: Clock, joints: M_contra, up_to: int, /) -> list[Seen]:
        """Who answers to identifiers up to a number, on lines that are open."""
        ...

    def readings(self, ports: L_contra, clock: Clock, joints: M_contra, /) -> list[Reading]:
        """What every motor says once."""
        ...

    def findings(self, ports: L_contra, clock: Clock, joints: M_contra, /) -> list[Finding]:
        """What motors say of themselves where the map says otherwise."""
        ...

    def bare(self, joint: Motor, /) -> Motor:
        """The motor of a joint by its own angles, as far as they go."""
        ...

    def resting(self, driver: AnyMotors, ports: L_contra, clock: Clock, /) -> str:
        """The status of the only joint's motor while it gives torque; "" while it does not."""
        ...

    def set_zero(self, ports: L_contra, clock: Clock, joints: M_contra, at_rad: float, /) -> None:
        """Let the only joint's motor call this position zero, where its map says it stands.

        Raises:
            DriverError: that is no good.
        """
        ...


@dataclass(frozen=True, kw_only=True)
class MotorFamily(Generic[M, L]):
    """A family of motors. `L`: the lines that its driver talks over.

    Attributes:
        driver: its row in `robot.drivers.registry`.
        of: its map, its driver and its lines.
        tools: what is asked of them from a workbench.
        title: for people.
        most_load: share of a line's time that is safe.
        late_cure, speed_cure: what a person does about late replies, about wrong speeds.
        jog_hz: how often one joint is commanded at most while it is moved from a workbench.
        measures: whether its motors say where they are.
    """

    driver: str
    of: LineFamily[M, L]
    tools: Tools[M, L]
    title: str
    most_load: float
    late_cure: str
    speed_cure: str
    jog_hz: int
    measures: bool = True
