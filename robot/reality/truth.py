"""What should be so at the end of a run, and how it truly was: what evaluations judge by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from robot import config
from robot.errors import ConfigError, Problem
from robot.messages import WorldMap


class Check(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing that should be so: about an object (`held`, `on` a place), or about the robot.

    `at` is a point of the floor [m] that the robot stands at, within `within_m`.
    """

    object: str = ""
    held: bool = False
    on: str = ""
    at: tuple[float, float] | None = None
    within_m: float = 0.15

    def __post_init__(self) -> None:
        """Check that it says something."""
        if bool(self.object) == (self.at is not None) or bool(self.object) != (
            self.held or bool(self.on)
        ):
            raise ValueError("a check is {object, held: true}, {object, on} or {at}")


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """How a run truly ended.

    Attributes:
        wrong: each check that does not hold, in words; none: all is as it should be.
        upright: whether the robot truly stands on its feet.
        damped: whether the motors are left to damp by themselves.
    """

    wrong: tuple[str, ...]
    upright: bool
    damped: bool
    source: str = "oracle"


def read(data: Sequence[Mapping[str, Any]], world_map: WorldMap) -> tuple[Check, ...]:
    """Checks out of plain data. Raises ConfigError with the nearest valid name."""
    try:
        checks = msgspec.convert(list(data), tuple[Check, ...])
    except msgspec.ValidationError as error:
        raise ConfigError(f"a check of the truth: {error}") from None
    objects = [item.id for item in world_map.objects]
    for check in checks:
        if check.object and check.object not in objects:
            hint = config.nearest(check.object, objects)
            raise ConfigError([Problem(f"unknown object {check.object!r}", suggestion=hint)])
    return checks
