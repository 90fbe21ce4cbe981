"""Commands that cannot be meant are refused before they touch anything."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, cast

import msgspec

from robot.messages import BodyCommand, Channel, Grip, HoldArm, Look, MoveArm, MoveHand, Payload
from robot.model.description import RobotDescription


def problem(command: BodyCommand, robot: RobotDescription) -> str:
    """Why this robot refuses a command, empty if it does not."""
    if not _finite(msgspec.to_builtins(command, enc_hook=float)):
        return "a number in the command is not finite"
    if isinstance(command, Grip | Payload | MoveHand) and command.side not in robot.hands:
        return f"this robot has no {command.side} hand"
    if isinstance(command, MoveArm | HoldArm) and command.side not in robot.arm_sides:
        return f"this robot has no {command.side} arm"
    most_kg = robot.arms.max_payload_kg
    if isinstance(command, Payload) and not 0.0 <= command.mass_kg <= most_kg:
        return f"a hand carries 0 to {most_kg:g} kg"
    return ""


def channel(command: BodyCommand) -> Channel:
    """The channel whose activity answers a command."""
    if isinstance(command, Grip | Payload):
        return "left_hand" if command.side == "left" else "right_hand"
    if isinstance(command, MoveArm | MoveHand | HoldArm):
        return "left_arm" if command.side == "left" else "right_arm"
    return "head" if isinstance(command, Look) else "legs"


def _finite(value: Any) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(_finite(one) for one in cast("dict[Any, Any]", value).values())
    if isinstance(value, list | tuple):
        return all(_finite(one) for one in cast("Iterable[Any]", value))
    return True
