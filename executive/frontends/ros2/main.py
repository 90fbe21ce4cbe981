"""The bridge to ROS 2 as a process: until it is told to end, or the executive is gone."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path

import msgspec

from executive.frontends.ros2 import topics
from executive.frontends.ros2.bridge import RATE_HZ, Bridge
from executive.frontends.ros2.network import Network
from executive.frontends.ros2.orders import Orders
from executive.frontends.service.place import Place
from executive.frontends.service.ros2_plan import Plan
from robot.bus.lifeline import Stop, tie_to_parent
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.model import description
from robot.planning.process import ProcessPlanner

NICE = 10
"""Of what is made and sent: the robot comes first. Stops have threads that are not so polite."""
BUS_NAME = "observer"


def main(parent_pid: str) -> None:
    """Load, build, run, close. SIGTERM ends it at once while there is no router yet."""
    tie_to_parent(int(parent_pid))
    plan = msgspec.json.decode(sys.stdin.buffer.read(), type=Plan)
    robot = description.load(plan.robot)
    place = Place(plan.name, Path(plan.place))
    with Network(plan.router, domain=plan.domain, namespace=plan.namespace) as network:
        stop = Stop()
        with Orders(place) as orders, ZenohBus(BUS_NAME, plan.sockets) as bus:
            heed_stops(network, orders)
            planner = partial(ProcessPlanner, robot)
            bridge = Bridge(bus, network, orders, robot, planner=planner, pictures=plan.pictures)
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
            clock = WallClock()
            due_s = clock.now_s()
            while not stop:
                bridge.round(clock.now_s())
                due_s = max(due_s + 1.0 / RATE_HZ, clock.now_s())
                clock.sleep_until(due_s)
    os._exit(0)  # whatever still waits for an answer is not waited for; a planner ends with us


def heed_stops(network: Network, orders: Orders) -> None:
    """Press whatever comes on the topics of stops, whatever its kind, each in a thread."""
    for topic, press in (
        (topics.STOP, lambda: orders.press("stop")),
        (topics.ESTOP, lambda: orders.press("estop")),
    ):
        wait = network.waiting(topic.name, topic.interface, topic.qos)
        threading.Thread(target=_press_each, args=(wait, press), daemon=True).start()


def _press_each(wait: Callable[[], bool], press: Callable[[], None]) -> None:
    while wait():
        press()


if __name__ == "__main__":
    main(*sys.argv[1:])
