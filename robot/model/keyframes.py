"""Motions of a body that are played back: keyframe by keyframe."""

from __future__ import annotations

from typing import Literal

import msgspec

from robot.files import quantities as q


class Keyframe(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One stage of a motion: the joints named move to their values, the others stay.

    `duration_s` is the least it takes (the joints' speed may ask for more), `hold_s` how long it
    then rests. With `needs` it begins only if the trunk is so by then; else the motion is missed.
    """

    name: str
    duration_s: q.Duration
    posture: dict[str, q.Joint]
    hold_s: q.Rest = 0.0
    needs: Literal["front", "upright"] | None = None


class Motions(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What gets it up, by how it lies.

    From the `front` into a squat on both soles; over its `left` or `right` side onto the front.
    From the back it goes over the side that is lower.
    """

    front: q.Several[Keyframe]
    left: q.Several[Keyframe]
    right: q.Several[Keyframe]


class GettingUp(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How the robot gets up from the floor, see robot/control/getting_up.py.

    Attributes:
        tries: most motions.
        motions: by how it lies.
        speed: part of a joint's fastest speed that a keyframe may ask for.
        lying: cosine to the vertical from which a side of the trunk counts as up.
        upright: the same of a trunk that a keyframe needs upright.
        still_rad_s, rest_s: joints and trunk slower than this for so long lie still, and
        rest_limit_s: longer than that nobody waits for it.
    """

    tries: q.Tries
    motions: Motions
    speed: q.Share
    lying: q.Share
    upright: q.Share
    still_rad_s: q.TurnRate
    rest_s: q.Duration
    rest_limit_s: q.Duration
