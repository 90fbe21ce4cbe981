"""The robot's topics and services for ROS 2 machines: what goes out, comes in, and is asked."""

from __future__ import annotations

from typing import NamedTuple

from executive.frontends.ros2.naming import Qos

KEPT = Qos(transient_local=True, depth=1)
"""Who comes late is given the newest."""
STREAM = Qos(depth=10)


class Topic(NamedTuple):
    """A topic or service: its name below the namespace, its interface, its quality of service."""

    name: str
    interface: str
    qos: Qos


JOINT_STATES = Topic("joint_states", "sensor_msgs/msg/JointState", STREAM)
TF = Topic("tf", "tf2_msgs/msg/TFMessage", Qos(depth=100))
TF_STATIC = Topic("tf_static", "tf2_msgs/msg/TFMessage", KEPT)
ODOM = Topic("odom", "nav_msgs/msg/Odometry", STREAM)
SCAN = Topic("scan", "sensor_msgs/msg/LaserScan", STREAM)
BATTERY = Topic("battery_state", "sensor_msgs/msg/BatteryState", STREAM)
DIAGNOSTICS = Topic("diagnostics", "diagnostic_msgs/msg/DiagnosticArray", STREAM)
DESCRIPTION = Topic("robot_description", "std_msgs/msg/String", KEPT)
STATUS = Topic("task/status", "std_msgs/msg/String", KEPT)
SAID = Topic("task/said", "std_msgs/msg/String", STREAM)
PICTURE = Topic("camera/image_raw", "sensor_msgs/msg/Image", Qos(depth=2))
DEPTH = Topic("camera/depth/image_raw", "sensor_msgs/msg/Image", Qos(depth=2))
CAMERA_INFO = Topic("camera/camera_info", "sensor_msgs/msg/CameraInfo", STREAM)

ALWAYS = (
    JOINT_STATES, TF, TF_STATIC, ODOM, SCAN, BATTERY, DIAGNOSTICS, DESCRIPTION, STATUS, SAID,
)  # fmt: skip
WITH_PICTURES = (PICTURE, DEPTH, CAMERA_INFO)

GOAL = Topic("task/goal", "std_msgs/msg/String", Qos(depth=8))
STOP = Topic("task/stop", "std_msgs/msg/Empty", Qos(depth=1))
ESTOP = Topic("estop", "std_msgs/msg/Empty", Qos(depth=1))
CMD_VEL = Topic("cmd_vel", "geometry_msgs/msg/Twist", Qos(depth=1))

PLAN = Topic("plan_trajectory", "nav_msgs/srv/GetPlan", STREAM)
"""A service: a way for the robot, which it does not walk. STREAM is the default of services."""
