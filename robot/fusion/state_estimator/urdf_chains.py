"""Where links are from joint angles, read from a URDF: frames only, no shapes, no masses needed.

Meshes, colours and transmissions are not looked at, so that a file that was taken away from its
meshes is as good as a whole one. The format: https://wiki.ros.org/urdf/XML.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_ordinary
from robot.se3 import SE3, Array

MOST_BYTES = 5_000_000
"""Thirty times that of a large humanoid; XML takes some 25 times its size in memory."""
MOST_LINKS, MOST_DEEP = 2000, 60
"""Links, and joints from the root to one: several times those of a humanoid with hands."""
LARGEST = 1e3
"""Of every number [m, rad], factors of mimics too: no robot is larger, and nothing overflows."""
LARGEST_KG = 1e5
MOVING = frozenset({"revolute", "continuous", "prismatic"})
CURE = "give the URDF of the robot that recorded the log"


@dataclass(frozen=True)
class Joint:
    """One joint: the child's frame in the parent's at zero, and how it moves."""

    name: str
    kind: str
    parent: str
    child: str
    rotation: Array
    position: Array
    axis: Array
    follows: tuple[str, float, float] | None
    """Of a mimic: the joint it follows, the factor, the offset."""


@dataclass(frozen=True)
class Chains:
    """The tree of a robot.

    Attributes:
        file: it was read from.
        links: names, in the file's order.
        base: the trunk that everything hangs on: the root, past links without mass that are fixed
            one to the next.
        mass_kg: of all links; 0 where the file has none.
    """

    file: str
    links: tuple[str, ...]
    base: str
    mass_kg: float
    above: Mapping[str, Joint]
    """The joint over each link."""

    def path(self, link: str) -> list[Joint]:
        """The joints from the base to a link, or towards the root where that lies above."""
        joints: list[Joint] = []
        while link != self.base and link in self.above:
            joints.append(self.above[link])
            link = joints[-1].parent
        return joints[::-1] if link == self.base else []

    def moving(self, link: str) -> list[str]:
        """Names of the joints between the base and a link whose readings place it."""
        moving = [joint for joint in self.path(link) if joint.kind in MOVING]
        return [joint.follows[0] if joint.follows else joint.name for joint in moving]

    def poses(self, link: str, readings: Mapping[str, Array]) -> tuple[Array, Array]:
        """A link in the base, for many samples at once.

        Args:
            link: its name.
            readings: joint positions [rad, m] by name, shape (n,) each.

        Returns:
            Rotations, shape (n, 3, 3), and positions [m], shape (n, 3).
        """
        n = len(next(iter(readings.values()))) if readings else 1
        rotations, positions = np.eye(3)[None], np.zeros((1, 3))  # of one, until a joint moves
        for joint in self.path(link):
            positions = positions + rotations @ joint.position
            rotations = rotations @ joint.rotation
            if joint.kind not in MOVING:
                continue
            name, gain, offset = joint.follows or (joint.name, 1.0, 0.0)
            values = gain * readings[name] + offset
            if joint.kind == "prismatic":
                positions = positions + values[:, None] * (rotations @ joint.axis)
            else:
                rotations = rotations @ _turns(joint.axis, values)
        return np.broadcast_to(rotations, (n, 3, 3)), np.broadcast_to(positions, (n, 3))


def load(path: Path) -> Chains:
    """Read a robot's tree.

    Raises:
        ConfigError: the file cannot be read, is no URDF, or its links are no tree.
    """
    try:
        data = read_ordinary(path, limit=MOST_BYTES)
    except OSError as error:
        raise _refused(path, f"it cannot be read: {error.strerror}") from None
    try:
        text = data.decode("utf-8-sig")  # expat would take it for what the file says it is
    except UnicodeDecodeError:
        raise _refused(path, "it is no UTF-8 text") from None
    if "\0" in text:  # UTF-16 of Latin letters is UTF-8 as well, and expat knows it by these
        raise _refused(path, "it is no UTF-8 text")
    if "<!ENTITY" in text or "<!DOCTYPE" in text:
        raise _refused(path, "a URDF has no document type")
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, ValueError, LookupError) as error:
        raise _refused(path, f"it is no XML: {error}") from None
    if root.tag != "robot":
        raise _refused(path, f"it describes no <robot> but <{root.tag}>")
    try:
        joints = [
            _joint(element) for element in root.iter("joint") if element.find("parent") is not None
        ]
        masses = {link.get("name", ""): _mass(link) for link in root.findall("link")}
    except (ValueError, TypeError) as error:
        raise _refused(path, str(error)) from None
    return _tree(path, joints, masses)


def _tree(path: Path, joints: list[Joint], masses: dict[str, float]) -> Chains:
    above = {joint.child: joint for joint in joints}
    if max(len(masses), len(joints)) > MOST_LINKS:
        raise _refused(path, f"it has more than {MOST_LINKS} links")
    if len(above) < len(joints):
        raise _refused(path, "a link hangs on two joints")
    roots = [name for name in masses if name not in above]
    if len(roots) != 1:
        raise _refused(path, f"its links make {len(roots)} trees, not one")
    below: dict[str, list[Joint]] = {}
    for joint in joints:
        below.setdefault(joint.parent, []).append(joint)
    base = roots[0]
    hanging = [base]
    deep = {base: 0}
    for link in hanging:  # grows: each link hangs on one joint, so none comes twice
        hanging += (children := [joint.child for joint in below.get(link, [])])
        deep |= dict.fromkeys(children, deep[link] + 1)
    if max(deep.values()) > MOST_DEEP:
        raise _refused(path, f"a link hangs on more than {MOST_DEEP} joints")
    if apart := sorted(above.keys() - set(hanging)):
        raise _refused(path, f"{apart[0]!r} does not hang on {base!r}: its joints make a ring")
    while masses.get(base, 0.0) == 0.0 and len(below.get(base, [])) == 1:
        if below[base][0].kind != "fixed":
            break
        base = below[base][0].child
    return Chains(str(path), tuple(masses), base, sum(masses.values()), above)


def _joint(element: ET.Element) -> Joint:
    name, kind = element.get("name", ""), element.get("type", "")
    parent, child = element.find("parent"), element.find("child")
    if parent is None or child is None:
        raise ValueError(f"the joint {name!r} has no parent or no child")
    if kind not in {*MOVING, "fixed"}:
        raise ValueError(f"the joint {name!r} is of the kind {kind!r}, which no reading places")
    origin, axis, mimic = element.find("origin"), element.find("axis"), element.find("mimic")
    xyz = _numbers(origin, "xyz", "0 0 0")
    roll, pitch, yaw = _numbers(origin, "rpy", "0 0 0")
    direction = np.array(_numbers(axis, "xyz", "1 0 0"))
    length = float(np.linalg.norm(direction))
    if kind in MOVING and length < 1e-9:
        raise ValueError(f"the joint {name!r} has no axis")
    follows = None
    if mimic is not None:
        (gain,), (offset,) = _numbers(mimic, "multiplier", "1"), _numbers(mimic, "offset", "0")
        follows = (mimic.get("joint", ""), gain, offset)
    rotation = SE3.from_rpy(roll, pitch, yaw, (0.0, 0.0, 0.0)).rotation()
    return Joint(
        name, kind, parent.get("link", ""), child.get("link", ""), rotation, np.array(xyz),
        direction / max(length, 1e-9), follows,
    )  # fmt: skip


def _mass(link: ET.Element) -> float:
    (mass_kg,) = _numbers(link.find("inertial/mass"), "value", "0", largest=LARGEST_KG)
    if mass_kg < 0.0:
        raise ValueError(f"the link {link.get('name', '')!r} has a mass below zero")
    return mass_kg


def _numbers(
    element: ET.Element | None, key: str, otherwise: str, *, largest: float = LARGEST
) -> list[float]:
    """Numbers of an attribute, as many as there are otherwise: finite, and within bounds."""
    text = otherwise if element is None else element.get(key, otherwise)
    count = len(otherwise.split())
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not all(abs(value) <= largest for value in values):  # NaN is not
        what = "a number" if count == 1 else f"{count} numbers"
        raise ValueError(f"{key}={text[:60]!r} must be {what} from -{largest:g} to {largest:g}")
    return values


def _turns(axis: Array, angles: Array) -> Array:
    """Rotation matrices about one axis, shape (n, 3, 3) (Rodrigues)."""
    x, y, z = axis.tolist()
    cross = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    sines, cosines = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + sines * cross + (1.0 - cosines) * (cross @ cross)


def _refused(path: Path, why: str) -> ConfigError:
    return ConfigError([Problem(why, str(path), suggestion=CURE)])
