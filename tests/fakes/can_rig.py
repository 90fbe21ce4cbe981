"""A driver of CAN motors on emulated wires, in simulated time."""

from pathlib import Path

import numpy as np

from robot.clock import SimulatedClock
from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.joint_map import Bus, JointMap, JointMotor
from sim.devices.bench import Bench, build
from sim.devices.damiao import Damiao, Flaw
from sim.devices.direct import DirectPorts

ARM = """\
rate_hz: 500
buses:
  arm: {channel: can0}
joints:
  shoulder: {bus: arm, model: DM8009, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {bus: arm, model: DM4340, id: 2, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 40}
  wrist: {bus: arm, model: DM4310, id: 3, lower_rad: -1.0, upper_rad: 1.0, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501


def arm(folder: Path, text: str = ARM) -> JointMap:
    """The map of a small arm."""
    path = folder / "can.yaml"
    path.write_text(text)
    return joint_map.load(path)


def limbs(buses: int, joints: int, *, rate_hz: int = 500) -> JointMap:
    """So many buses with so many joints each."""
    return JointMap(
        rate_hz=rate_hz,
        buses={f"bus{b}": Bus(channel=f"can{b}") for b in range(buses)},
        joints={
            f"joint{b}_{j}": JointMotor(
                bus=f"bus{b}", model="DM8009", id=j + 1, lower_rad=-2.0, upper_rad=2.0,
                velocity_limit_rad_s=20.0, torque_limit_nm=40.0,
            )
            for b in range(buses)
            for j in range(joints)
        },
    )  # fmt: skip


class Rig:
    """A driver, its motors, and a clock."""

    def __init__(self, joints: JointMap, **flaws: Flaw) -> None:
        self.joints = joints
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
        """The emulated motor of a joint."""
        return self.bench.motors[name]

    def hold(self, q: float = 0.5, *, kp: float = 20.0, kd: float = 1.0) -> MotorCommand:
        """A command to hold a posture."""
        n = len(self.joints.joints)
        return MotorCommand(
            self.clock.now_s(), np.full(n, q), np.zeros(n), np.zeros(n), np.full(n, kp),
            np.full(n, kd),
        )  # fmt: skip

    def cycle(self, count: int = 1, command: MotorCommand | None = None, **hold) -> MotorState:
        """Write and read, so many periods."""
        for _ in range(count):
            asked = command or self.hold(**hold)
            asked.stamp_s = self.clock.now_s()
            self.driver.write(asked)
            state = self.driver.read()
        return state
