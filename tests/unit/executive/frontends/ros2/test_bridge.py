"""The bridge before a machine that shares no code with it: what it sends, takes, and survives."""

from __future__ import annotations

import json
import math
import threading

import numpy as np
import pytest

from executive.engine.teleoperation import Velocity
from executive.frontends.prompt.view import View
from executive.frontends.ros2 import topics
from executive.frontends.ros2.bridge import Bridge
from executive.frontends.ros2.main import heed_stops
from executive.frontends.ros2.network import Network
from executive.frontends.ros2.orders import MOST_TASKS, MOST_TEXT, Orders
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed
from robot import messages as m
from robot.bus import topics as own
from robot.bus.bus import LocalBus
from robot.model import description
from robot.se3 import SE3
from tests.fakes.ros2_peer import EMPTY, STORE, free_endpoint, machines
from tests.fakes.steered import Log, Told
from tests.fakes.waiting import HANG_S, eventually

DOMAIN = 42
RUNNING = Running(pid=1, run="r", private="", world="w", robot="juno", runtime="live")
JUNO = description.load("juno")


class Rig:
    """A bridge between a bus and a peer, before an executive that notes what it is told."""

    def __init__(self, bus, peer, bridge, network, orders, told):
        self.bus, self.peer, self.bridge = bus, peer, bridge
        self.network, self.orders, self.told = network, orders, told
        self.teleoperation = told.robot.session.teleoperation
        self._now_s = 0.0

    def rounds(self, count=1):
        for _ in range(count):
            self._now_s += 0.25
            self.bridge.round(self._now_s)

    def until(self, is_so):
        def look():
            self.rounds()
            return is_so()

        assert eventually(look)

    def inbox(self, topic):
        found = {}

        def there():
            found.update(self.peer.tokens())
            return f"MP /{topic.name}" in found

        assert eventually(there)
        return self.peer.subscribe(found[f"MP /{topic.name}"])

    def receive(self, topic, own_topic, message):
        """What a subscriber gets of a message on the robot's own bus."""
        inbox = self.inbox(topic)

        def came():
            self.bus.publish(own_topic, message)
            self.bridge._body._last_s = self.bridge._lidar._last_s = None
            self.bridge._power._last_s = None
            if self.bridge._camera is not None:
                self.bridge._camera._last_s = None
            return inbox.count > 0

        self.until(came)
        return inbox


def unplanned():
    raise AssertionError("nobody asked for a way")


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    endpoint = free_endpoint()
    told = Told()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", "")
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        with (
            claimed("kitchen") as place,
            Counter(told, place=place, running=RUNNING, log=Log()),
            machines(endpoint, domain=DOMAIN) as peer,
            Network(endpoint, domain=DOMAIN) as network,
            Orders(place) as orders,
        ):
            bus = LocalBus()
            heed_stops(network, orders)
            bridge = Bridge(bus, network, orders, JUNO, planner=unplanned, pictures=True)
            bus.publish(own.BODY_STATE, body(1.0))
            yield Rig(bus, peer, bridge, network, orders, told)


def body(stamp_s, **changed):
    count = len(JUNO.motor_names)
    at = {
        "mode": "stand",
        "X_NB": SE3.from_rpy(0.0, 0.0, 0.5 * math.pi, (1.0, 2.0, 0.9)),
        "v_NB": (0.0, 0.3, 0.0),
        "w_NB": (0.0, 0.0, 0.2),
        "q_rad": tuple(0.001 * n for n in range(count)),
        "qd_rad_s": (0.25,) * count,
        "tau_nm": (3.0,) * count,
    }
    hand = m.HandState(X_NG=SE3(), opening_m=0.0, opening_m_s=0.0, load_n=0.0)
    return m.BodyState(
        stamp_s=stamp_s, X_NL=SE3(), X_NR=SE3(), X_NS=SE3(), left_contact=True, right_contact=True,
        com_N=(0.0, 0.0, 0.0), dcm_N=(0.0, 0.0), zmp_N=(0.0, 0.0),
        hands={"left": hand, "right": hand}, activities={}, **{**at, **changed},
    )  # fmt: skip


# --- what goes out ---


def test_a_node_with_all_its_topics_is_found_by_liveliness_alone(rig):
    names = {f"MP /{one.name}" for one in (*topics.ALWAYS, *topics.WITH_PICTURES)}
    names |= {f"MS /{one.name}" for one in (topics.GOAL, topics.STOP, topics.ESTOP, topics.CMD_VEL)}
    names.add(f"SS /{topics.PLAN.name}")
    assert eventually(lambda: rig.peer.tokens().keys() >= {"humanoid", *names})
    for token in rig.peer.tokens().values():
        if token.role in ("MP", "MS"):
            assert token.hash == STORE.hash_rihs01(token.interface)


def test_joints_are_told_by_their_names_in_the_urdf(rig):
    inbox = rig.receive(topics.JOINT_STATES, own.BODY_STATE, body(2.0))
    message = inbox.messages[-1]
    assert message.name[:3] == ["left_hip_yaw", "left_hip_roll", "left_hip_pitch"]
    assert message.position[5] == 0.005 and message.velocity[0] == 0.25 and message.effort[0] == 3.0
    attachment = inbox.attachments[-1]
    assert len(attachment) == 33 and attachment[16] == 16
    numbers = [int.from_bytes(one[:8], "little") for one in inbox.attachments]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_the_velocity_of_odometry_is_in_the_bases_own_axes(rig):
    message = rig.receive(topics.ODOM, own.BODY_STATE, body(3.0)).messages[-1]
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_link")
    assert message.pose.pose.position.y == 2.0
    linear = message.twist.twist.linear  # it faces along y, and moves along y
    assert (linear.x, linear.y) == (pytest.approx(0.3), pytest.approx(0.0, abs=1e-12))
    assert message.twist.twist.angular.z == pytest.approx(0.2)


def test_transforms_make_one_tree_from_the_map_to_every_link(rig):
    world = m.WorldState(
        stamp_s=3.0, X_WN=SE3((5.0, 0.0, 0.0)), X_WB=SE3(), fix_age_s=0.0, tracks=()
    )
    rig.bus.publish(own.WORLD_STATE, world)
    moving = rig.receive(topics.TF, own.BODY_STATE, body(4.0)).messages[-1].transforms
    still = rig.inbox(topics.TF_STATIC).wait(within_s=HANG_S).transforms
    parents = {one.child_frame_id: one.header.frame_id for one in (*moving, *still)}
    assert len(parents) == len(moving) + len(still)
    for frame in ("lidar_frame", "head_camera_frame", "left_finger_lower", "right_foot"):
        seen = [frame]
        while seen[-1] in parents:
            seen.append(parents[seen[-1]])
        assert seen[-3:] == ["base_link", "odom", "map"]
    assert len({(one.header.stamp.sec, one.header.stamp.nanosec) for one in moving}) == 1


def test_who_comes_late_is_given_the_description_and_what_never_moves(rig):
    text = rig.inbox(topics.DESCRIPTION).wait(within_s=HANG_S).data
    assert text.startswith("<?xml") and '<robot name="juno">' in text
    assert len(rig.inbox(topics.TF_STATIC).wait(within_s=HANG_S).transforms) > 10


def test_a_scan_says_what_hits_nothing_by_infinity(rig):
    scan = m.LidarScan(
        stamp_s=4.0, angle_min_rad=-math.pi, angle_step_rad=0.1, ranges_m=(1.5, math.inf, 2.0)
    )
    message = rig.receive(topics.SCAN, own.LIDAR, scan).messages[-1]
    assert message.header.frame_id == "lidar_frame"
    assert message.ranges.tolist() == [1.5, math.inf, 2.0]
    assert message.angle_max == pytest.approx(-math.pi + 0.2, abs=1e-6)


def test_a_battery_says_nothing_that_is_not_measured(rig):
    power = m.PowerState(stamp_s=4.0, charge=0.75, power_w=90.0, source="emulated")
    message = rig.receive(topics.BATTERY, own.POWER, power).messages[-1]
    assert message.percentage == 0.75 and math.isnan(message.voltage) and message.present


def test_pictures_come_with_their_camera_and_their_depth(rig):
    depth = np.arange(6, dtype=np.float32)
    image = m.RgbdImage(
        stamp_s=4.0, width=3, height=2, focal_px=(2.0, 2.5), centre_px=(1.0, 0.5),
        frame="head_camera", colours=bytes(range(18)), depth_m=depth.tobytes(), exposure_s=0.0,
    )  # fmt: skip
    seen = rig.receive(topics.PICTURE, own.RGBD, image).messages[-1]
    assert (seen.encoding, seen.step, bytes(seen.data)) == ("rgb8", 9, bytes(range(18)))
    far = rig.receive(topics.DEPTH, own.RGBD, image).messages[-1]
    assert far.encoding == "32FC1" and np.array_equal(far.data.view(np.float32), depth)
    info = rig.receive(topics.CAMERA_INFO, own.RGBD, image).messages[-1]
    assert info.k.tolist() == [2.0, 0.0, 1.0, 0.0, 2.5, 0.5, 0.0, 0.0, 1.0]
    assert info.header.frame_id == seen.header.frame_id == "head_camera_frame"


def test_how_it_is_comes_as_json_also_to_who_comes_late(rig):
    rig.told.robot.view = View(state="working", mode="walk", goal="go to the table", steps=(2, 5))
    rig.told.asked = ("Which cup?", ("the red one", "the blue one"))
    try:
        rig.until(lambda: rig.bridge._last_status.get("task") == "go to the table")
        rig.until(lambda: rig.bridge._last_status.get("asks") == "Which cup?")
        said = json.loads(rig.inbox(topics.STATUS).wait(within_s=HANG_S).data)
        assert (said["state"], said["mode"]) == ("working", "walk")
        assert said["choices"] == ["the red one", "the blue one"]
        assert said["progress"] == {"done": 2, "steps": 5}
    finally:
        rig.told.asked = None
        rig.told.robot.view = View()


def test_diagnostics_tell_what_is_not_well(rig):
    alarm = m.MotorAlarm("hot", "left_knee", "DERATE", "70 degrees", "let it cool")
    rig.bus.publish(own.BODY_STATE, body(5.0, alarms=(alarm,), temperature_c=(40.0, 70.5)))
    inbox = rig.inbox(topics.DIAGNOSTICS)
    rig.until(lambda: inbox.count > 0)
    rows = {row.name: row for row in inbox.messages[-1].status}
    assert rows["humanoid: motors"].level == 1
    values = {one.key: one.value for one in rows["humanoid: motors"].values}
    assert values["left_knee"].startswith("hot") and values["hottest_c"] == "70.5"


def test_what_nobody_wants_is_not_made(rig, monkeypatch):
    made = []
    monkeypatch.setattr(rig.bridge, "_publish", lambda topic, _: made.append(topic))
    monkeypatch.setattr(type(rig.bridge._out[topics.TF]), "wanted", property(lambda _: False))
    rig.bus.publish(own.BODY_STATE, body(6.0))
    rig.bridge._body._last_s = None
    rig.bridge._send_body()
    assert not made


# --- what comes in ---


def test_a_sentence_is_taken_as_one_and_no_command_of_the_prompt(rig):

    def taken():
        rig.peer.say("wave\x1b[31m\n")
        return any(one.startswith("wave [31m") for one in rig.told.did)

    rig.until(taken)
    rig.told.end(len(rig.told.robot.jobs))


def test_a_stop_is_heeded_whatever_kind_it_is_and_whatever_is_in_it(rig):
    for interface, data, hash_ in (
        (EMPTY, STORE.types[EMPTY](), None),
        (EMPTY, b"", None),
        (EMPTY, b"\xff" * 40, "RIHS01_ffff"),
        ("std_msgs/msg/Bool", b"junk", None),
    ):
        stops = rig.told.did.count("stop")

        def sent(stops=stops, what=(interface, data, hash_)):
            rig.peer.send("task/stop", what[0], what[1], hash_=what[2])
            return rig.told.did.count("stop") > stops

        assert eventually(sent)


@pytest.mark.parametrize("words", ["estop reset", "éstop reset", "\x1b[1mestop release"])
def test_the_emergency_stop_is_pressed_by_its_topic_and_by_the_word(rig, words):
    before, presses = len(rig.told.did), rig.told.did.count("estop")
    assert eventually(
        lambda: (rig.peer.send("estop", EMPTY, b"x"), rig.told.did.count("estop") > presses)[1]
    )
    presses = rig.told.did.count("estop")

    def pressed():
        rig.peer.say(words)  # undone where the robot is
        return rig.told.did.count("estop") > presses

    rig.until(pressed)
    assert not any("reset" in one or "release" in one for one in rig.told.did[before:])


def test_a_velocity_is_handed_on_and_why_it_is_not_walked_is_told(rig):
    def driven():
        rig.peer.twist(0.25, 0.125, -0.5)
        return Velocity(0.25, 0.125, -0.5) in rig.teleoperation.told

    rig.until(driven)
    rig.teleoperation.answer = "a task is under way: pause it first"
    try:
        rig.until(lambda: (driven(), "a task is under way" in rig.orders.refused)[1])
        rig.until(lambda: "a task is under way" in rig.bridge._last_status.get("cmd_vel", ""))
    finally:
        rig.teleoperation.answer = ""


def test_velocities_that_are_none_are_handed_to_nobody(rig):
    rig.until(lambda: rig.orders._velocity is None)
    before = len(rig.teleoperation.told)
    for bad in (math.nan, math.inf, -math.inf):

        def told(bad=bad):
            rig.orders.refused = ""
            rig.peer.twist(bad, 0.0, 0.0)
            rig.rounds()
            return "no velocity" in rig.orders.refused

        assert eventually(told)
    assert all(math.isfinite(one) for v in rig.teleoperation.told[before:] for one in v)


def test_what_is_cut_off_is_counted_and_nothing_comes_of_it(rig):
    for topic in (topics.GOAL, topics.CMD_VEL):
        refused, did = rig.bridge.refused, done(rig)

        def counted(topic=topic, refused=refused):
            rig.peer.send(topic.name, topic.interface, b"\0\1\0\0\xff")
            rig.rounds()
            return rig.bridge.refused > refused

        assert eventually(counted)
        assert done(rig) == did


def done(rig):
    """What it did but for stops, of which some were asked for more than once."""
    return [one for one in rig.told.did if "stop" not in one]


def test_another_type_hash_is_another_topic(rig):
    before = list(rig.told.did)
    string = STORE.types["std_msgs/msg/String"]

    def heard():
        rig.peer.send("task/goal", "std_msgs/msg/String", string("bow"), hash_="RIHS01_00")
        rig.peer.say("nod")
        return any(one.startswith("nod") for one in rig.told.did[len(before) :])

    rig.until(heard)
    assert not any(one.startswith("bow") for one in rig.told.did[len(before) :])


def worked_off(rig):
    """Wait until the executive has heard all that was asked of it so far, and is at nothing."""
    begun = len(rig.told.did)
    rig.until(lambda: not rig.orders._tasks)
    rig.orders.say("hold still")
    assert eventually(lambda: any("hold still" in one for one in rig.told.did[begun:]))


def test_a_flood_is_bounded_and_a_stop_goes_past_it(rig):
    rig.told.go_on.clear()  # the executive is busy with a line
    try:
        string = STORE.types["std_msgs/msg/String"]
        stops = rig.told.did.count("stop")
        for number in range(20):
            rig.peer.send("task/goal", "std_msgs/msg/String", string(f"squat {number}"), count=100)
            rig.peer.twist(0.1 * number)
            rig.rounds()
            assert len(rig.orders._tasks) <= MOST_TASKS
        assert rig.orders.left_out > 0

        def stopped():  # zenoh drops what it has no room for, a stop as well: it is said again
            rig.peer.send("task/stop", EMPTY, b"")
            return rig.told.did.count("stop") > stops

        assert eventually(stopped)
    finally:
        rig.told.go_on.set()
    worked_off(rig)


def test_what_waits_when_the_robot_is_stopped_is_about_that_stop(rig):
    """A stop goes past the sentences before it: they are handed over after it, and not done."""
    worked_off(rig)
    rig.told.go_on.clear()  # the executive is busy with a line
    begun = len(rig.told.did)
    try:
        rig.orders.say("squat first")
        assert eventually(lambda: not rig.orders._tasks)  # it is with the executive
        rig.orders.say("squat later")
        stops = rig.told.stops
        rig.orders.press("stop")
        assert eventually(lambda: rig.told.stops > stops)
    finally:
        rig.told.go_on.set()
    assert eventually(lambda: any("later" in one for one in rig.told.did[begun:]))
    (later,) = [one for one in rig.told.did[begun:] if "later" in one]
    assert later == f"squat later ({stops})"  # as of before the stop: a shell does not read it


def test_what_is_far_too_long_is_left_out(rig):
    left_out = rig.orders.left_out
    for text in ("x" * (MOST_TEXT + 1), "", "\0\0"):
        rig.orders.say(text)
    assert rig.orders.left_out == left_out + 3
    refused = rig.bridge.refused

    def counted():
        rig.peer.send("task/goal", "std_msgs/msg/String", bytes(3 << 20))
        rig.rounds()
        return rig.bridge.refused > refused

    assert eventually(counted)


def test_a_subscriber_that_never_reads_holds_nothing_up(rig):
    stuck = threading.Event()
    key = rig.inbox(topics.JOINT_STATES).token.key
    reader = rig.peer._session.declare_subscriber(key, lambda _: stuck.wait(HANG_S))
    try:
        rig.until(lambda: rig.bridge._out[topics.JOINT_STATES].wanted)
        for number in range(2000):  # far more than lies on the way
            rig.bus.publish(own.BODY_STATE, body(10.0 + 0.02 * number))
            rig.bridge._send_body()
    finally:
        stuck.set()
        reader.undeclare()
