"""What identify finds of a hidden joint, what it refuses, and that its motor lets go afterwards."""

import shutil
import signal
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from robot.bringup import motor_identify
from robot.bringup.end_wish import EndWish
from robot.bringup.motor_identify import ROOM_RAD
from robot.clock import SimulatedClock
from robot.drivers.motors.dynamixel import joint_map as servo_map
from robot.errors import ConfigError, DriverError
from robot.model import description, identified
from sim import world
from sim.devices.direct import DirectPorts
from sim.devices.worn_shaft import WornShaft
from sim.plant import Plant
from tests.fakes.can_rig import ARM, MOTEUS, ROBSTRIDES, Rig, arm


class Ports(DirectPorts):
    """Ports on which something happens at the n-th look."""

    def __init__(self, rig: Rig) -> None:
        super().__init__(rig.bench, rig.clock)
        self.looks = 0
        self.happens: dict[int, Callable[[], None]] = {}
        self.always: Callable[[], None] = lambda: None

    def receive_packed(self):
        self.always()
        self.looks += 1
        self.happens.pop(self.looks, lambda: None)()
        return super().receive_packed()


class Bench:
    """An arm one of whose joints is worn, as nobody told this program."""

    def __init__(self, folder, text: str = ARM, *, at_rad: float = 0.6, **worn: float) -> None:
        self.rig = Rig(arm(folder, text))
        self.joint = self.rig.joints.joints["shoulder"]
        self.shaft = WornShaft(q_rad=self.joint.motor_rad(at_rad), **worn)
        for name, motor in self.rig.bench.motors.items():
            motor.shaft.qd_rad_s = 0.0
            if name == "shoulder":
                motor.shaft = self.shaft
        self.ports = Ports(self.rig)
        self.went: list[float] = []
        self.ports.always = lambda: self.went.append(
            self.shaft.q_rad - self.joint.motor_rad(at_rad)
        )

    def identify(self, torque_share: float = 0.3) -> motor_identify.Identified:
        with EndWish(self.rig.clock) as wish:
            return motor_identify.identify(
                self.rig.joints, "shoulder", self.rig.clock, torque_share=torque_share, wish=wish,
                opens=lambda _: self.ports,
            )  # fmt: skip

    def is_on(self) -> bool:
        self.rig.clock.sleep_until(self.rig.clock.now_s() + 0.3)
        self.rig.bench.advance(self.rig.clock.now_s())
        return self.rig.bench.motors["shoulder"].is_on


HIDDEN = {
    "light": {"inertia_kg_m2": 0.02, "worn_nm": 0.2, "viscous_nm_s": 0.1, "play_rad": 0.003,
              "late_s": 0.006},
    "heavy": {"inertia_kg_m2": 0.08, "worn_nm": 0.6, "viscous_nm_s": 0.4, "play_rad": 0.008,
              "late_s": 0.004, "spring_nm_rad": 3.0},
    "slow": {"inertia_kg_m2": 0.04, "worn_nm": 0.35, "viscous_nm_s": 0.0, "play_rad": 0.0045,
             "late_s": 0.009},
}  # fmt: skip


EACH = [("damiao", ARM), ("robstride", ROBSTRIDES), ("moteus", MOTEUS)]
SHOWN = {("damiao", "light"), ("robstride", "heavy"), ("moteus", "slow")}
PAIRS = [
    pytest.param(text, worn, id=f"{family}_{name}", marks=[] if shown else [pytest.mark.rest])
    for family, text in EACH
    for name, worn in HIDDEN.items()
    for shown in ((family, name) in SHOWN,)
]


@pytest.mark.parametrize(("text", "hidden"), PAIRS)
def test_a_hidden_joint_is_found_within_ten_per_cent(tmp_path, text: str, hidden):
    bench = Bench(tmp_path, text, **hidden)
    found = bench.identify()
    assert found.friction_nm == pytest.approx(hidden["worn_nm"], rel=0.1)
    assert found.delay_s == pytest.approx(hidden["late_s"], rel=0.1)
    assert found.backlash_rad == pytest.approx(hidden["play_rad"], rel=0.1)
    assert found.inertia_kg_m2 == pytest.approx(hidden["inertia_kg_m2"], rel=0.1)
    assert found.viscous_nm_s == pytest.approx(hidden["viscous_nm_s"], rel=0.1, abs=0.015)
    assert found.most_nm <= 1.2 * 0.3 * 30.0  # a motor that obeys late gives what was right before
    assert max(abs(q) for q in bench.went) < ROOM_RAD
    assert not bench.is_on()


def test_a_new_joint_has_no_play_and_no_delay_to_speak_of(tmp_path):
    found = Bench(tmp_path, inertia_kg_m2=0.03).identify()
    assert abs(found.backlash_rad) < 3e-4
    assert abs(found.delay_s) < 6e-4
    assert abs(found.friction_nm) < 0.03


@pytest.mark.parametrize("at_rad", [-1.4, 1.9])
def test_a_joint_near_its_limits_is_not_enabled(tmp_path, at_rad: float):
    bench = Bench(tmp_path, at_rad=at_rad)
    with pytest.raises(ConfigError, match=r"0\.25 rad to both its limits"):
        bench.identify()
    assert not bench.is_on()
    assert not bench.went or max(abs(q) for q in bench.went) < 1e-3


def test_it_lets_go_when_it_is_stopped(tmp_path):
    bench = Bench(tmp_path, worn_nm=0.2)
    bench.ports.happens[900] = lambda: signal.raise_signal(signal.SIGINT)
    with pytest.raises(DriverError, match="stopped on request"):
        bench.identify()
    assert not bench.is_on()


def test_it_lets_go_at_an_alarm(tmp_path):
    bench = Bench(tmp_path, worn_nm=0.2)
    motor = bench.rig.bench.motors["shoulder"]
    bench.ports.happens[900] = lambda: setattr(motor.trouble, "status", 0xA)
    with pytest.raises(DriverError, match="over current"):
        bench.identify()
    assert not bench.is_on()


def test_it_lets_go_when_somebody_pushes_the_joint_away(tmp_path):
    bench = Bench(tmp_path, worn_nm=0.2)
    bench.ports.happens[900] = lambda: setattr(bench.shaft, "qd_rad_s", 60.0)
    with pytest.raises(DriverError, match="rad away, and was let go"):
        bench.identify()
    assert not bench.is_on()


def test_a_joint_that_cannot_move_is_said_to_hardly_have(tmp_path):
    bench = Bench(tmp_path, worn_nm=1000.0)
    with pytest.raises(DriverError, match=r"hardly moved|too few angles"):
        bench.identify()
    assert not bench.is_on()


def test_a_servo_is_refused(tmp_path):
    servos = Path("robot/model/juno/dynamixel.yaml")
    joints = servo_map.load(servos)
    with EndWish(SimulatedClock(0.0)) as wish, pytest.raises(ConfigError, match="motors on CAN"):
        motor_identify.identify(
            joints, next(iter(joints.joints)), SimulatedClock(0.0), torque_share=0.3, wish=wish
        )


# --- and back: what simulation reads -----------------------------------------------------------


def test_what_is_found_is_what_a_simulated_joint_then_has(tmp_path):
    """Of one joint of a copy of Juno's folder; other joints are drawn as ever."""
    shutil.copytree("robot/model/juno", tmp_path / "juno")
    robot = description.load(str(tmp_path / "juno" / "juno.yaml"))
    drawn = Plant(world.load("empty"), robot, seed=3, reality="real")
    place = robot.motor_names.index("left_knee")
    found = identified.Joint(
        friction_nm=0.77, viscous_nm_s=0.21, delay_s=0.0123, backlash_rad=0.0044
    )
    identified.write(tmp_path / "juno" / identified.FILE, {"left_knee": found})
    identified.write(tmp_path / "juno" / identified.FILE, {"left_elbow": found})
    assert identified.beside(robot) == {"left_knee": found, "left_elbow": found}
    spoilt = Plant(world.load("empty"), robot, seed=3, reality="real")
    at = spoilt.motors.qd_index
    more_nm = spoilt.model.dof_frictionloss[at] - drawn.model.dof_frictionloss[at]
    ideal = Plant(world.load("empty"), robot, seed=3)
    own_nm = ideal.model.dof_frictionloss[at]
    assert spoilt.model.dof_frictionloss[at][place] - own_nm[place] == pytest.approx(0.77)
    assert spoilt.model.dof_damping[at][place] - ideal.model.dof_damping[at][place] == (
        pytest.approx(0.21)
    )
    others = [k for k, name in enumerate(robot.motor_names) if name not in identified.beside(robot)]
    np.testing.assert_array_equal(more_nm[others], 0.0)


def test_a_file_that_says_what_cannot_be_is_refused_with_its_line(tmp_path):
    path = tmp_path / identified.FILE
    path.write_text(
        "joints:\n  elbow: {friction_nm: -1, delay_s: 0.0, backlash_rad: 0.0, colour: red}\n"
    )
    with pytest.raises(ConfigError) as caught:
        identified.read(path)
    assert "friction_nm" in str(caught.value)
    assert "colour" in str(caught.value)
    with pytest.raises(ConfigError):
        identified.write(path, {})
