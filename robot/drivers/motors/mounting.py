"""How a motor of any family sits at its joint, and what the joint may do: a map's part of each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple, Protocol

import msgspec

from robot.errors import Problem
from robot.files import config
from robot.files import quantities as q

SLACK_RAD = 0.05
"""So far behind its limit a joint may stand: its end stop is softer than its limit."""


class Mounted(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A motor at a joint: q_joint = sign * q_motor / gear + offset_rad.

    Attributes:
        sign: -1 where the joint turns the other way.
        offset_rad: the joint's angle where the motor says 0.
        gear: turns of the motor's output for one of the joint (a belt behind it).
        lower_rad, upper_rad: the joint is sent nowhere else.
        velocity_limit_rad_s, torque_limit_nm: of the joint.
        over_temperature_c: it is derated above, and let go where its own limit is.
    """

    sign: Literal[1, -1] = 1
    offset_rad: q.Joint = 0.0
    gear: q.Ratio = 1.0
    lower_rad: q.Joint
    upper_rad: q.Joint
    velocity_limit_rad_s: q.TurnRate
    torque_limit_nm: q.Torque
    over_temperature_c: q.Heat = 80.0

    @property
    def kp_most(self) -> float:
        """The stiffest that it can be made, at the joint: N m/rad."""
        raise NotImplementedError

    @property
    def kd_most(self) -> float:
        """The most that it can be damped, at the joint: N m s/rad."""
        raise NotImplementedError

    def motor_rad(self, joint_rad: float) -> float:
        """The motor's angle at one of the joint's."""
        return self.sign * self.gear * (joint_rad - self.offset_rad)

    def joint_rad(self, motor_rad: float) -> float:
        """The joint's angle at one of the motor's."""
        return self.sign * motor_rad / self.gear + self.offset_rad


class MountedJoints(Protocol):
    """A joint map, of whatever family, as far as limits and gears go."""

    @property
    def joints(self) -> Mapping[str, Mounted]:
        """By name, in the order of every array."""
        ...

    @property
    def period_s(self) -> float:
        """Between two commands."""
        ...


class Misplaced(NamedTuple):
    """A joint that stands where it cannot be: code, what is so, what a person does about it."""

    code: str
    text: str
    cure: str


def misplaced(joint: Mounted, q_rad: float) -> Misplaced | None:
    """What is likely wrong with sign or offset of a joint that stands there; None: nothing."""
    if joint.lower_rad - SLACK_RAD <= q_rad <= joint.upper_rad + SLACK_RAD:
        return None
    text = f"it stands at {q_rad:.2f} rad, outside {joint.lower_rad:g} to {joint.upper_rad:g}"
    mirrored = 2.0 * joint.offset_rad - q_rad
    if joint.lower_rad <= mirrored <= joint.upper_rad:
        cure = f"is its sign {-joint.sign}? then it stands at {mirrored:.2f} rad"
        return Misplaced("sign", text, cure)
    return Misplaced("offset", text, "measure offset_rad, or bring the joint between its stops")


def unlike(found: Sequence[str], motors: Sequence[str], file: str) -> list[Problem]:
    """What a map lacks of a robot's motors, and which joints it has that the robot has not."""
    lacking = [
        Problem(f"no motor moves the joint {name!r}", file, suggestion="add it to joints")
        for name in motors
        if name not in found
    ]
    return lacking + [
        Problem(f"the robot has no motor {name!r}", file, suggestion=config.nearest(name, motors))
        for name in found
        if name not in motors
    ]


def beyond(
    where: str, joint: Mounted, model: str, *, speed_rad_s: float, torque_nm: float
) -> Iterator[tuple[str, str, str]]:
    """Limits of a joint that its motor cannot meet: place in the file, what is so, the cure.

    Args:
        where: the joint's place in the file.
        joint: of the map.
        model: the motor's, for people.
        speed_rad_s: the fastest that the motor turns.
        torque_nm: the most that it gives.
    """
    speed, torque = speed_rad_s / joint.gear, torque_nm * joint.gear
    if joint.velocity_limit_rad_s > speed * 1.0001:
        text = f"a {model} at gear {joint.gear:g} gives {speed:.3g} rad/s at most"
        yield f"{where}.velocity_limit_rad_s", text, f"{speed:.3g} or less"
    if joint.torque_limit_nm > torque * 1.0001:
        text = f"a {model} at gear {joint.gear:g} gives {torque:.3g} N m at most"
        yield f"{where}.torque_limit_nm", text, f"{torque:.3g} or less"
