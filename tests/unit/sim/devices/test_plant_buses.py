"""Real frames over emulated buses turn the joints of the simulated body."""

import msgspec
import numpy as np
import pytest

from robot.control.loop import ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors import motor_map
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.driver import FAMILY
from robot.drivers.motors.can.joint_map import MotorRanges
from robot.errors import ConfigError, DriverError
from robot.messages import Walk
from robot.model import description
from sim import plant_buses, world
from sim.plant import Plant
from sim.simulation import Simulation
from tests.fakes.ankles import ANKLES
from tests.fakes.can_lockstep import Lockstep


@pytest.fixture(scope="module")
def robot():
    return description.load("juno").driven_by("can")


@pytest.fixture
def rig(robot, tmp_path):
    """Juno's map, some of its motors mounted the other way round, behind belts, off by an angle."""
    found = FAMILY.beside(robot)
    other = {
        "left_elbow": {"sign": -1, "offset_rad": 0.4},
        "right_elbow": {"gear": 1.5, "offset_rad": -0.2, "velocity_limit_rad_s": 6.0},
        "head_yaw": {"sign": -1, "gear": 2.0},
    }
    joints = {
        name: msgspec.structs.replace(one, **other.get(name, {}))
        for name, one in found.joints.items()
    }
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return Lockstep(plant, msgspec.structs.replace(found, joints=joints), tmp_path)


@pytest.fixture
def rig_on_robstrides(robot, tmp_path):
    """Juno's legs on RobStrides, the rest on Damiaos as proposed."""
    found = FAMILY.beside(robot)
    legs = {"DM10010L": ("RS04", 15.0, 120.0), "DM8009": ("RS03", 20.0, 60.0)}
    joints: dict[str, joint_map.JointMotor] = {}
    for name, one in found.joints.items():
        joints[name] = one
        if one.bus in {"left_leg", "right_leg", "feet"}:
            model, rad_s, nm = legs[one.model]
            joints[name] = msgspec.structs.replace(
                one,
                model=model,
                velocity_limit_rad_s=min(rad_s, one.velocity_limit_rad_s),
                torque_limit_nm=min(nm, one.torque_limit_nm),
            )
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return Lockstep(plant, msgspec.structs.replace(found, joints=joints), tmp_path)


@pytest.fixture
def rig_on_moteus(robot, tmp_path):
    """Juno's legs on moteus over CAN FD, the rest on Damiaos as proposed."""
    found = FAMILY.beside(robot)
    legs = {"left_leg", "right_leg", "feet"}
    output = MotorRanges(position_rad=12.5, velocity_rad_s=25.0, torque_nm=140.0)
    joints = {
        name: msgspec.structs.replace(one, model="moteus-x1", ranges=output)
        if one.bus in legs
        else one
        for name, one in found.joints.items()
    }
    buses = {
        name: msgspec.structs.replace(bus, data_bitrate_hz=5_000_000) if name in legs else bus
        for name, bus in found.buses.items()
    }
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return Lockstep(plant, msgspec.structs.replace(found, buses=buses, joints=joints), tmp_path)


def holding(robot, now_s: float) -> MotorCommand:
    motors = list(robot.motors.values())
    q, zero = np.array(robot.posture("nominal")), np.zeros(len(motors))
    kp, kd = (np.array([getattr(one, key) for one in motors]) for key in ("kp", "kd"))
    return MotorCommand(now_s, q, zero, zero, kp, np.minimum(kd, 5.0))


def test_the_body_is_held_up_until_a_motor_is_told_to_give_torque(robot, rig):
    height_m = rig.plant.where(robot.base_body).p[2]
    with rig.driver() as driver:
        for _ in range(50):
            driver.read()
        assert rig.plant.time_s > 0.1
        assert rig.plant.where(robot.base_body).p[2] == height_m
        driver.write(holding(robot, rig.now_s()))
        driver.read()
        driver.read()
        assert rig.plant.data.time == pytest.approx(0.004)


def test_what_motors_tell_is_where_the_joints_are(robot, rig):
    """Through signs, gears and offsets, and steps as on the wire."""
    with rig.driver() as driver:
        for _ in range(100):
            driver.write(holding(robot, rig.now_s()))
            state = driver.read()
        truth = rig.plant.read().motors
        one_step = 25.0 / 65535 / np.abs(driver._transmission.gearing.turns)
        moved = np.abs(truth.qd) * 0.002
        assert (np.abs(state.q - truth.q) <= one_step + moved + 1e-4).all()
        heavy = np.abs(truth.tau) > 5.0
        assert heavy.sum() >= 4
        np.testing.assert_allclose(state.tau[heavy], truth.tau[heavy], rtol=0.1, atol=0.5)
        assert driver.reception.lost == 0
        assert (state.age_s < 0.002 + 1e-9).all()


def test_joints_obey_the_gains_of_a_command(robot, rig):
    index = robot.motor_names.index("left_elbow")
    with rig.driver() as driver:
        for k in range(300):
            command = holding(robot, rig.now_s())
            command.q_des = command.q_des.copy()
            command.q_des[index] -= min(0.3, 0.002 * k)
            driver.write(command)
            state = driver.read()
        applied = rig.plant.data.ctrl[index] + rig.plant.model.actuator_biasprm[index, 1:3] @ (
            truth := np.array((state.q[index], state.qd[index]))
        )
        wanted = (
            command.kp[index] * (command.q_des[index] - truth[0]) - command.kd[index] * truth[1]
        )
        assert applied == pytest.approx(wanted, abs=0.15)
        assert state.q[index] == pytest.approx(command.q_des[index], abs=0.1)


def test_without_commands_motors_let_go_by_their_own_watchdogs(robot, rig):
    with rig.driver() as driver:
        for _ in range(50):
            driver.write(holding(robot, rig.now_s()))
            driver.read()
        stopped_s = rig.now_s()
        rig.sleep_until(stopped_s + 0.018)
        assert {motor.status for motor in rig.buses.motors} == {1}
        rig.sleep_until(stopped_s + 0.026)
        assert {motor.status for motor in rig.buses.motors} == {0xD}
        assert not rig.plant.model.actuator_biasprm[:, 1:3].any()
        assert not rig.plant.data.ctrl.any()
        driver._is_armed = False  # it was killed


@pytest.mark.parametrize("motors", ["rig", "rig_on_robstrides", "rig_on_moteus"])
def test_the_controller_walks_by_frames_alone(robot, motors: str, request):
    rig = request.getfixturevalue(motors)
    loop = ControlLoop(robot)
    lines: list[str] = []
    with rig.driver(lines.append) as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        assert loop.mode == "walk"
        assert driver.reception.lost == 0
        assert not driver.alarms.on
    assert rig.plant.where(robot.base_body).p[0] > 0.05
    assert lines == [
        "CAN: 33 joints, 899 periods at 500 Hz, 0 replies late (0.000%), 0 periods late"
    ]


@pytest.mark.parametrize("after_s", [0.002, pytest.param(0.008, marks=pytest.mark.rest)])
def test_a_spare_holds_up_a_robot_whose_controller_was_killed_in_mid_step(robot, rig, after_s):
    def play(driver, loop, periods: int) -> None:
        for _ in range(periods):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))

    loop, spare_loop, lines = ControlLoop(robot), ControlLoop(robot), list[str]()
    first = rig.driver().__enter__()
    play(first, loop, 20)
    with rig.driver(lines.append) as spare:
        play(first, loop, 130)
        loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        play(first, loop, 500)
        assert loop.mode == "walk"
        first._is_armed = False  # it is killed, and its sockets close
        first.close()
        died_s = rig.now_s()
        rig.sleep_until(died_s + after_s)  # before the spare notices
        assert spare.claim()
        spare_loop.recall(loop.state())
        play(spare, spare_loop, 1)
        assert rig.now_s() - died_s <= after_s + 0.004
        play(spare, spare_loop, 600)
        assert spare_loop.mode == "stand"
        assert rig.plant.where(robot.base_body).p[2] > 0.55  # it stands at 0.587 m
        assert {motor.status for motor in rig.buses.motors} == {1}
        assert {motor.registers[9] for motor in rig.buses.motors} == {400}
    assert lines[0] == "the motors were left enabled: they are commanded as they are"


def test_a_bus_that_is_unplugged_is_named_within_a_period_and_the_others_go_on(robot, rig):
    def unplug(*buses: str) -> None:
        server, wires = rig.buses._server, list(rig.buses._server._wires)
        lost = [wires[list(rig.joints.buses).index(bus)] for bus in buses]
        for fd, program in list(server._programs.items()):
            if program.wire in lost:
                server._forget(fd)

    bus = rig.joints.joints["left_elbow"].bus
    there = np.array([one.bus != bus for one in rig.joints.joints.values()])
    with rig.driver() as driver:
        for _ in range(50):
            driver.write(holding(robot, rig.now_s()))
            driver.read()
        unplug(bus)
        driver.write(holding(robot, rig.now_s()))
        state = driver.read()
        (alarm,) = state.alarms
        assert (alarm.code, alarm.who, alarm.level) == ("unplugged", bus, "SIT")
        assert "went away" in alarm.cause or "does not send" in alarm.cause
        for _ in range(20):
            driver.write(holding(robot, rig.now_s()))
            state = driver.read()
        assert (state.age_s[there] < 0.002 + 1e-9).all()
        assert (state.age_s[~there] > 0.03).all()
        statuses = np.array([motor.status for motor in rig.buses.motors])
        assert (statuses[there] == 1).all()
        assert (statuses[~there] == 0xD).all()  # by their own watchdogs
        unplug(*rig.joints.buses)
        with pytest.raises(DriverError, match=r"went away|does not send"):
            for _ in range(2):
                driver.write(holding(robot, rig.now_s()))
                driver.read()
    assert not driver._claim.is_held


def test_buses_whose_motors_were_never_enabled_say_so_at_the_end(rig):
    rig.sleep_until(rig.now_s() + 0.01)
    rig.buses.close()
    assert rig.lines == ["emulated CAN: no motor was ever enabled"]


def test_a_second_program_asks_for_nothing_while_the_first_commands(robot, rig):
    """As a spare controller does: its questions would take the place of commands."""
    with rig.driver() as first:
        for _ in range(20):
            first.write(holding(robot, rig.now_s()))
            first.read()
        ignored = first.reception.ignored
        play = rig.sleep_until

        def commanded(time_s: float) -> None:
            """The first goes on with its periods while the second waits."""
            while rig.plant.time_s < time_s - 1e-6:
                for bus, frames in first._coding.commands(last)[0].items():
                    first._life.lines.send_packed(bus, frames)
                play(rig.plant.time_s + 0.002)

        last = np.zeros((5, 33))
        rig.sleep_until = commanded
        with rig.driver() as second:
            assert not second.claim()
            seen = second.read()
            assert (second.reception.misses == 0).all()
            assert second.reception.most_replies == 1
        rig.sleep_until = play
        first.read()
        assert first.reception.ignored == ignored
        np.testing.assert_allclose(seen.q, first.read().q, atol=0.2)


def test_what_nobody_emulates_is_refused(robot):
    found = FAMILY.beside(robot)
    old = MotorRanges(position_rad=12.5, velocity_rad_s=50.0, torque_nm=25.0)
    joints = {
        **found.joints,
        "head_yaw": msgspec.structs.replace(found.joints["head_yaw"], model="AK70-10", ranges=old),
    }
    with pytest.raises(ConfigError, match=r"head_yaw: a AK70-10 is not emulated"):
        plant_buses.check(msgspec.structs.replace(found, joints=joints))
    with pytest.raises(ConfigError, match="300 Hz are no whole milliseconds"):
        plant_buses.check(msgspec.structs.replace(found, rate_hz=300))


def test_reality_is_asked_what_it_emulates(robot, tmp_path):
    """One truth: what is no row of `sim.devices.can_motors` is refused before a robot starts."""
    for driver in ("can", "dynamixel", "simulated"):
        Simulation().check_motors(robot, driver)
    text = robot.path().with_name(joint_map.FILE).read_text()
    (line,) = [line for line in text.splitlines() if line.strip().startswith("head_yaw:")]
    model = line.split("model: ")[1].split(",")[0]
    ranges = "ranges: {position_rad: 12.5, velocity_rad_s: 50, torque_nm: 25}, "
    other = line.replace(f"model: {model},", f"model: AK70-10, {ranges}")
    (tmp_path / joint_map.FILE).write_text(text.replace(line, other))
    moved = msgspec.structs.replace(robot, folder=str(tmp_path))
    with pytest.raises(ConfigError, match=r"head_yaw: a AK70-10 is not emulated"):
        Simulation().check_motors(moved, "can")


def test_it_walks_on_can_with_ankles_of_two_rods_and_a_waist_of_a_differential(robot, tmp_path):
    path = tmp_path / "can.yaml"
    text = robot.path().with_name("can.yaml").read_text()
    text = text.replace("bus: feet, model: DM8009", "bus: feet, model: DM10010L")
    # Farther down these rods come near to a line with their cranks, and want 200 N m.
    text = text.replace("lower_rad: -1.2, upper_rad: 0.7", "lower_rad: -0.9, upper_rad: 0.7")
    path.write_text(text.replace("velocity_limit_rad_s: 12", "velocity_limit_rad_s: 11") + ANKLES)
    joints = motor_map.of_robot(joint_map.load(path), robot.motor_names)
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    rig = Lockstep(plant, joints, tmp_path)
    loop = ControlLoop(robot)
    with rig.driver() as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        truth = rig.plant.read().motors
        assert (np.abs(state.q - truth.q) <= 0.004 + 0.003 * np.abs(truth.qd)).all()
        assert loop.mode == "walk"
        assert not state.alarms
        assert driver.reception.lost == 0
    assert rig.plant.where(robot.base_body).p[0] > 0.05
