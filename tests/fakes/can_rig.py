"""A driver of CAN motors on emulated wires, in simulated time."""

import math
from pathlib import Path

import msgspec
import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.families import FAMILIES
from robot.drivers.motors.can.joint_map import Bus, JointMap, JointMotor, MotorRanges
from robot.drivers.motors.can.models import MODELS
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.devices.bench import Bench, build
from sim.devices.can_motor import Flaw
from sim.devices.damiao import Damiao
from sim.devices.direct import DirectPorts
from tests.fakes.motor_rig import MotorRig, felt, lines_of_its_own

ARM = """\
rate_hz: 500
buses:
  arm: {channel: can0}
joints:
  shoulder: {bus: arm, model: DM8009, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {bus: arm, model: DM4340, id: 2, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 40}
  wrist: {bus: arm, model: DM4310, id: 3, lower_rad: -1.0, upper_rad: 1.0, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501
ROBSTRIDES = """\
rate_hz: 500
buses:
  arm: {channel: can0}
joints:
  shoulder: {bus: arm, model: RS04, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {bus: arm, model: RS02, id: 2, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 30}
  wrist: {bus: arm, model: RS00, id: 3, lower_rad: -1.0, upper_rad: 1.4, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501
ROBSTRIDES_AND_A_DAMIAO = ROBSTRIDES.replace("model: RS02, id: 2", "model: DM4340, id: 1")
MOTEUS = """\
rate_hz: 500
buses:
  arm: {channel: can0, data_bitrate_hz: 5000000}
joints:
  shoulder: {bus: arm, model: moteus-x1, ranges: {position_rad: 12.5, velocity_rad_s: 30, torque_nm: 60}, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {bus: arm, model: moteus-n1, ranges: {position_rad: 20, velocity_rad_s: 40, torque_nm: 20}, id: 12, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 30}
  wrist: {bus: arm, model: qdd100, id: 3, lower_rad: -1.0, upper_rad: 1.4, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501
_ELBOW = "bus: arm, model: moteus-n1, ranges: {position_rad: 20, velocity_rad_s: 40, torque_nm: 20}"
MOTEUS_AND_A_DAMIAO = MOTEUS.replace("joints:", "  old: {channel: can1}\njoints:").replace(
    f"{_ELBOW}, id: 12", "bus: old, model: DM4340, id: 1"
)


def arm(folder: Path, text: str = ARM) -> JointMap:
    """The map of a small arm."""
    path = folder / "can.yaml"
    path.write_text(text)
    return joint_map.load(path)


def limbs(buses: int, joints: int, *, rate_hz: int = 500, model: str = "DM8009") -> JointMap:
    """So many buses with so many joints each; controllers without a motor move one of 60 N m."""
    model_ = MODELS[model]
    fd = 5_000_000 if FAMILIES[model_.family].fd else 0
    ranges = (
        MotorRanges(position_rad=12.5, velocity_rad_s=30.0, torque_nm=60.0)
        if math.isnan(model_.torque_nm)
        else None
    )
    return JointMap(
        rate_hz=rate_hz,
        buses={f"bus{b}": Bus(channel=f"can{b}", data_bitrate_hz=fd) for b in range(buses)},
        joints={
            f"joint{b}_{j}": JointMotor(
                bus=f"bus{b}", model=model, id=j + 1, ranges=ranges, lower_rad=-2.0, upper_rad=2.0,
                velocity_limit_rad_s=20.0, torque_limit_nm=40.0,
            )
            for b in range(buses)
            for j in range(joints)
        },
    )  # fmt: skip


def with_channels_of_its_own(joints: JointMap) -> JointMap:
    """A map whose buses no other test claims."""
    return msgspec.structs.replace(joints, buses=lines_of_its_own(joints.buses, "channel"))


class Rig(MotorRig):
    """A driver, its motors, and a clock."""

    def __init__(self, joints: JointMap, **flaws: Flaw) -> None:
        self.joints = joints = with_channels_of_its_own(joints)
        self.clock = SimulatedClock(100.0)
        self.bench: Bench = build(joints, now_s=100.0, flaws=flaws)
        self.ports: list[DirectPorts] = []
        self.driver = self.another()

    def another(self) -> CanMotors:
        """One more driver of the same motors."""

        def ports() -> DirectPorts:
            self.ports.append(DirectPorts(self.bench, self.clock))
            return self.ports[-1]

        return CanMotors(self.joints, self.clock, ports=ports)

    def motor(self, name: str) -> Damiao:
        """The emulated Damiao of a joint."""
        found = self.bench.motors[name]
        assert isinstance(found, Damiao)
        return found


def killed(rig: Rig) -> None:
    """What the system does to a process that is killed: its claim is free, nothing is said."""
    rig.driver._is_armed = False
    rig.driver._claim.release()


def can_map(robot: RobotDescription, *, a_bus: int = 5) -> JointMap:
    """A map that drives a robot's joints with large motors, five a bus."""
    motors = robot.motors.items()
    return JointMap(
        rate_hz=500,
        buses={f"bus{b}": Bus(channel=f"can{b}") for b in range(-(-len(motors) // a_bus))},
        joints={
            name: JointMotor(
                bus=f"bus{index // a_bus}", model="DM10010L", id=index % a_bus + 1, lower_rad=-3.0,
                upper_rad=3.0, velocity_limit_rad_s=min(25.0, motor.velocity_limit_rad_s),
                torque_limit_nm=motor.torque_limit_nm,
            )
            for index, (name, motor) in enumerate(motors)
        },
    )  # fmt: skip


class CanPlant:
    """What the motors of a rig measure and obey, as a plant tells it; their shafts are at rest."""

    def __init__(self, rig: Rig, drivers: tuple[CanMotors, CanMotors]) -> None:
        self.drivers = drivers
        self._rig = rig
        for motor in rig.bench.devices:
            motor.shaft.qd_rad_s = 0.0

    @property
    def q(self) -> Array:
        motors = self._rig.joints.joints.items()
        return np.array([o.joint_rad(self._rig.motor(name).shaft.q_rad) for name, o in motors])

    @property
    def commands(self) -> list[MotorCommand]:
        """The one in force; a stamp is in no frame."""
        sent = [driver._sent for driver in self.drivers if driver._sent is not None]
        orders = [motor._ordered for motor in self._rig.bench.motors.values()]
        names = ("q_rad", "qd_rad_s", "tau_nm", "kp", "kd")
        rows = [np.array([getattr(order, name) for order in orders]) for name in names]
        return [MotorCommand(max(one.stamp_s for one in sent), *rows)] if sent else []

    def read(self) -> BodySample:
        devices = self._rig.bench.devices
        return felt(
            self.q,
            [motor.shaft.qd_rad_s for motor in devices],
            [motor.tau_nm for motor in devices],
            now_s=self._rig.clock.now_s(),
            let_go=any(motor.status != 1 for motor in devices),
            told_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )
