"""Where the robot's links are to one another: the joints of its URDF, as others read them too.

What `robot_state_publisher` does where there is ROS: a joint's origin, then its turn or its travel.
The same text goes out as /robot_description, so the two cannot disagree.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree import ElementTree as ET

from robot.se3 import SE3, Vector3

BASE = "base_link"
"""As ROS calls a mobile robot's own frame (REP-105); the URDF's first link lies in it as it is."""


class Joint(NamedTuple):
    """A joint of a URDF: where it sits in its parent, and what moves it.

    `leader` is the joint whose position counts, `gain` and `offset` are what is made of it (a
    finger that follows another one); `slides` [m], or else turns [rad].
    """

    parent: str
    child: str
    X_ParentJoint: SE3
    axis: Vector3
    slides: bool
    leader: str
    gain: float
    offset: float

    def pose(self, positions: Mapping[str, float]) -> SE3:
        """X_ParentChild where the joints are at these positions; one that is missing is at 0."""
        q = self.offset + self.gain * positions.get(self.leader, 0.0)
        x, y, z = self.axis
        if self.slides:
            return self.X_ParentJoint @ SE3((x * q, y * q, z * q))
        sine = math.sin(0.5 * q)
        return self.X_ParentJoint @ SE3(quat_wxyz=(math.cos(0.5 * q), x * sine, y * sine, z * sine))


class LinkFrames:
    """The links of one robot.

    Attributes:
        still: (parent, child, X_ParentChild) of what never moves, `BASE` to the first link first.
        moving: the joints, in the order of the file.
    """

    def __init__(self, urdf: str) -> None:
        """Read the text that `robot.model.urdf` has written."""
        root = ET.fromstring(urdf)
        first = root.find("link")
        name = first.get("name", "") if first is not None else ""
        self.still: list[tuple[str, str, SE3]] = [(BASE, name, SE3())] if name != BASE else []
        self.moving: list[Joint] = []
        for element in root.iter("joint"):
            joint = _joint(element)
            if element.get("type") == "fixed":
                self.still.append((joint.parent, joint.child, joint.X_ParentJoint))
            else:
                self.moving.append(joint)


def _joint(element: ET.Element) -> Joint:
    origin, mimic = element.find("origin"), element.find("mimic")
    roll, pitch, yaw = _vector(origin.get("rpy") if origin is not None else None)
    at_m = _vector(origin.get("xyz") if origin is not None else None)
    axis = element.find("axis")
    follows = mimic is not None
    return Joint(
        parent=_link(element, "parent"),
        child=_link(element, "child"),
        X_ParentJoint=SE3.from_rpy(roll, pitch, yaw, at_m),
        axis=_vector(axis.get("xyz") if axis is not None else "1 0 0"),
        slides=element.get("type") == "prismatic",
        leader=mimic.get("joint", "") if follows else element.get("name", ""),
        gain=float(mimic.get("multiplier", "1")) if follows else 1.0,
        offset=float(mimic.get("offset", "0")) if follows else 0.0,
    )


def _link(element: ET.Element, tag: str) -> str:
    found = element.find(tag)
    return found.get("link", "") if found is not None else ""


def _vector(text: str | None) -> Vector3:
    x, y, z = (float(one) for one in (text or "0 0 0").split())
    return x, y, z
