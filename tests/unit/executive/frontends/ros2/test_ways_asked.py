"""Ways that a ROS 2 machine asks for: planned as skills plan them, answered whatever comes."""

from __future__ import annotations

import math
import struct
from itertools import pairwise

import pytest

from executive.frontends.ros2 import topics
from executive.frontends.ros2.network import Network
from executive.frontends.ros2.plans import Plans
from robot import messages as m
from robot.model import description
from robot.planning.inline import InlinePlanner
from robot.se3 import SE3
from tests.fakes.planning_room import room
from tests.fakes.ros2_peer import ANSWER, STORE, free_endpoint, machines
from tests.fakes.waiting import eventually

DOMAIN = 43
JUNO = description.load("juno")
WORLD = m.WorldState(
    stamp_s=1.0, X_WN=SE3.from_xy_yaw(-0.5, 0.0, 0.0), X_WB=SE3(), fix_age_s=0.0, tracks=()
)


class Stands:
    """A body, as far as plans ask."""

    X_NS = SE3.from_xy_yaw(0.5, 0.0, 0.0)  # the middle of the room


class Asking:
    def __init__(self, peer, plans, token):
        self.peer, self.plans, self.token = peer, plans, token
        self.world = WORLD
        self.now_s = 0.0

    def __call__(self, request, **how):
        """The stances of the answer, by rosbags, and what came with it; None: no answer."""
        replies = self.peer.ask(self.token, request, **how)
        found = []

        def came():
            self.now_s += 0.25
            self.plans.round(self.now_s, Stands(), self.world, room())
            if (reply := replies.try_recv()) is not None:
                found.append(reply)
            return bool(found)

        assert eventually(came)
        sample = found[0].ok
        assert str(sample.key_expr) == self.token.key
        path = STORE.deserialize_cdr(sample.payload.to_bytes(), ANSWER).plan
        assert path.header.frame_id == "map"
        stances = [(one.pose.position.x, one.pose.position.y) for one in path.poses]
        return stances, sample.attachment.to_bytes()


@pytest.fixture(scope="module")
def asking():
    endpoint = free_endpoint()
    with machines(endpoint, domain=DOMAIN) as peer, Network(endpoint, domain=DOMAIN) as network:
        take = network.service(topics.PLAN.name, topics.PLAN.interface, topics.PLAN.qos)
        assert eventually(lambda: "SS /plan_trajectory" in peer.tokens())
        token = peer.tokens()["SS /plan_trajectory"]
        yield Asking(peer, Plans(take, lambda: InlinePlanner(JUNO), JUNO), token)


def types(name):
    return STORE.types[name]


def pose(x, y, *, frame="map", w=1.0, z=0.0):
    header = types("std_msgs/msg/Header")(types("builtin_interfaces/msg/Time")(0, 0), frame)
    at = types("geometry_msgs/msg/Point")(x, y, 0.0)
    turned = types("geometry_msgs/msg/Quaternion")(0.0, 0.0, z, w)
    return types("geometry_msgs/msg/PoseStamped")(
        header, types("geometry_msgs/msg/Pose")(at, turned)
    )


def get_plan(start, goal, tolerance=0.0):
    return types("nav_msgs/msg/GetPlan_Request")(start, goal, tolerance)


HERE = pose(0.0, 0.0, frame="")


def test_a_way_from_where_it_stands_goes_around_what_stands_there(asking):
    stances, attached = asking(get_plan(HERE, pose(3.0, 0.5)), number=7)
    assert stances[0] == pytest.approx((0.0, 0.0)) and stances[-1] == pytest.approx((3.0, 0.5))
    assert sum(math.dist(*pair) for pair in pairwise(stances)) > math.dist((0, 0), (3.0, 0.5))
    number, stamp_ns, length = struct.unpack("<qqB", attached[:17])
    assert (number, length, attached[17:]) == (7, 16, bytes(range(16)))
    assert stamp_ns > 1.7e18


@pytest.mark.parametrize(
    ("frame", "at"), [("map", (-1.0, 1.5)), ("odom", (-0.5, 1.5)), ("base_link", (-1.0, 1.5))]
)
def test_a_goal_may_be_in_any_frame_of_the_base(asking, frame, at):
    stances, _ = asking(get_plan(HERE, pose(*at, frame=frame)))
    assert stances[-1] == pytest.approx((-1.0, 1.5))


def test_a_start_of_its_own_is_where_the_way_begins(asking):
    stances, _ = asking(get_plan(pose(-1.0, 1.0), pose(-1.0, -1.0)))
    assert stances[0] == pytest.approx((-1.0, 1.0)) and stances[-1] == pytest.approx((-1.0, -1.0))


def test_a_goal_in_a_table_is_tried_about_as_far_as_is_tolerated(asking):
    table = 1.5, 0.8
    assert asking(get_plan(HERE, pose(*table)))[0] == []
    assert "table" in asking.plans.said
    stances, _ = asking(get_plan(HERE, pose(*table), 0.9))
    assert 0.3 < math.dist(stances[-1], table) <= 0.9 + 1e-6


@pytest.mark.parametrize(
    ("request_", "why"),
    [
        (get_plan(HERE, pose(1.0, 0.0, frame="lidar_frame")), "lidar_frame"),
        (get_plan(HERE, pose(math.nan, 0.0)), "not finite"),
        (get_plan(HERE, pose(0.0, 1.0, w=1e200, z=1e200)), "not finite"),
        (get_plan(HERE, pose(1e9, 0.0)), ""),
        (get_plan(HERE, pose(50.0, 0.0), math.inf), ""),
        (b"", "CDR"),
        (b"\0\1\0\0\1\2\3", ""),
        (bytes(2 << 20), "CDR"),
    ],
)
def test_what_is_no_way_is_answered_all_the_same(asking, request_, why):
    assert asking(request_)[0] == []
    assert why in asking.plans.said


def test_who_does_not_know_where_it_is_plans_nothing(asking):
    asking.world = WORLD.__class__(
        **{name: getattr(WORLD, name) for name in WORLD.__struct_fields__} | {"lost": "kidnapped"}
    )
    try:
        assert asking(get_plan(HERE, pose(0.5, 0.0)))[0] == []
    finally:
        asking.world = WORLD
    assert "where it is" in asking.plans.said


def test_who_does_not_say_who_asks_is_not_answered(asking):
    replies = asking.peer.ask(asking.token, get_plan(HERE, pose(0.5, 0.0)), attached=False)
    count = asking.plans.count
    asking(get_plan(HERE, pose(0.5, 0.0)))  # it goes on behind it
    assert asking.plans.count == count + 1
    assert list(replies) == []  # it ended unanswered


def test_who_asked_and_has_gone_holds_nobody_up(asking):
    replies = asking.peer.ask(asking.token, get_plan(HERE, pose(0.5, 0.0)), within_s=0.5)
    taken = []
    assert eventually(lambda: taken.append(asking.plans._take()) or taken[-1] is not None)
    for reply in replies:  # until they wait no more
        assert reply.ok is None
    taken[-1].answer({"plan": {}})
    assert asking(get_plan(HERE, pose(0.5, 0.0)))[0][-1] == pytest.approx((0.5, 0.0))


def test_a_flood_leaves_the_newest(asking):
    asked = [
        asking.peer.ask(asking.token, get_plan(HERE, pose(0.5, 0.0)), number=n) for n in range(100)
    ]
    count = asking.plans.count
    stances, attached = asking(get_plan(HERE, pose(0.4, 0.0)), number=100)
    assert stances[-1] == pytest.approx((0.4, 0.0))
    assert struct.unpack("<q", attached[:8]) == (100,)
    assert asking.plans.count <= count + topics.PLAN.qos.depth + 1
    del asked
