"""Waypoints of Nav2 to a mission that walks along them.

Two forms are read: what the RViz panel of Nav2 saves, and a list of poses as ROS prints them::

    waypoints:                                    poses:
      waypoint0:                                    - pose:
        pose: [x, y, z]                                 position: {x: 1.0, y: 0.0, z: 0.0}
        orientation: [w, x, y, z]                       orientation: {x: 0, y: 0, z: 0, w: 1}

Positions are in the map, so a header has to say `frame_id: map`, or nothing; of the orientation the
heading is kept.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from executive.missions.problems import Enough, Problems
from robot.files.yaml_nodes import Node, dump, read
from robot.se3 import SE3

UPRIGHT_RAD = math.radians(5.0)
"""More than that a waypoint may not lean: nobody walks on a wall."""

MAPS = ("map", "/map", "")
"""Frames that are the world's own. Others (odom, base_link) lie somewhere in it, by transforms that
only the robot knows that wrote them."""
FLOOR_M = 0.3
"""A waypoint that far from the floor is not on it."""


MOST_POINTS = 1000
"""Of a way; a mission of ten times as many takes seconds to read."""
FAR_M = 1e3
"""No goal is farther from the middle of the map (`intents.allowed`)."""


def mission_of(path: Path) -> str:
    """The text of a mission that walks along the waypoints of a file.

    Raises:
        ConfigError: with everything that is wrong in it, by line.
    """
    root = read(path)
    problems = Problems()
    try:
        steps = _steps(root, problems)
    except Enough:
        steps = []
    problems.raise_any()
    return dump({"name": path.stem.replace("_", " "), "steps": steps})


def _steps(root: Node, problems: Problems) -> list[dict[str, Any]]:
    _check_frame(root, problems)
    if root.get("waypoints") is not None and root.get("poses") is not None:
        problems.add(root.key("poses"), "waypoints and poses: one list is read", "take one out")
    points = _points(root)
    if len(points) > MOST_POINTS:
        problems.add(points[MOST_POINTS][1], f"more than {MOST_POINTS} waypoints", "split the file")
        raise Enough
    steps = [step for step in (_step(node, problems) for node in points) if step]
    if not steps and len(problems) == 0:
        problems.add(root, "there are no waypoints in it", "waypoints: or poses:")
    return steps


def _points(root: Node) -> list[tuple[str, Node]]:
    """The waypoints in their order, each with its name."""
    for key in ("waypoints", "poses"):
        node = root.get(key)
        if node is not None and node.kind == "map":
            return [(name, value) for name, (_, value) in node.entries.items()]
        if node is not None:
            return [(f"waypoint {n + 1}", item) for n, item in enumerate(node.items)]
    return [(f"waypoint {n + 1}", item) for n, item in enumerate(root.items)]


def _step(point: tuple[str, Node], problems: Problems) -> dict[str, Any] | None:
    name, node = point
    _check_frame(node, problems)
    pose = node.get("pose")
    if pose is not None and pose.kind == "map":  # PoseStamped
        position, orientation = pose.get("position"), pose.get("orientation")
    else:
        position = pose or node.get("position")
        orientation = node.get("orientation")
    p_W = _numbers(position, "xyz", problems) if position else None
    quat_wxyz = _numbers(orientation, "wxyz", problems) if orientation else [1.0, 0.0, 0.0, 0.0]
    if position is None:
        problems.add(node, f"{name} has no position", "pose: [x, y, z]")
    if p_W is None or quat_wxyz is None:
        return None
    norm = math.sqrt(sum(value * value for value in quat_wxyz))
    if not 0.99 < norm < 1.01:
        problems.add(orientation or node, f"the quaternion has length {norm:.3g}, not 1")
        return None
    if abs(p_W[2]) > FLOOR_M:
        text = f"{name} lies {p_W[2]:g} m from the floor"
        problems.add(position or node, text, "a robot stands on the floor: z: 0")
    if max(abs(p_W[0]), abs(p_W[1])) > FAR_M:
        problems.add(position or node, f"{name} is more than {FAR_M:g} m away", "in metres: x, y")
        return None
    w, x, y, z = (value / norm for value in quat_wxyz)
    lean_rad = math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))
    if lean_rad > UPRIGHT_RAD:
        text = f"{name} leans by {math.degrees(lean_rad):.0f} degrees"
        problems.add(orientation or node, text, "a robot stands upright")
        return None
    yaw_rad = SE3((0.0, 0.0, 0.0), (w, x, y, z)).yaw_rad
    target = {"x_m": p_W[0], "y_m": p_W[1], "yaw_rad": round(yaw_rad, 6)}
    return {"go_to": {"pose": target}, "name": name}


def _check_frame(node: Node, problems: Problems) -> None:
    """Note a frame that is not the map's, at a waypoint or above all of them."""
    header = node.get("header")
    for place in (node.get("frame_id"), header.get("frame_id") if header is not None else None):
        if place is not None and place.text not in MAPS:
            text = (
                f"poses in the frame {place.text!r}: where that lies in the map nobody here knows"
            )
            problems.add(place, text, "transform them into the frame map")


def _numbers(node: Node, keys: str, problems: Problems) -> list[float] | None:
    """Numbers out of a list, or out of a mapping by their names."""
    if node.kind == "map":
        parts = [node.get(key) for key in keys]
    else:
        parts = [*node.items] if len(node.items) == len(keys) else [None]
    found: list[float] = []
    for part in parts:
        value = part.value if part is not None and part.kind == "text" else None
        if not isinstance(value, int | float) or isinstance(value, bool):
            text = f"{len(keys)} numbers should stand here: {', '.join(keys)}"
            problems.add(part or node, text)
            return None
        found.append(float(value))
    return found
