"""A driver of servos on emulated lines, in simulated time."""

from pathlib import Path

import msgspec
import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.dynamixel import joint_map
from robot.drivers.motors.dynamixel.driver import DynamixelMotors
from robot.drivers.motors.dynamixel.joint_map import JointServo, Port, ServoMap
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.devices.dynamixel import SPEED_RAD_S, Flaw, Servo
from sim.devices.servo_bench import DirectPorts, build
from tests.fakes.motor_rig import MotorRig, felt, lines_of_its_own

ARM = """\
rate_hz: 250
ports:
  arm: {device: /dev/ttyUSB0, baud_hz: 3000000}
joints:
  shoulder: {port: arm, model: XM540-W270, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 3, torque_limit_nm: 8}
  elbow: {port: arm, model: XM540-W150, id: 2, gear: 1.25, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 4, torque_limit_nm: 6}
  wrist: {port: arm, model: XM430-W350, id: 3, lower_rad: -1.0, upper_rad: 1.0, velocity_limit_rad_s: 4, torque_limit_nm: 3}
"""  # noqa: E501


def arm(folder: Path, text: str = ARM) -> ServoMap:
    """The map of a small arm."""
    path = folder / "dynamixel.yaml"
    path.write_text(text)
    return joint_map.load(path)


def with_devices_of_its_own(joints: ServoMap) -> ServoMap:
    """A map whose ports no other test claims."""
    return msgspec.structs.replace(joints, ports=lines_of_its_own(joints.ports, "device"))


class Rig(MotorRig):
    """A driver, its servos, and a clock."""

    KP, KD = 8.0, 0.5

    def __init__(self, joints: ServoMap, *, is_still: bool = False, **flaws: Flaw) -> None:
        self.joints = joints = with_devices_of_its_own(joints)
        self.clock = SimulatedClock(100.0)
        self.bench = build(joints, now_s=100.0, flaws=flaws, is_still=is_still)
        self.ports: list[DirectPorts] = []
        self.lines: list[str] = []
        self.driver = self.another()

    def another(self) -> DynamixelMotors:
        """One more driver of the same servos."""

        def ports() -> DirectPorts:
            self.ports.append(DirectPorts(self.bench, self.clock))
            return self.ports[-1]

        return DynamixelMotors(self.joints, self.clock, ports=ports, tell=self.lines.append)

    def servo(self, name: str) -> Servo:
        """The emulated servo of a joint."""
        return self.bench.servos[name]


def servo_map(robot: RobotDescription, *, a_port: int = 5) -> ServoMap:
    """A map that drives a robot's joints with large servos, five a port."""
    names = list(robot.motors)
    return ServoMap(
        rate_hz=500,
        ports={
            f"port{p}": Port(device=f"tty{p}", baud_hz=4_000_000)
            for p in range(-(-len(names) // a_port))
        },
        joints={
            name: JointServo(
                port=f"port{index // a_port}", model="XM540-W270", id=index % a_port + 1,
                lower_rad=-3.0, upper_rad=3.0, velocity_limit_rad_s=3.0, torque_limit_nm=10.0,
            )
            for index, name in enumerate(names)
        },
    )  # fmt: skip


class ServoPlant:
    """What the servos of a rig measure and obey, as a plant tells it; their shafts are at rest."""

    def __init__(self, rig: Rig, drivers: tuple[DynamixelMotors, DynamixelMotors]) -> None:
        self.drivers = drivers
        self._rig = rig
        for servo in rig.bench.servos.values():
            servo.shaft.qd_rad_s = 0.0
            servo.shaft._spring_nm_rad = 0.0

    @property
    def q(self) -> Array:
        joints = self._rig.joints.joints.items()
        return np.array([one.joint_rad(self._rig.servo(name).shaft.q_rad) for name, one in joints])

    def play(self) -> None:
        """Let a period go by."""
        clock = self._rig.clock
        clock.sleep_until(clock.now_s() + self._rig.joints.period_s)
        for ports in self._rig.ports[:1]:
            ports.play()

    @property
    def commands(self) -> list[MotorCommand]:
        """The one in force: torque, or damping where it is left to itself."""
        sent = [driver._sent for driver in self.drivers if driver._sent is not None]
        zero = np.zeros(len(self._rig.joints.joints))
        tau, kd = zero.copy(), zero.copy()
        for index, servo in enumerate(self._rig.bench.servos.values()):
            mode, unit = servo.memory.get(11, 1), servo.kind.step_nm
            if servo.is_on and mode == 0:
                tau[index] = servo.memory.get(102, 2, signed=True) * unit
            elif servo.is_on and mode == 1:
                assert servo.memory.get(104, 4) == servo.memory.get(76, 2) == 0
                kd[index] = servo.memory.get(78, 2) / 128.0 * unit / SPEED_RAD_S
        stamp_s = max((one.stamp_s for one in sent), default=0.0)
        return [MotorCommand(stamp_s, zero, zero, tau, zero, kd)] if sent else []

    def read(self) -> BodySample:
        servos = self._rig.bench.servos.values()
        return felt(
            self.q,
            [servo.shaft.qd_rad_s for servo in servos],
            [servo.tau_nm for servo in servos],
            now_s=self._rig.clock.now_s(),
            let_go=any(not servo.is_on for servo in servos),
            told_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )
