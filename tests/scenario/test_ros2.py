"""A real robot before a ROS 2 machine (plain zenoh, rosbags) that drives and stops it."""

from __future__ import annotations

import json
import time

import pytest

from tests.fakes.ros2_peer import EMPTY, free_endpoint, machines
from tests.fakes.waiting import HANG_S, eventually
from tests.scenario.test_service import humanoid  # noqa: F401  (a fixture)

pytestmark = [pytest.mark.slow, pytest.mark.live]
DOMAIN = 7


def test_a_ros2_machine_sees_drives_orders_and_stops_a_robot(humanoid):  # noqa: F811
    endpoint = free_endpoint()
    with machines(endpoint, domain=DOMAIN) as peer:
        status, said = humanoid(
            "up", "--detach", "--world", "empty", "--ros2", "--ros2-router", endpoint,
            "--ros2-domain", str(DOMAIN),
        )  # fmt: skip
        assert status == 0, said
        assert eventually(lambda: "MS /cmd_vel" in peer.tokens())
        tokens = peer.tokens()
        inboxes = {
            name: peer.subscribe(tokens[f"MP /{name}"])
            for name in ("odom", "tf", "joint_states", "scan", "task/status", "robot_description")
        }
        for inbox in inboxes.values():
            inbox.wait(within_s=HANG_S)
        odom = inboxes["odom"]

        def how():
            return json.loads(inboxes["task/status"].messages[-1].data)

        def at_m():
            return odom.messages[-1].pose.pose.position.x

        assert eventually(lambda: how().get("mode") == "stand")
        began_m = at_m()

        def drives():
            peer.twist(0.3)
            time.sleep(0.05)  # as a joystick does
            return at_m() - began_m > 0.15

        assert eventually(drives)
        assert eventually(lambda: how()["mode"] == "stand")  # it has died out
        peer.send("cmd_vel", "geometry_msgs/msg/Twist", b"\0\1\0\0\1\2\3", count=200)
        peer.twist(float("nan"), float("inf"))
        assert eventually(lambda: "no velocity" in how()["cmd_vel"])
        peer.say("walk 1.5 m forward, then walk 1.5 m back")
        assert eventually(lambda: how()["state"] == "working")
        assert eventually(lambda: (peer.twist(0.3), "under way" in how()["cmd_vel"])[1])
        peer.send("task/stop", EMPTY, b"")
        assert eventually(lambda: how()["state"] == "idle" and how()["mode"] == "stand")
        assert humanoid.standing["mode"] == "stand"  # none of it has thrown it over
    assert humanoid("down")[0] == 0
