"""A driver of hobby servos on emulated chips, in simulated time."""

from pathlib import Path

import msgspec
import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.pwm import joint_map
from robot.drivers.motors.pwm.driver import PwmMotors
from robot.drivers.motors.pwm.joint_map import Chip, JointPulse, PulseMap
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.devices.hobby_servo import HobbyServo
from sim.devices.pwm_bench import DirectChips, Flaw, build
from tests.fakes.motor_rig import MotorRig, felt, lines_of_its_own

HEAD = """\
chips:
  hat: {bus: 1, address: 64}
joints:
  yaw: {chip: hat, model: MG996R, id: 0, pulse_us: [500, 2500], travel_rad: 3.1416, lower_rad: -1.4, upper_rad: 1.4, velocity_limit_rad_s: 4, torque_limit_nm: 0.9}
  pitch: {chip: hat, model: MG996R, id: 3, sign: -1, offset_rad: 0.2, pulse_us: [600, 2400], travel_rad: 2.8, lower_rad: -0.7, upper_rad: 1.1, velocity_limit_rad_s: 4, torque_limit_nm: 0.9}
  jaw: {chip: hat, model: SG90, id: 15, gear: 2.0, travel_rad: 1.5708, lower_rad: 0.0, upper_rad: 0.35, velocity_limit_rad_s: 3, torque_limit_nm: 0.2, start_rad: 0.1}
"""  # noqa: E501


def head(folder: Path, text: str = HEAD) -> PulseMap:
    """The map of a small head."""
    path = folder / "pwm.yaml"
    path.write_text(text)
    return joint_map.load(path)


def pulse_map(robot: RobotDescription) -> PulseMap:
    """A map that drives a robot's joints, sixteen a chip; no such robot would stand."""
    names = list(robot.motors)
    return PulseMap(
        chips={f"chip{c}": Chip(address=0x40 + c) for c in range(-(-len(names) // 16))},
        joints={
            name: JointPulse(
                chip=f"chip{index // 16}", model="MG996R", id=index % 16, pulse_us=(500.0, 2500.0),
                travel_rad=6.2, lower_rad=-3.0, upper_rad=3.0, velocity_limit_rad_s=200.0,
                torque_limit_nm=1.0,
            )
            for index, name in enumerate(names)
        },
    )  # fmt: skip


class Rig(MotorRig):
    """A driver, its servos, and a clock."""

    def __init__(self, joints: PulseMap, **flaws: Flaw) -> None:
        self.joints = joints
        claimed = lines_of_its_own(joints.chips, "emulated")
        self._claimed = msgspec.structs.replace(joints, chips=claimed)
        self.clock = SimulatedClock(100.0)
        self.bench = build(joints, now_s=100.0, flaws=flaws)
        self.chips: list[DirectChips] = []
        self.lines: list[str] = []
        self.driver = self.another()

    def another(self) -> PwmMotors:
        """One more driver of the same servos."""

        def chips() -> DirectChips:
            self.chips.append(DirectChips(self.joints, self.bench, self.clock))
            return self.chips[-1]

        return PwmMotors(self._claimed, self.clock, ports=chips, tell=self.lines.append)

    def servo(self, name: str) -> HobbyServo:
        """The emulated servo of a joint."""
        return self.bench.servos[name]

    def let_pass(self, span_s: float) -> None:
        """Nobody says a word."""
        self.clock.sleep_until(self.clock.now_s() + span_s)
        for chips in self.chips:
            chips.tell()


class PwmPlant:
    """What the chips of a rig output, as a plant tells it: servos stand where they are sent."""

    def __init__(self, rig: Rig, drivers: tuple[PwmMotors, PwmMotors]) -> None:
        self.drivers = drivers
        self._rig = rig

    def _sent(self, name: str) -> float | None:
        joint, rig = self._rig.joints.joints[name], self._rig
        pulse_s = rig.bench.chips[joint.chip].pulse_s(joint.id, rig.clock.now_s())
        return None if pulse_s is None else joint.at_rad(pulse_s)

    @property
    def q(self) -> Array:
        joints = self._rig.joints.joints
        sent = {name: self._sent(name) for name in joints}
        return np.array([joints[n].start_rad if q is None else q for n, q in sent.items()])

    def play(self) -> None:
        """Let a frame go by."""
        self._rig.let_pass(0.025)

    @property
    def commands(self) -> list[MotorCommand]:
        """The one in force: where pulses send joints; without one only their gears brake."""
        told = [driver._sent for driver in self.drivers if driver._sent is not None]
        sent = [self._sent(name) for name in self._rig.joints.joints]
        zero = np.zeros(len(sent))
        q = np.array([0.0 if one is None else one for one in sent])
        kd = np.array([1.0 if one is None else 0.0 for one in sent])
        stamp_s = max((one.stamp_s for one in told), default=0.0)
        return [MotorCommand(stamp_s, q, zero, zero, zero, kd)] if told else []

    def read(self) -> BodySample:
        count = len(self._rig.joints.joints)
        sample = felt(
            self.q, [0.0] * count, [0.0] * count, now_s=self._rig.clock.now_s(),
            let_go=not any(driver._is_armed for driver in self.drivers),
            told_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )  # fmt: skip
        sample.motors.age_s = np.full(count, np.inf)
        return sample
