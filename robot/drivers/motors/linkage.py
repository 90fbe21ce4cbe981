"""Motors that move joints together: two rods at an ankle, belts that pass a joint.

A linkage of k joints has k motors. `at` says where their outputs, the cranks, stand at angles of
the joints, and how fast they turn for the joints' speeds:

    crank = f(q)    d crank/dt = J(q) dq/dt    tau_q = J(q)^T tau_crank
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import product
from typing import Annotated, NamedTuple, TypeAlias, TypeVar

import msgspec
import numpy as np

from robot.drivers.motors.mounting import Mounted
from robot.files import quantities as q
from robot.se3 import Array

Point: TypeAlias = tuple[q.Offset, q.Offset, q.Offset]
Entry: TypeAlias = Annotated[float, msgspec.Meta(ge=-100.0, le=100.0)]
Bend: TypeAlias = Annotated[int, msgspec.Meta(ge=-1, le=1)]

SOLVED_RAD, MOST_STEPS, MOST_STEP_RAD = 1e-10, 20, 0.3
"""Of Newton's method, from where joints were: two steps are enough from one period to the next.
From farther away its first steps would lead to where no rod reaches."""
NEXT_TO_NOTHING_M = 1e-6
LEAST_DETERMINANT = 0.05
"""Of J, over its entries' size: nearer to 0 a torque of the joints asks for any of the motors."""
LOOKS = 9
"""Angles of each joint's range at which it is looked whether a linkage reaches them."""


class Rod(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From a motor's crank to the foot. Points in m from where both joints' axes meet.

    Attributes:
        motor_at_m: middle of the crank, which turns about y, in axes of the shank (x forward,
            z up).
        crank_m: its length.
        rod_m: the rod's length, between its ball joints.
        foot_at_m: where it ends, in axes of the foot, which are those of the shank at 0.
        bend: of the two ways that crank and rod fit, 1 or -1: the crank stands on the side of
            greater (1) or smaller (-1) angles about y of the line from its middle to the foot's.
    """

    motor_at_m: Point
    crank_m: q.Length
    rod_m: q.Length
    foot_at_m: Point
    bend: Bend = 1

    def crank(self, pitch: float, roll: float) -> tuple[float, float, float]:
        """Its angle about y, from x; and what that gains by pitch and by roll.

        Raises:
            ValueError: the rod does not reach the foot there.
        """
        cp, sp, cr, sr = math.cos(pitch), math.sin(pitch), math.cos(roll), math.sin(roll)
        x, fy, fz = self.foot_at_m
        y, z = fy * cr - fz * sr, fy * sr + fz * cr  # turned by roll about x, then pitch about y
        mx, my, mz = self.motor_at_m
        dx, dy, dz = cp * x + sp * z - mx, y - my, cp * z - sp * x - mz
        reach = math.hypot(dx, dz)
        length = self.crank_m
        if reach < NEXT_TO_NOTHING_M:
            raise ValueError("the crank turns about the rod's end")
        share = (length**2 + dx**2 + dy**2 + dz**2 - self.rod_m**2) / (2.0 * length * reach)
        if not abs(share) < 1.0:
            raise ValueError("the rod does not reach")
        angle = math.atan2(-dz, dx) + self.bend * math.acos(share)
        ca, sa = math.cos(angle), math.sin(angle)
        ex, ez = length * ca - dx, -length * sa - dz  # along the rod; its y is -dy
        turned = -length * (ex * sa + ez * ca)
        if abs(turned) < NEXT_TO_NOTHING_M**2:
            raise ValueError("crank and rod are in line")
        by_pitch = ex * (cp * z - sp * x) - ez * (cp * x + sp * z)
        by_roll = ex * sp * y + dy * z + ez * cp * y
        return angle, by_pitch / turned, by_roll / turned


class Rods(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag="rods"):
    """An ankle of two rods. A crank stands at 0 where both joints do.

    Attributes:
        joints: pitch about y, and roll about x of what pitch turned.
        rods: of the motors that the map names at these joints, in their order.
    """

    joints: tuple[str, str]
    rods: tuple[Rod, Rod]

    def at(self, angles: Array) -> tuple[Array, Array]:
        """Where cranks stand, shape (2,), and J, shape (2, 2).

        Raises:
            ValueError: a rod does not reach there.
        """
        pitch, roll = angles.tolist()
        (a, a_pitch, a_roll), (b, b_pitch, b_roll) = (one.crank(pitch, roll) for one in self.rods)
        zero_a, zero_b = map(_zero, self.rods)
        turned = (math.remainder(one, 2.0 * math.pi) for one in (a - zero_a, b - zero_b))
        return np.array([*turned]), np.array([[a_pitch, a_roll], [b_pitch, b_roll]])


@lru_cache
def _zero(rod: Rod) -> float:
    return rod.crank(0.0, 0.0)[0]


class Belts(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag="belts"):
    """Motors whose turns are sums of their joints': a differential, or a belt that passes a joint.

    Attributes:
        joints: names.
        turns: a row for each motor: how much its crank turns for each joint.
    """

    joints: Annotated[tuple[str, ...], msgspec.Meta(min_length=2, max_length=6)]
    turns: tuple[tuple[Entry, ...], ...]

    def at(self, angles: Array) -> tuple[Array, Array]:
        """Where cranks stand, shape (k,), and J, shape (k, k): the same everywhere."""
        jacobian = np.array(self.turns)
        return jacobian @ angles, jacobian


Linkage: TypeAlias = Rods | Belts


class Solved(NamedTuple):
    """Angles of a linkage's joints, where its cranks stand there, and J."""

    angles: Array
    cranks: Array
    jacobian: Array


def solved(linkage: Linkage, cranks: Array, begin: Array) -> Solved | None:
    """Angles of the joints at which cranks stand; None: there are none near `begin`.

    Args:
        linkage: of them.
        cranks: angles, shape (k,).
        begin: angles of the joints that are near, shape (k,).
    """
    angles = begin
    try:
        for _ in range(MOST_STEPS):
            stand, jacobian = linkage.at(angles)
            error = cranks - stand
            if not np.isfinite(error).all():
                return None
            if np.abs(error).max() < SOLVED_RAD:
                return Solved(angles, stand, jacobian)
            step = np.linalg.solve(jacobian, error)
            angles = angles + step * min(1.0, MOST_STEP_RAD / float(np.abs(step).max()))
    except (ValueError, np.linalg.LinAlgError):
        return None
    return None


def determinant(jacobian: Array) -> float:
    """Of J, over what it is at most for rows as long as its: 1 where motors share nothing."""
    sizes = math.prod(math.hypot(*row) for row in jacobian.tolist())
    return abs(float(np.linalg.det(jacobian))) / sizes if sizes > 0.0 else 0.0


def wrong(
    linkages: Mapping[str, Linkage], joints: Mapping[str, Mounted]
) -> Iterator[tuple[str, str, str]]:
    """What cannot be meant of them: place in the file, what is wrong there, the cure."""
    taken: dict[str, str] = {}
    for name, linkage in linkages.items():
        where = f"$.linkages.{name}"
        if unknown := [one for one in linkage.joints if one not in joints]:
            text = f"there is no joint {unknown[0]!r}"
            yield f"{where}.joints", text, "name joints of this map"
            continue
        for one in linkage.joints:
            if one in taken:
                text = f"{one} is in the linkage {taken[one]!r} already"
                yield f"{where}.joints", text, "a joint is in one linkage, once"
            taken[one] = name
        if isinstance(linkage, Belts) and {len(linkage.joints)} != {
            len(linkage.turns), *map(len, linkage.turns),
        }:  # fmt: skip
            text = "it has as many motors as joints, and each a figure for each of them"
            yield f"{where}.turns", text, f"write {len(linkage.joints)} rows of as many figures"
        elif why := _unreached(linkage, joints):
            yield where, why, "narrow the joints' limits, or measure the linkage again"


def _unreached(linkage: Linkage, joints: Mapping[str, Mounted]) -> str:
    """Where in the joints' range it ends or locks; "" if nowhere."""
    for angles in _looks(linkage, joints):
        said = ", ".join(f"{angle:.2f}" for angle in angles)
        try:
            if determinant(linkage.at(angles)[1]) < LEAST_DETERMINANT:
                return f"at {said} rad its motors can hardly move its joints apart"
        except ValueError:
            return f"at {said} rad a rod does not reach"
    return ""


def _looks(linkage: Linkage, joints: Mapping[str, Mounted]) -> Iterator[Array]:
    """Angles of its joints all over their ranges; of more than three joints at the ends."""
    ranges = [
        np.linspace(joints[name].lower_rad, joints[name].upper_rad, LOOKS)
        for name in linkage.joints
    ]
    few = ranges if len(ranges) <= 3 else [one[[0, -1]] for one in ranges]
    return (np.array(angles) for angles in product(*few))


class Needed(NamedTuple):
    """What a motor has to do at its joint, or at its crank."""

    torque_nm: float
    velocity_rad_s: float


def needed(linkages: Mapping[str, Linkage], joints: Mapping[str, Mounted]) -> dict[str, Needed]:
    """Of every joint's motor; linkages of which a joint is not among these are left out."""
    found = {
        name: Needed(one.torque_limit_nm, one.velocity_limit_rad_s) for name, one in joints.items()
    }
    for linkage in linkages.values():
        if all(name in joints for name in linkage.joints):
            torques, speeds = _needs(linkage, joints)
            for name, torque, speed in zip(linkage.joints, torques, speeds, strict=True):
                found[name] = Needed(float(torque), float(speed))
    return found


M = TypeVar("M", bound=Mounted)


def at_cranks(linkages: Mapping[str, Linkage], joints: Mapping[str, M]) -> dict[str, M]:
    """Every joint as its motor has it: of one in a linkage range, torque and speed of its crank.

    Linkages of which a joint is not among these are left out.
    """
    found = {
        name: msgspec.structs.replace(
            joints[name], torque_limit_nm=most.torque_nm, velocity_limit_rad_s=most.velocity_rad_s
        )
        for name, most in needed(linkages, joints).items()
    }
    for linkage in linkages.values():
        if not all(name in joints for name in linkage.joints):
            continue
        stand = np.array([linkage.at(angles)[0] for angles in _looks(linkage, joints)])
        for name, low, high in zip(linkage.joints, stand.min(0), stand.max(0), strict=True):
            found[name] = msgspec.structs.replace(
                found[name], lower_rad=float(low), upper_rad=float(high)
            )
    return found


def middle(linkages: Mapping[str, Linkage], joints: Mapping[str, Mounted]) -> dict[str, float]:
    """Where joints, or the cranks of their linkages, stand in the middle of the joints' ranges."""
    at = {name: 0.5 * (one.lower_rad + one.upper_rad) for name, one in joints.items()}
    for linkage in linkages.values():
        if all(name in at for name in linkage.joints):
            cranks, _ = linkage.at(np.array([at[name] for name in linkage.joints]))
            at |= dict(zip(linkage.joints, cranks.tolist(), strict=True))
    return at


def _needs(linkage: Linkage, joints: Mapping[str, Mounted]) -> tuple[Array, Array]:
    """The torque and the speed that each crank has to give, shape (k,) each.

    Of one joint alone at its limit, at the worst angles of their range: both at theirs is more than
    most ankles are made for, and is scaled down as it is told.
    """
    few = [
        np.linspace(joints[name].lower_rad, joints[name].upper_rad, 3) for name in linkage.joints
    ]
    torque = np.array([joints[name].torque_limit_nm for name in linkage.joints])
    speed = np.array([joints[name].velocity_limit_rad_s for name in linkage.joints])
    most_nm = most_rad_s = np.zeros(len(linkage.joints))
    for angles in product(*few):
        _, jacobian = linkage.at(np.array(angles))
        by_joint = np.abs(np.linalg.inv(jacobian).T) * torque
        most_nm = np.maximum(most_nm, by_joint.max(axis=1))
        most_rad_s = np.maximum(most_rad_s, (np.abs(jacobian) * speed).max(axis=1))
    return most_nm, most_rad_s
