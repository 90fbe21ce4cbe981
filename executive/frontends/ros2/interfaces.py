"""The ROS 2 messages and services that are spoken here, as data: what is in each, in order.

Written from the public interface definitions (common_interfaces, geometry2, rcl_interfaces) of
ROS 2 Jazzy. Constants and defaults are left out: they are no part of what travels.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple


def service(
    name: str, *, request: Sequence[str], response: Sequence[str]
) -> dict[str, Sequence[str]]:
    """A service's own type and those of its messages, as rosidl makes them of a .srv file.

    The event is never sent here; the hash of the service is also of it.
    """
    return {
        f"{name}_Request": request,
        f"{name}_Response": response,
        f"{name}_Event": (
            "service_msgs/msg/ServiceEventInfo info",
            f"{name}_Request[<=1] request",
            f"{name}_Response[<=1] response",
        ),
        name: (
            f"{name}_Request request_message",
            f"{name}_Response response_message",
            f"{name}_Event event_message",
        ),
    }


INTERFACES: dict[str, Sequence[str]] = {
    "builtin_interfaces/msg/Time": ("int32 sec", "uint32 nanosec"),
    "std_msgs/msg/Empty": (),
    "std_msgs/msg/String": ("string data",),
    "std_msgs/msg/Header": ("builtin_interfaces/msg/Time stamp", "string frame_id"),
    "geometry_msgs/msg/Vector3": ("float64 x", "float64 y", "float64 z"),
    "geometry_msgs/msg/Point": ("float64 x", "float64 y", "float64 z"),
    "geometry_msgs/msg/Quaternion": ("float64 x", "float64 y", "float64 z", "float64 w"),
    "geometry_msgs/msg/Pose": (
        "geometry_msgs/msg/Point position",
        "geometry_msgs/msg/Quaternion orientation",
    ),
    "geometry_msgs/msg/PoseWithCovariance": (
        "geometry_msgs/msg/Pose pose",
        "float64[36] covariance",
    ),
    "geometry_msgs/msg/Twist": (
        "geometry_msgs/msg/Vector3 linear",
        "geometry_msgs/msg/Vector3 angular",
    ),
    "geometry_msgs/msg/TwistWithCovariance": (
        "geometry_msgs/msg/Twist twist",
        "float64[36] covariance",
    ),
    "geometry_msgs/msg/Transform": (
        "geometry_msgs/msg/Vector3 translation",
        "geometry_msgs/msg/Quaternion rotation",
    ),
    "geometry_msgs/msg/TransformStamped": (
        "std_msgs/msg/Header header",
        "string child_frame_id",
        "geometry_msgs/msg/Transform transform",
    ),
    "tf2_msgs/msg/TFMessage": ("geometry_msgs/msg/TransformStamped[] transforms",),
    "geometry_msgs/msg/PoseStamped": (
        "std_msgs/msg/Header header",
        "geometry_msgs/msg/Pose pose",
    ),
    "nav_msgs/msg/Path": (
        "std_msgs/msg/Header header",
        "geometry_msgs/msg/PoseStamped[] poses",
    ),
    "nav_msgs/msg/Odometry": (
        "std_msgs/msg/Header header",
        "string child_frame_id",
        "geometry_msgs/msg/PoseWithCovariance pose",
        "geometry_msgs/msg/TwistWithCovariance twist",
    ),
    "sensor_msgs/msg/JointState": (
        "std_msgs/msg/Header header",
        "string[] name",
        "float64[] position",
        "float64[] velocity",
        "float64[] effort",
    ),
    "sensor_msgs/msg/LaserScan": (
        "std_msgs/msg/Header header",
        "float32 angle_min",
        "float32 angle_max",
        "float32 angle_increment",
        "float32 time_increment",
        "float32 scan_time",
        "float32 range_min",
        "float32 range_max",
        "float32[] ranges",
        "float32[] intensities",
    ),
    "sensor_msgs/msg/BatteryState": (
        "std_msgs/msg/Header header",
        "float32 voltage",
        "float32 temperature",
        "float32 current",
        "float32 charge",
        "float32 capacity",
        "float32 design_capacity",
        "float32 percentage",
        "uint8 power_supply_status",
        "uint8 power_supply_health",
        "uint8 power_supply_technology",
        "bool present",
        "float32[] cell_voltage",
        "float32[] cell_temperature",
        "string location",
        "string serial_number",
    ),
    "sensor_msgs/msg/Image": (
        "std_msgs/msg/Header header",
        "uint32 height",
        "uint32 width",
        "string encoding",
        "uint8 is_bigendian",
        "uint32 step",
        "uint8[] data",
    ),
    "sensor_msgs/msg/RegionOfInterest": (
        "uint32 x_offset",
        "uint32 y_offset",
        "uint32 height",
        "uint32 width",
        "bool do_rectify",
    ),
    "sensor_msgs/msg/CameraInfo": (
        "std_msgs/msg/Header header",
        "uint32 height",
        "uint32 width",
        "string distortion_model",
        "float64[] d",
        "float64[9] k",
        "float64[9] r",
        "float64[12] p",
        "uint32 binning_x",
        "uint32 binning_y",
        "sensor_msgs/msg/RegionOfInterest roi",
    ),
    "diagnostic_msgs/msg/KeyValue": ("string key", "string value"),
    "diagnostic_msgs/msg/DiagnosticStatus": (
        "byte level",
        "string name",
        "string message",
        "string hardware_id",
        "diagnostic_msgs/msg/KeyValue[] values",
    ),
    "diagnostic_msgs/msg/DiagnosticArray": (
        "std_msgs/msg/Header header",
        "diagnostic_msgs/msg/DiagnosticStatus[] status",
    ),
    "service_msgs/msg/ServiceEventInfo": (
        "uint8 event_type",
        "builtin_interfaces/msg/Time stamp",
        "uint8[16] client_gid",
        "int64 sequence_number",
    ),
    **service(
        "nav_msgs/srv/GetPlan",
        request=(
            "geometry_msgs/msg/PoseStamped start",
            "geometry_msgs/msg/PoseStamped goal",
            "float32 tolerance",
        ),
        response=("nav_msgs/msg/Path plan",),
    ),
}

PRIMITIVES: dict[str, str] = {
    "bool": "?", "byte": "B", "uint8": "B", "int8": "b", "uint16": "H", "int16": "h",
    "uint32": "I", "int32": "i", "uint64": "Q", "int64": "q", "float32": "f", "float64": "d",
}  # fmt: skip
"""Numbers, by the letter that the `struct` module has for each."""

_FIELD = re.compile(r"([\w/]+)(\[(<=)?(\d*)\])? (\w+)")


class Field(NamedTuple):
    """A part of a message: its name, what it is of, how many (None: one; 0: as many as come).

    `most`: of those that come, 0 where that is not bounded.
    """

    name: str
    of: str
    size: int | None
    most: int = 0


DUMMY = Field("structure_needs_at_least_one_member", "uint8", None)
"""What an empty message holds in its place: no structure of IDL is empty."""


@cache
def fields(interface: str) -> tuple[Field, ...]:
    """What is in a message. Raises KeyError for one that is not spoken here."""
    found = tuple(_field(text) for text in INTERFACES[interface])
    return found or (DUMMY,)


def _field(text: str) -> Field:
    match = _FIELD.fullmatch(text)
    assert match is not None, text
    of, brackets, bounded, count, name = match.groups()
    if bounded:
        return Field(name, of, 0, most=int(count))
    return Field(name, of, None if brackets is None else int(count or 0))
