"""Between the robot's own bus and ROS 2 machines: what is new goes out, what comes is handed on.

The robot's processes send to this one as to any other and wait for nobody; only what somebody has
subscribed to is made into messages. Whatever ROS machines do is between them and this process.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import msgspec

from executive.frontends.emergency import emergency
from executive.frontends.ros2 import messages, topics
from executive.frontends.ros2.cdr import CdrError, decode
from executive.frontends.ros2.link_frames import LinkFrames
from executive.frontends.ros2.network import Network, Publisher
from executive.frontends.ros2.orders import Orders
from executive.frontends.ros2.plans import Plans
from executive.frontends.ros2.report import diagnosed, status
from executive.frontends.ros2.stamps import Stamps
from executive.frontends.ros2.topics import Topic
from robot.bus import topics as own
from robot.bus.bus import Bus, Subscription
from robot.model.description import RobotDescription
from robot.model.urdf import urdf
from robot.planning.worker import Planner

RATE_HZ = 50.0
STATUS_S, REPORT_S = 0.2, 1.0
MOST_AT_ONCE = 8
"""Samples of a topic that are taken in a round: a flood holds nothing up."""


class Bridge:
    """One round after another, each as long as what there is to send."""

    def __init__(
        self,
        bus: Bus,
        network: Network,
        orders: Orders,
        robot: RobotDescription,
        *,
        planner: Callable[[], Planner],
        pictures: bool,
    ) -> None:
        """Publish what never changes, and subscribe.

        Args:
            bus: the robot's own.
            network: of the ROS 2 machines.
            orders: where what they want goes.
            robot: that it is about.
            planner: makes one for it, when a way is asked for.
            pictures: whether its camera is looked through.

        Raises:
            DescriptionError: there is no URDF of the robot.
        """
        self.refused = 0
        """How many samples were none of their topic's messages."""
        self._orders = orders
        self._robot = robot
        self._joints = messages.joint_names(robot)
        text = urdf(robot)
        self._links = LinkFrames(text)
        self._stamps = Stamps()
        self._body = _News(bus.subscribe(own.BODY_STATE))
        self._world = bus.subscribe(own.WORLD_STATE)
        self._lidar = _News(bus.subscribe(own.LIDAR))
        self._power = _News(bus.subscribe(own.POWER))
        self._camera = _News(bus.subscribe(own.RGBD)) if pictures else None
        self._timing = bus.subscribe(own.CONTROLLER_TIMING)
        spoken = (*topics.ALWAYS, *(topics.WITH_PICTURES if pictures else ()))
        self._out = {one: network.publisher(one.name, one.interface, one.qos) for one in spoken}
        self._goal, self._twist = (
            network.subscription(one.name, one.interface, one.qos)
            for one in (topics.GOAL, topics.CMD_VEL)
        )
        self._map, self._own_map = bus.subscribe(own.ORACLE_MAP), bus.subscribe(own.WORLD_MAP)
        asked = network.service(topics.PLAN.name, topics.PLAN.interface, topics.PLAN.qos)
        self._plans = Plans(asked, planner, robot)
        self._last_status: dict[str, Any] = {}
        self._status_s = self._report_s = -REPORT_S
        self._publish(topics.DESCRIPTION, {"data": text})
        still = messages.still_transforms(self._links, time.time())
        self._publish(topics.TF_STATIC, still)

    def round(self, now_s: float) -> None:
        """Take what came, send what is new; `now_s` is the wall's, of any origin."""
        self._take_goals()
        self._take_velocity()
        self._plans.round(
            now_s, self._body.latest, self._world.latest, self._own_map.latest or self._map.latest
        )
        self._send_body()
        self._send_sensors()
        if now_s - self._status_s >= STATUS_S:
            self._status_s = now_s
            self._send_words()
        if now_s - self._report_s >= REPORT_S:
            self._report_s = now_s
            self._send_report()

    # --- what comes ---

    def _take_goals(self) -> None:
        for data in _some(self._goal):
            if (goal := self._decoded(topics.GOAL, data)) is None:
                continue
            if emergency(str(goal["data"])) is not None:
                self._orders.press("estop")  # it is released where the robot is
            else:
                self._orders.say(goal["data"])

    def _take_velocity(self) -> None:
        if (data := self._twist()) is None:
            return
        if (twist := self._decoded(topics.CMD_VEL, data)) is not None:
            linear = twist["linear"]
            self._orders.drive(linear["x"], linear["y"], twist["angular"]["z"])

    def _decoded(self, topic: Topic, data: bytes) -> dict[str, Any] | None:
        try:
            return decode(topic.interface, data)
        except CdrError:
            self.refused += 1
            return None

    # --- what goes ---

    def _send_body(self) -> None:
        body = self._body.take()
        if body is None:
            return
        self._stamps.saw(body.stamp_s, time.time())
        wall_s = self._stamps.wall_s(body.stamp_s)
        joints = self._joints
        self._offer(topics.JOINT_STATES, lambda: messages.joint_states(body, joints, wall_s))
        self._offer(topics.ODOM, lambda: messages.odometry(body, wall_s))
        self._offer(
            topics.TF,
            lambda: messages.transforms(
                body, self._world.latest, self._links, joints=joints, wall_s=wall_s
            ),
        )

    def _send_sensors(self) -> None:
        if not self._stamps.known:
            return
        if (lidar := self._lidar.take()) is not None:
            device, rate_hz = self._robot.sensors.lidar, own.LIDAR.rate_hz or 1.0
            wall_s = self._stamps.wall_s(lidar.stamp_s)
            self._offer(
                topics.SCAN, lambda: messages.scan(lidar, device, rate_hz=rate_hz, wall_s=wall_s)
            )
        if (power := self._power.take()) is not None:
            stamp_s = self._stamps.wall_s(power.stamp_s)
            self._offer(topics.BATTERY, lambda: messages.battery(power, stamp_s))
        if self._camera is not None and (image := self._camera.take()) is not None:
            taken_s = self._stamps.wall_s(image.stamp_s)
            self._offer(topics.PICTURE, lambda: messages.picture(image, taken_s))
            self._offer(topics.CAMERA_INFO, lambda: messages.camera_info(image, taken_s))
            if image.depth_m:
                self._offer(topics.DEPTH, lambda: messages.depth_picture(image, taken_s))

    def _send_words(self) -> None:
        for text in self._orders.words():
            self._publish(topics.SAID, {"data": text})
        found = status(self._orders)
        if found != self._last_status:
            self._last_status = found
            self._publish(topics.STATUS, {"data": msgspec.json.encode(found).decode()})

    def _send_report(self) -> None:
        orders, body, timing = self._orders, self._body.latest, self._timing.latest
        rows = diagnosed(orders, body, timing, plans=self._plans, refused=self.refused)
        self._offer(topics.DIAGNOSTICS, lambda: messages.diagnostics(rows, time.time()))

    def _offer(self, topic: Topic, make: Callable[[], dict[str, Any]]) -> None:
        """Make a message, if anybody wants it."""
        if self._publisher(topic).wanted:
            self._publish(topic, make())

    def _publish(self, topic: Topic, message: dict[str, Any]) -> None:
        self._publisher(topic).publish(message)

    def _publisher(self, topic: Topic) -> Publisher:
        return self._out[topic]


class _News:
    """The newest of a stream, once."""

    def __init__(self, reader: Subscription[Any]) -> None:
        self._reader = reader
        self._last_s: float | None = None

    @property
    def latest(self) -> Any:
        """The newest."""
        return self._reader.latest

    def take(self) -> Any:
        """The newest, if it was not taken yet."""
        latest = self._reader.latest
        if latest is None or latest.stamp_s == self._last_s:
            return None
        self._last_s = latest.stamp_s
        return latest


def _some(take: Callable[[], bytes | None]) -> list[bytes]:
    found: list[bytes] = []
    while len(found) < MOST_AT_ONCE and (data := take()) is not None:
        found.append(data)
    return found
