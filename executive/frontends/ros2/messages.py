"""What the robot's own messages are in those of ROS 2: plain dictionaries by interface.

Frames are those of REP-105: `map` is W, `odom` is N, `base_link` is B; links and `SITE_frame` are
as in the URDF. A camera's picture is in the site of the camera, which is optical already.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from executive.frontends.ros2.link_frames import BASE, LinkFrames
from executive.frontends.ros2.stamps import time_of
from robot.messages import BodyState, LidarScan, PowerState, RgbdImage, WorldState
from robot.model.description import Lidar, RobotDescription
from robot.planning.requests import Stance
from robot.se3 import SE3, Vector3

MAP, ODOM = "map", "odom"
Ros = dict[str, Any]
DISCHARGING, HEALTH_UNKNOWN, TECHNOLOGY_UNKNOWN = 2, 0, 0
"""sensor_msgs/msg/BatteryState."""
NAN = math.nan
UNKNOWN_COVARIANCE: tuple[float, ...] = (0.0,) * 36
"""Zero says in ROS that it is not known."""


def header(wall_s: float, frame: str) -> Ros:
    """std_msgs/msg/Header."""
    return {"stamp": time_of(wall_s), "frame_id": frame}


def joint_states(body: BodyState, joints: Sequence[str], wall_s: float) -> Ros:
    """sensor_msgs/msg/JointState, by the joints' names in the URDF."""
    return {
        "header": header(wall_s, ""),
        "name": joints,
        "position": body.q_rad,
        "velocity": body.qd_rad_s,
        "effort": body.tau_nm,
    }


def positions(body: BodyState, joints: Sequence[str]) -> dict[str, float]:
    """The position of every joint that a motor moves [rad, m]."""
    return dict(zip(joints, body.q_rad, strict=False))


def odometry(body: BodyState, wall_s: float) -> Ros:
    """nav_msgs/msg/Odometry: the pose in `odom`, the velocity in the base's own axes."""
    R_BN = body.X_NB.rotation().T
    linear = R_BN @ body.v_NB
    angular = R_BN @ body.w_NB
    return {
        "header": header(wall_s, ODOM),
        "child_frame_id": BASE,
        "pose": {"pose": _pose(body.X_NB), "covariance": UNKNOWN_COVARIANCE},
        "twist": {
            "twist": {"linear": _vector(linear), "angular": _vector(angular)},
            "covariance": UNKNOWN_COVARIANCE,
        },
    }


def transforms(
    body: BodyState, world: WorldState | None, links: LinkFrames, *, joints: Sequence[str],
    wall_s: float,
) -> Ros:  # fmt: skip
    """tf2_msgs/msg/TFMessage of all that moves: map, odom, base, every link that has a joint."""
    at = positions(body, joints)
    found = [_transform(ODOM, BASE, body.X_NB, wall_s)]
    if world is not None:
        found.append(_transform(MAP, ODOM, world.X_WN, wall_s))
    found += [_transform(one.parent, one.child, one.pose(at), wall_s) for one in links.moving]
    return {"transforms": found}


def still_transforms(links: LinkFrames, wall_s: float) -> Ros:
    """tf2_msgs/msg/TFMessage of what never moves."""
    return {"transforms": [_transform(*one, wall_s) for one in links.still]}


def path(stances: Sequence[Stance], wall_s: float) -> Ros:
    """nav_msgs/msg/Path over the floor of the map."""
    head = header(wall_s, MAP)
    poses = [{"header": head, "pose": _pose(SE3.from_xy_yaw(*stance))} for stance in stances]
    return {"header": head, "poses": poses}


def scan(lidar: LidarScan, device: Lidar, *, rate_hz: float, wall_s: float) -> Ros:
    """sensor_msgs/msg/LaserScan; what hits nothing is infinite (REP-117)."""
    last = max(0, len(lidar.ranges_m) - 1)
    return {
        "header": header(wall_s, frame_of(device.site)),
        "angle_min": lidar.angle_min_rad,
        "angle_max": lidar.angle_min_rad + last * lidar.angle_step_rad,
        "angle_increment": lidar.angle_step_rad,
        "scan_time": 1.0 / rate_hz,
        "range_min": 0.0,
        "range_max": device.range_m,
        "ranges": lidar.ranges_m,
    }


def battery(power: PowerState, wall_s: float) -> Ros:
    """sensor_msgs/msg/BatteryState; what is not measured is NaN."""
    unknown = dict.fromkeys(
        ("voltage", "temperature", "current", "charge", "capacity", "design_capacity"), NAN
    )
    return {
        "header": header(wall_s, ""),
        **unknown,
        "percentage": power.charge,
        "power_supply_status": DISCHARGING,
        "power_supply_health": HEALTH_UNKNOWN,
        "power_supply_technology": TECHNOLOGY_UNKNOWN,
        "present": True,
    }


def picture(image: RgbdImage, wall_s: float) -> Ros:
    """sensor_msgs/msg/Image of the colours."""
    return _image(image, wall_s, encoding="rgb8", step=3 * image.width, data=image.colours)


def depth_picture(image: RgbdImage, wall_s: float) -> Ros:
    """sensor_msgs/msg/Image of the depth [m]; 0: nothing was measured."""
    return _image(image, wall_s, encoding="32FC1", step=4 * image.width, data=image.depth_m)


def camera_info(image: RgbdImage, wall_s: float) -> Ros:
    """sensor_msgs/msg/CameraInfo: a pinhole without distortion."""
    (fx, fy), (cx, cy) = image.focal_px, image.centre_px
    return {
        "header": header(wall_s, frame_of(image.frame)),
        "height": image.height,
        "width": image.width,
        "distortion_model": "plumb_bob",
        "d": (0.0,) * 5,
        "k": (fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0),
        "r": (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        "p": (fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0),
    }


def diagnostics(rows: Sequence[tuple[int, str, str, Mapping[str, str]]], wall_s: float) -> Ros:
    """diagnostic_msgs/msg/DiagnosticArray of rows: level (0 ok, 1 warning, 2 error), name, text."""
    return {
        "header": header(wall_s, ""),
        "status": [
            {
                "level": level,
                "name": f"humanoid: {name}",
                "message": text,
                "hardware_id": "humanoid",
                "values": [{"key": key, "value": value} for key, value in values.items()],
            }
            for level, name, text, values in rows
        ],
    }


def joint_names(robot: RobotDescription) -> tuple[str, ...]:
    """The joints' names in the URDF, in the motors' order."""
    return tuple(robot.motors[name].joint for name in robot.motor_names)


def frame_of(site: str) -> str:
    """What a site is called in the URDF."""
    return f"{site}_frame"


def _image(image: RgbdImage, wall_s: float, *, encoding: str, step: int, data: bytes) -> Ros:
    return {
        "header": header(wall_s, frame_of(image.frame)),
        "height": image.height,
        "width": image.width,
        "encoding": encoding,
        "step": step,
        "data": data,
    }


def _transform(parent: str, child: str, X_PC: SE3, wall_s: float) -> Ros:
    return {
        "header": header(wall_s, parent),
        "child_frame_id": child,
        "transform": {"translation": _vector(X_PC.p), "rotation": _rotation(X_PC)},
    }


def _pose(X: SE3) -> Ros:
    return {"position": _vector(X.p), "orientation": _rotation(X)}


def _vector(values: Vector3 | Any) -> Ros:
    x, y, z = values
    return {"x": float(x), "y": float(y), "z": float(z)}


def _rotation(X: SE3) -> Ros:
    w, x, y, z = X.quat_wxyz
    return {"x": x, "y": y, "z": z, "w": w}
