"""Poses as Nav2 writes them into a port: `stamp;frame;x;y;z;qx;qy;qz;qw`, or several of those."""

from __future__ import annotations

import math

from executive.missions.btcpp.xml import Element
from executive.missions.nav2 import MAPS, UPRIGHT_RAD
from robot.se3 import SE3

FIELDS = 9
FORM = "stamp;map;x;y;z;qx;qy;qz;qw"


def poses_of(element: Element, text: str) -> list[dict[str, float]]:
    """The poses in a port: as `go_to` takes them, and `z_m`. Raises ConfigError for others."""
    parts = [part.strip() for part in text.split(";")]
    if len(parts) % FIELDS:
        raise element.wrong(f"{text[:60]!r} is no pose", FORM)
    return [_pose(element, parts[start : start + FIELDS]) for start in range(0, len(parts), FIELDS)]


def _pose(element: Element, parts: list[str]) -> dict[str, float]:
    frame = parts[1]
    if frame not in MAPS:
        text = f"a pose in the frame {frame!r}: where that lies in the map is known to nobody here"
        raise element.wrong(text, "give it in the frame map")
    try:
        x_m, y_m, z_m, qx, qy, qz, qw = (float(part) for part in parts[2:])
    except ValueError:
        raise element.wrong(f"{';'.join(parts)[:60]!r} is no pose", FORM) from None
    norm = math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    if not 0.99 < norm < 1.01 or not math.isfinite(x_m + y_m + z_m):
        raise element.wrong(f"{';'.join(parts)[:60]!r}: its quaternion has not length 1", FORM)
    lean = 1.0 - 2.0 * (qx * qx + qy * qy) / norm**2
    if math.acos(max(-1.0, min(1.0, lean))) > UPRIGHT_RAD:
        raise element.wrong("the pose leans", "a robot stands upright")
    yaw_rad = SE3((0.0, 0.0, 0.0), (qw / norm, qx / norm, qy / norm, qz / norm)).yaw_rad
    return {"x_m": x_m, "y_m": y_m, "yaw_rad": round(yaw_rad, 6), "z_m": z_m}
