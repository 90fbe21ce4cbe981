"""A driver of motors behind Ethernet on emulated boards, in simulated time."""

from pathlib import Path

import msgspec
import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.ethernet import joint_map
from robot.drivers.motors.ethernet.driver import EthernetMotors
from robot.drivers.motors.ethernet.joint_map import Board, DriveMap, JointDrive
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.devices.ethernet_bench import DirectPorts, build
from sim.devices.ethernet_board import Drive, Flaw
from tests.fakes.motor_rig import MotorRig, felt, lines_of_its_own

ARM = """\
rate_hz: 500
boards:
  upper: {address: 10.0.7.11, number: 1}
  lower: {address: 10.0.7.12, number: 2}
joints:
  shoulder: {board: upper, model: ARM-40, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {board: upper, model: ARM-20, id: 0, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 40}
  wrist: {board: lower, model: ARM-10, id: 5, lower_rad: -1.0, upper_rad: 1.0, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501


def arm(folder: Path, text: str = ARM) -> DriveMap:
    """The map of a small arm."""
    path = folder / "ethernet.yaml"
    path.write_text(text)
    return joint_map.load(path)


def limbs(boards: int, joints: int, *, rate_hz: int = 500) -> DriveMap:
    """So many boards with so many joints each."""
    return DriveMap(
        rate_hz=rate_hz,
        boards={f"board{b}": Board(address=f"10.0.7.{b}", number=b) for b in range(boards)},
        joints={
            f"joint{b}_{j}": JointDrive(
                board=f"board{b}", model="LIMB-40", id=j, lower_rad=-2.0, upper_rad=2.0,
                velocity_limit_rad_s=20.0, torque_limit_nm=40.0,
            )
            for b in range(boards)
            for j in range(joints)
        },
    )  # fmt: skip


def drive_map(robot: RobotDescription, *, a_board: int = 5) -> DriveMap:
    """A map that drives a robot's joints, five a board."""
    motors = robot.motors.items()
    return DriveMap(
        rate_hz=500,
        boards={
            f"board{b}": Board(address=f"10.0.7.{b}", number=b)
            for b in range(-(-len(motors) // a_board))
        },
        joints={
            name: JointDrive(
                board=f"board{index // a_board}", model="LIMB-40", id=index % a_board,
                lower_rad=-3.0, upper_rad=3.0, velocity_limit_rad_s=motor.velocity_limit_rad_s,
                torque_limit_nm=motor.torque_limit_nm,
            )
            for index, (name, motor) in enumerate(motors)
        },
    )  # fmt: skip


class Rig(MotorRig):
    """A driver, its boards, and a clock."""

    def __init__(self, joints: DriveMap, *, is_still: bool = False, **flaws: Flaw) -> None:
        boards = lines_of_its_own(joints.boards, "address")
        self.joints = joints = msgspec.structs.replace(joints, boards=boards)
        self.clock = SimulatedClock(100.0)
        self.bench = build(joints, now_s=100.0, flaws=flaws, is_still=is_still)
        self.ports: list[DirectPorts] = []
        self.lines: list[str] = []
        self.driver = self.another()

    def another(self) -> EthernetMotors:
        """One more driver of the same boards."""

        def ports() -> DirectPorts:
            self.ports.append(DirectPorts(self.bench, self.clock))
            return self.ports[-1]

        return EthernetMotors(self.joints, self.clock, ports=ports, tell=self.lines.append)

    def drive(self, name: str) -> Drive:
        """The emulated drive of a joint."""
        return self.bench.drives[name]

    def cable(self, name: str):
        """The way to a joint's board."""
        return self.bench.cables[self.joints.joints[name].board]

    def let_pass(self, span_s: float) -> None:
        """Nobody says a word."""
        self.clock.sleep_until(self.clock.now_s() + span_s)
        for ports in self.ports[:1]:
            ports.play()


def killed(rig: Rig) -> None:
    """What the system does to a process that is killed: its claim is free, nothing is said."""
    rig.driver._is_armed = False
    rig.driver._claim.release()


class EthernetPlant:
    """What the boards of a rig measure and obey, as a plant tells it; their shafts are at rest."""

    def __init__(self, rig: Rig, drivers: tuple[EthernetMotors, EthernetMotors]) -> None:
        self.drivers = drivers
        self._rig = rig
        for drive in rig.bench.drives.values():
            drive.shaft.qd_rad_s = 0.0
            drive.shaft._spring_nm_rad = 0.0

    @property
    def q(self) -> Array:
        joints = self._rig.joints.joints.items()
        return np.array([one.joint_rad(self._rig.drive(name).shaft.q_rad) for name, one in joints])

    def play(self) -> None:
        """Let a period go by."""
        self._rig.let_pass(self._rig.joints.period_s)

    @property
    def commands(self) -> list[MotorCommand]:
        """The one in force; a stamp is in no datagram."""
        sent = [driver._sent for driver in self.drivers if driver._sent is not None]
        orders = [drive.order for drive in self._rig.bench.drives.values()]
        names = ("q_rad", "qd_rad_s", "tau_nm", "kp", "kd")
        rows = [np.array([getattr(order, name) for order in orders]) for name in names]
        return [MotorCommand(max(one.stamp_s for one in sent), *rows)] if sent else []

    def read(self) -> BodySample:
        drives = self._rig.bench.drives.values()
        return felt(
            self.q,
            [drive.shaft.qd_rad_s for drive in drives],
            [drive.tau_nm for drive in drives],
            now_s=self._rig.clock.now_s(),
            let_go=any(not drive.is_on for drive in drives),
            told_s=self.commands[-1].stamp_s if self.commands else -np.inf,
        )
