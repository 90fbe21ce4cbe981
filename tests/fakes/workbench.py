"""`humanoid motors --emulated` in simulated time: a bench in this process, and who waits plays it.

What lies between is shown by the tests that are `live`: processes, sockets and the wall clock.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import pytest

from executive.frontends.motors import commands
from robot.bringup import motor_families
from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.registry import CAN, DYNAMIXEL, ETHERNET, PWM
from sim.devices import direct, ethernet_bench, families, pwm_bench, servo_bench
from sim.simulation import Simulation

PORTS: Mapping[str, Callable[[Any, Any, SimulatedClock], Closing]] = {
    CAN: lambda _, bench, clock: direct.DirectPorts(bench, clock),
    DYNAMIXEL: lambda _, bench, clock: servo_bench.DirectPorts(bench, clock),
    ETHERNET: lambda _, bench, clock: ethernet_bench.DirectPorts(bench, clock),
    PWM: pwm_bench.DirectChips,
}
"""The lines of each family, straight onto a bench."""


class Workbench:
    """The motors that the command under way emulates.

    Attributes:
        clock: of whoever asks for the wall's.
    """

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        """Take the place of processes, lines and clock."""
        self.clock = SimulatedClock(100.0)
        self._built: Any = None
        patch.setattr(commands, "WallClock", lambda: self.clock)
        patch.setattr(Simulation, "motors", self._motors)
        rows = tuple(self._here(family) for family in motor_families.FAMILIES)
        patch.setattr(motor_families, "FAMILIES", rows)

    def _here(self, family: Any) -> Any:
        ports = PORTS[family.driver]
        lines = replace(family.of, ports=lambda joints, clock: ports(joints, self._built, clock))
        return replace(family, of=lines)

    def _motors(self, file: Path, *, flaws: Mapping[str, str], is_still: bool = False) -> _Buses:
        wanted, _, emulated = families.loaded(file)
        self._built = emulated.build(
            wanted, now_s=self.clock.now_s(), flaws=flaws, is_still=is_still
        )
        return _Buses({name: f"bench-{os.getpid()}-{name}" for name in wanted.channels})


class _Buses(Closing):
    """Lines that no other test claims."""

    def __init__(self, channels: Mapping[str, str]) -> None:
        self.channels = channels

    def __enter__(self) -> Self:
        return self

    def close(self) -> None:
        """Nothing runs."""
