"""The parts of a body that commands go to, each answering with what it does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from robot.messages import Activity, Channel, Side
from robot.model.body import SIDES

ARM_CHANNEL: dict[Side, Channel] = {"left": "left_arm", "right": "right_arm"}
HAND_CHANNEL: dict[Side, Channel] = {"left": "left_hand", "right": "right_hand"}


class Part(Protocol):
    """What commands go to.

    Attributes:
        activity: the newest command and how it goes.
    """

    activity: Activity


def part_of(
    channel: Channel,
    legs: Part,
    head: Part,
    arms: Mapping[Side, Part],
    hands: Mapping[Side, Part],
) -> Part | None:
    """Whom commands of a channel go to; None where the body has no such part."""
    if channel in ("legs", "head"):
        return legs if channel == "legs" else head
    for side in SIDES:
        if channel in (ARM_CHANNEL[side], HAND_CHANNEL[side]):
            return (arms if channel == ARM_CHANNEL[side] else hands).get(side)
    return None


def activities(
    legs: Part, head: Part, arms: Mapping[Side, Part], hands: Mapping[Side, Part]
) -> dict[Channel, Activity]:
    """What every part that the body has does."""
    result: dict[Channel, Activity] = {"legs": legs.activity, "head": head.activity}
    for side in SIDES:
        if side in arms:
            result[ARM_CHANNEL[side]] = arms[side].activity
        if side in hands:
            result[HAND_CHANNEL[side]] = hands[side].activity
    return result
