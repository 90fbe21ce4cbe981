"""Linkages between motors and joints: against a mechanism of MuJoCo, and by work and torque."""

from typing import TypeAlias

import msgspec
import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot.bringup import can_tools, ethernet_tools, motor_bench
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.ethernet import joint_map
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.linkage import Belts, Rod, Rods, at_cranks, needed, solved
from robot.drivers.motors.transmission import Transmission
from robot.errors import ConfigError, DriverError
from sim.devices import direct
from sim.devices.ethernet_bench import DirectPorts
from tests.fakes import can_rig, ethernet_rig
from tests.fakes.few_motors import motors_of

ANKLE = Rods(
    joints=("pitch", "roll"),
    rods=(
        Rod(motor_at_m=(0, 0.03, 0.2), crank_m=0.05, rod_m=0.22, foot_at_m=(-0.05, 0.03, -0.02)),
        Rod(motor_at_m=(0, -0.03, 0.28), crank_m=0.05, rod_m=0.3, foot_at_m=(-0.05, -0.03, -0.02)),
    ),
)
HIP_TO_KNEE = Belts(joints=("pitch", "roll"), turns=((1.0, 0.0), (0.5, 2.0)))
DIFFERENTIAL = Belts(joints=("pitch", "roll"), turns=((1.0, 0.8), (1.0, -0.8)))
LINKAGES = [ANKLE, HIP_TO_KNEE, DIFFERENTIAL]

FOOT = """\
rate_hz: 500
boards:
  shank: {address: 10.0.7.11, number: 1}
joints:
  pitch: {board: shank, model: ANKLE, id: 0, sign: -1, offset_rad: 0.2, gear: 2, lower_rad: -0.9, upper_rad: 0.7, velocity_limit_rad_s: 8, torque_limit_nm: 40}
  roll: {board: shank, model: ANKLE, id: 1, gear: 1.5, lower_rad: -0.4, upper_rad: 0.4, velocity_limit_rad_s: 8, torque_limit_nm: 20}
  toe: {board: shank, model: TOE, id: 2, lower_rad: -0.5, upper_rad: 0.6, velocity_limit_rad_s: 8, torque_limit_nm: 5}
linkages:
  ankle:
    type: rods
    joints: [pitch, roll]
    rods:
      - {motor_at_m: [0, 0.03, 0.2], crank_m: 0.05, rod_m: 0.22, foot_at_m: [-0.05, 0.03, -0.02]}
      - {motor_at_m: [0, -0.03, 0.28], crank_m: 0.05, rod_m: 0.30, foot_at_m: [-0.05, -0.03, -0.02]}
"""  # noqa: E501


def foot(folder, text: str = FOOT) -> DriveMap:
    path = folder / "ethernet.yaml"
    path.write_text(text)
    return joint_map.load(path)


@pytest.fixture
def joints(tmp_path) -> DriveMap:
    return foot(tmp_path)


# --- geometry ------------------------------------------------------------------------------------

MECHANISM = """\
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="foot">
      <joint name="pitch" axis="0 1 0"/>
      <geom size="0.01"/>
      <body name="sole">
        <joint name="roll" axis="1 0 0"/>
        <geom size="0.01"/>
        <site name="end0" pos="-0.05 0.03 -0.02"/>
        <site name="end1" pos="-0.05 -0.03 -0.02"/>
      </body>
    </body>
    <body pos="0 0.03 0.2"><joint name="crank0" axis="0 1 0"/><geom size="0.01"/>
      <site name="tip0" pos="0.05 0 0"/></body>
    <body pos="0 -0.03 0.28"><joint name="crank1" axis="0 1 0"/><geom size="0.01"/>
      <site name="tip1" pos="0.05 0 0"/></body>
  </worldbody>
</mujoco>
"""

angles = st.tuples(st.floats(-0.9, 0.7), st.floats(-0.4, 0.4)).map(np.array)


@given(angles)
@settings(max_examples=60)
def test_rods_keep_their_lengths_in_a_mechanism_that_mujoco_moves(q):
    model = mujoco.MjModel.from_xml_string(MECHANISM)
    data = mujoco.MjData(model)
    data.qpos[:2] = q
    data.qpos[2:] = [rod.crank(*q.tolist())[0] for rod in ANKLE.rods]
    mujoco.mj_kinematics(model, data)
    for index, rod in enumerate(ANKLE.rods):
        ends = data.site(f"end{index}").xpos - data.site(f"tip{index}").xpos
        assert np.linalg.norm(ends) == pytest.approx(rod.rod_m, abs=1e-9)


@given(angles)
@settings(max_examples=60)
def test_a_jacobian_is_what_cranks_gain_by_the_joints(q):
    for linkage in LINKAGES:
        _, jacobian = linkage.at(q)
        step = 1e-6
        for column in range(2):
            more, less = q.copy(), q.copy()
            more[column] += step
            less[column] -= step
            gained = (linkage.at(more)[0] - linkage.at(less)[0]) / (2 * step)
            np.testing.assert_allclose(jacobian[:, column], gained, atol=1e-6)


@given(angles, angles)
@settings(max_examples=60)
def test_joints_are_found_from_cranks_wherever_the_search_begins(q, begin):
    for linkage in LINKAGES:
        found = solved(linkage, linkage.at(q)[0], begin)
        assert found is not None
        np.testing.assert_allclose(found.angles, q, atol=1e-8)


def test_cranks_stand_at_0_where_joints_do():
    for linkage in LINKAGES:
        np.testing.assert_allclose(linkage.at(np.zeros(2))[0], 0.0, atol=1e-12)


def test_where_no_joints_are_nothing_is_found():
    assert solved(ANKLE, np.array([1.5, -1.5]), np.zeros(2)) is None
    assert solved(ANKLE, np.array([np.nan, 0.0]), np.zeros(2)) is None


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("rod_m: 0.30", "rod_m: 0.20", "a rod does not reach"),
        ("joints: [pitch, roll]", "joints: [pitch, rol]", "there is no joint 'rol'"),
        ("foot_at_m: [-0.05, -0.03", "foot_at_m: [-0.05, 0.03", "can hardly move its joints apart"),
        ("crank_m: 0.05", "crank_m: 0", "crank_m"),
        ("type: rods", "type: rod", "rod"),
    ],
)
def test_a_linkage_that_cannot_be_is_refused(tmp_path, old, new, said):
    assert old in FOOT
    with pytest.raises(ConfigError) as caught:
        foot(tmp_path, FOOT.replace(old, new))
    assert said in str(caught.value)


def test_belts_want_a_figure_for_each_joint_of_each_motor_and_a_joint_is_in_one_linkage(tmp_path):
    head, _ = FOOT.split("linkages:")
    text = head + "linkages:\n  a: {type: belts, joints: [pitch, roll], turns: [[1, 0], [0.5]]}\n"
    with pytest.raises(ConfigError, match="write 2 rows of as many figures"):
        foot(tmp_path, text)
    twice = text.replace("[0.5]", "[0.5, 1]")
    twice += "  b: {type: belts, joints: [roll, toe], turns: [[1, 0], [0, 1]]}\n"
    with pytest.raises(ConfigError, match="roll is in the linkage 'a' already"):
        foot(tmp_path, twice)
    with pytest.raises(ConfigError, match="pitch is in the linkage 'a' already"):
        foot(tmp_path, text.replace("[0.5]", "[0.5, 1]").replace("[pitch, roll]", "[pitch, pitch]"))


def test_a_crank_that_is_in_line_or_turns_about_the_rods_end_is_no_number_but_refused(tmp_path):
    for end in ("[0, 0.03, 0.2]", "[0.05, 0.03, 0.0]"):
        with pytest.raises(ConfigError, match=r"a rod does not reach|can hardly move"):
            foot(tmp_path, FOOT.replace("foot_at_m: [-0.05, 0.03, -0.02]", f"foot_at_m: {end}"))


# --- torque and work -----------------------------------------------------------------------------


def state(joints: DriveMap, draw: np.random.Generator):
    """Joints within their limits, and their motors there, through a linkage and gears."""
    motors = joints.joints.values()
    q = np.array([draw.uniform(one.lower_rad, one.upper_rad) for one in motors])
    qd, tau = draw.uniform(-2, 2, (2, len(q)))
    transmission = Transmission(joints)
    linkage = joints.linkages["ankle"]
    cranks, jacobian = linkage.at(q[:2])
    at = np.concatenate((cranks, q[2:]))
    speeds = np.concatenate((jacobian @ qd[:2], qd[2:]))
    forces = np.concatenate((np.linalg.solve(jacobian.T, tau[:2]), tau[2:]))
    gearing = transmission.gearing
    told = gearing.motor_q(at), gearing.motor_qd(speeds), gearing.motor_tau(forces)
    return transmission, (q, qd, tau), told


def test_angles_speeds_and_torques_of_joints_are_found_from_those_of_motors(joints):
    draw = np.random.default_rng(1)
    for _ in range(50):
        transmission, wanted, told = state(joints, draw)
        for found, expected in zip(transmission.at_joints(*told), wanted, strict=True):
            np.testing.assert_allclose(found, expected, atol=1e-7)
        power = told[1] @ told[2]
        assert power == pytest.approx(wanted[1] @ wanted[2])  # nothing is lost in a linkage


def command(draw: np.random.Generator, count: int) -> MotorCommand:
    return MotorCommand(
        1.0, draw.uniform(-0.3, 0.3, count), draw.uniform(-1, 1, count), draw.uniform(-3, 3, count),
        draw.uniform(5, 60, count), draw.uniform(0.1, 2, count),
    )  # fmt: skip


def test_motors_together_give_the_law_of_the_joints_at_that_moment(joints):
    draw = np.random.default_rng(2)
    for _ in range(50):
        transmission, _, told = state(joints, draw)
        q, qd, _ = transmission.at_joints(*told)
        asked = command(draw, 3)
        sent = transmission.at_motors(asked, q, qd)
        given = sent.kp * (sent.q - told[0]) + sent.kd * (sent.qd - told[1]) + sent.tau
        _, _, tau = transmission.at_joints(told[0], told[1], given)
        law = asked.kp * (asked.q_des - q) + asked.kd * (asked.qd_des - qd) + asked.tau_ff
        np.testing.assert_allclose(tau, law, atol=1e-6)
        assert (sent.kp >= 0.0).all()
        said = transmission.said(asked, sent, q, qd)
        again = said.kp * (said.q_des - q) + said.kd * (said.qd_des - qd) + said.tau_ff
        np.testing.assert_allclose(again, law, atol=1e-6)


def test_where_a_motor_cannot_give_so_much_all_of_its_linkage_give_less_alike(joints):
    draw = np.random.default_rng(3)
    for _ in range(50):
        transmission, _, told = state(joints, draw)
        transmission.most_nm = np.array([4.0, 4.0, 100.0])
        q, qd, _ = transmission.at_joints(*told)
        asked = command(draw, 3)
        asked.tau_ff[:2] *= 10.0
        sent = transmission.at_motors(asked, q, qd)
        given = sent.kp * (sent.q - told[0]) + sent.kd * (sent.qd - told[1]) + sent.tau
        at_cranks = transmission.gearing.joint_tau(given)
        assert (np.abs(at_cranks[:2]) <= 4.0 + 1e-9).all()
        _, _, tau = transmission.at_joints(told[0], told[1], given)
        law = asked.kp * (asked.q_des - q) + asked.kd * (asked.qd_des - qd) + asked.tau_ff
        shares = tau[:2] / law[:2]
        assert shares[0] == pytest.approx(shares[1], rel=1e-6)
        assert 0.0 < shares[0] <= 1.0 + 1e-9
        assert tau[2] == pytest.approx(law[2])


def test_what_cranks_have_to_give_is_told_by_the_worst_angles(joints):
    wants = needed(joints.linkages, joints.joints)
    assert wants["toe"].torque_nm == 5.0
    _, jacobian = ANKLE.at(np.zeros(2))
    # both pull for pitch, each the half of 40; for roll each 20 / (2 * 0.6)
    assert np.linalg.inv(jacobian).T[0, 0] * 40 == pytest.approx(20.0)
    assert wants["pitch"].torque_nm > 19.9
    assert wants["roll"].velocity_rad_s >= 8.0


# --- the drivers ---------------------------------------------------------------------------------

STRONG = "ranges: {position_rad: 12.5, velocity_rad_s: 40, torque_nm: 60}"
AnyRig: TypeAlias = ethernet_rig.Rig | can_rig.Rig
CAN_FOOT = (
    FOOT.replace("boards:", "buses:").replace("address: 10.0.7.11, number: 1", "channel: can0")
    .replace("board: shank", "bus: shank")
    .replace("ANKLE, id: 0", "DM8009, id: 3").replace("ANKLE, id: 1", "DM8009, id: 1")
    .replace("TOE, id: 2", "DM4310, id: 2")
)  # fmt: skip
MOTEUS_FOOT = (
    CAN_FOOT.replace("can0}", "can0, data_bitrate_hz: 5000000}")
    .replace("model: DM8009", f"model: moteus-x1, {STRONG}")
    .replace("model: DM4310", f"model: moteus-x1, {STRONG}")
)
ROBSTRIDE_FOOT = (
    CAN_FOOT.replace("DM8009", "RS03").replace("DM4310", "RS00").replace("rad_s: 8", "rad_s: 5")
)
CAN_FEET = {"damiao": CAN_FOOT, "robstride": ROBSTRIDE_FOOT, "moteus": MOTEUS_FOOT}


def can_foot(folder, text: str = CAN_FOOT) -> JointMap:
    return can_rig.arm(folder, text)


@pytest.fixture(params=["ethernet", *CAN_FEET])
def rig(request, tmp_path) -> AnyRig:
    if request.param == "ethernet":
        made: AnyRig = ethernet_rig.Rig(foot(tmp_path), is_still=True)
    else:
        made = can_rig.Rig(can_foot(tmp_path, CAN_FEET[request.param]))
    for name in made.joints.joints:
        shaft = motors_of(made)[name].shaft
        shaft._spring_nm_rad = shaft.qd_rad_s = 0.0
    return made


def test_two_motors_bring_both_joints_where_they_are_sent(rig):
    with rig.driver as driver:
        state = rig.cycle(1500, q=0.25, kp=40.0, kd=2.0)
        np.testing.assert_allclose(state.q, 0.25, atol=0.002)
        assert not driver.alarms.on
        cranks, _ = rig.joints.linkages["ankle"].at(np.array([0.25, 0.25]))
        pitch, roll = (motors_of(rig)[name].shaft.q_rad for name in ("pitch", "roll"))
        assert pitch == pytest.approx(-2.0 * (cranks[0] - 0.2), abs=0.01)
        assert roll == pytest.approx(1.5 * cranks[1], abs=0.01)


def test_what_it_says_was_sent_is_the_law_of_the_joints_by_what_the_motors_obey(rig):
    with rig.driver as driver:
        state = rig.cycle(200, q=0.1, kp=20.0, kd=1.0)
        asked = rig.hold(0.105, kp=20.0, kd=1.0)
        said = driver.write(asked)
        law = said.kp * (said.q_des - state.q) + said.kd * (said.qd_des - state.qd) + said.tau_ff
        wanted = asked.kp * (asked.q_des - state.q) - asked.kd * state.qd
        np.testing.assert_allclose(law, wanted, atol=0.25)
        np.testing.assert_allclose(said.q_des[:2], asked.q_des[:2])
        driver.read()


def test_a_reading_tells_joints_and_a_program_can_have_it(rig):
    if isinstance(rig, ethernet_rig.Rig):
        with DirectPorts(rig.bench, rig.clock) as ports:
            rows = ethernet_tools.readings(ports, rig.clock, rig.joints)
    else:
        with direct.DirectPorts(rig.bench, rig.clock) as ports:
            rows = can_tools.readings(ports, rig.clock, rig.joints)
    told = {row["joint"]: row for row in msgspec.json.decode(msgspec.json.encode(rows))}
    assert told["pitch"]["q_rad"] == pytest.approx(-0.1, abs=2e-3)
    assert told["roll"]["q_rad"] == pytest.approx(0.0, abs=2e-3)
    assert told["toe"]["q_rad"] == pytest.approx(0.05, abs=2e-3)
    assert told["toe"]["supply_v"] is not None


def test_a_crank_that_slipped_is_seen_where_no_joints_can_be(rig):
    with rig.driver as driver:
        rig.cycle(50, q=0.0, kp=5.0)
        shaft = motors_of(rig)["pitch"].shaft
        shaft.q_rad += 4.0
        shaft._gained = 1e-9
        rig.cycle(20, q=0.0, kp=5.0)
        assert ("linkage", "ankle") in {(one.code, one.who) for one in driver.alarms.on}
        assert np.isfinite(rig.cycle(1, q=0.0, kp=5.0).q).all()


def test_a_linkage_whose_motors_stand_where_no_joints_are_is_not_enabled(rig):
    if isinstance(rig, ethernet_rig.Rig):
        rig.drive("pitch").zero_rad = 4.0
    else:
        motors_of(rig)["pitch"].shaft.q_rad += 4.0
    with pytest.raises(DriverError, match="its linkage does not fit"), rig.driver:
        pass


def test_a_driver_knows_what_its_motors_give_at_their_cranks(rig):
    with rig.driver as driver:
        gives = {name: one.gear for name, one in rig.joints.joints.items()}
        for name, gear in gives.items():
            motor = motors_of(rig)[name]
            most = motor.torque_nm if isinstance(rig, can_rig.Rig) else motor.kind.torque_nm
            gives[name] = gear * most
        np.testing.assert_allclose(driver._transmission.most_nm, [*gives.values()], rtol=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("gear: 1.5", "gear: 0.3", "at its crank in the linkage 'ankle'.*N m at most"),
        ("rod_m: 0.30", "rod_m: 0.20", "a rod does not reach"),
        ("joints: [pitch, roll]", "joints: [pitch, rol]", "there is no joint 'rol'"),
        ("lower_rad: -0.9, upper_rad: 0.7", "lower_rad: 0.9, upper_rad: 0.7", "not below upper"),
    ],
)
def test_on_can_what_its_motors_cannot_do_at_their_cranks_is_refused(tmp_path, old, new, said):
    assert old in CAN_FOOT
    with pytest.raises(ConfigError, match=said):
        can_foot(tmp_path, CAN_FOOT.replace(old, new))


def test_what_a_motor_has_to_do_is_that_of_its_crank(joints):
    found = at_cranks(joints.linkages, joints.joints)
    assert found["toe"] == joints.joints["toe"]
    for angles in np.random.default_rng(5).uniform((-0.9, -0.4), (0.7, 0.4), (200, 2)):
        stand, _ = ANKLE.at(angles)
        for crank, name in zip(stand, ("pitch", "roll"), strict=True):
            assert found[name].lower_rad - 0.02 <= crank <= found[name].upper_rad + 0.02


def test_a_motor_too_weak_for_its_crank_is_named(joints):
    rig = ethernet_rig.Rig(joints, roll="weak")
    with pytest.raises(
        DriverError, match=r"roll: its drive does .* N m at the joint, the map says"
    ):
        rig.driver.__enter__()


def test_one_joint_of_a_linkage_is_not_moved_alone(joints):
    with pytest.raises(ConfigError, match="pitch is in the linkage 'ankle': one motor alone moves"):
        motor_bench.only(joints, "pitch")
    assert [*motor_bench.only(joints, "toe").joints] == ["toe"]
    alone = msgspec.structs.replace(joints, joints={"toe": joints.joints["toe"]})
    q, _, _ = Transmission(alone).at_joints(np.array([0.3]), np.zeros(1), np.zeros(1))
    assert q.tolist() == [0.3]
