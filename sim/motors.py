"""Motors as they are bought: a PD loop in their own firmware, a torque limit, a watchdog, heat.

The firmware law of `robot.drivers.motor_bus` is written into MuJoCo's actuators: gain 1 and affine
bias (0, -kp, -kd) make ``force = ctrl - kp q - kd qd``, so that with
``ctrl = kp q_des + kd qd_des + tau_ff`` the loop runs at the physics rate and is integrated
implicitly (no instability from a stiff gain), and `forcerange` is the torque limit.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable

import mujoco
import numpy as np

from robot.drivers.motor_bus import MotorCommand
from robot.errors import DescriptionError, DriverError, Problem
from robot.files.config import nearest
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.flaws import JointFlaws

WATCHDOG_S = 0.020
AMBIENT_C = 25.0
HEAT_PERIOD_S = 0.05
# What fits into a command packet; what is past it is sent as the nearest value that fits.
MAX_Q_RAD = 12.5
MAX_QD_RAD_S = 65.0
MAX_KP = 5000.0
MAX_KD = 100.0


def install(spec: mujoco.MjSpec, description: RobotDescription) -> None:
    """Replace every actuator of a robot's MJCF by one torque motor a joint, in motor order.

    Position servos, velocity servos and plain motors all become the same thing; so any MJCF
    humanoid runs with the firmware of this module.

    Raises:
        DescriptionError: naming every joint that the description has and the MJCF has not.
    """
    joints = [joint.name for joint in spec.joints]
    problems = [
        Problem(
            f"motor {name!r} wants joint {motor.joint!r}, which the MJCF has not",
            file=str(description.mjcf_path()),
            suggestion=nearest(motor.joint, joints),
        )
        for name, motor in description.motors.items()
        if motor.joint not in joints
    ]
    if problems:
        raise DescriptionError(problems)
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    for name, motor in description.motors.items():
        limit = motor.torque_limit_nm
        actuator = spec.add_actuator(
            name=name,
            target=motor.joint,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            gaintype=mujoco.mjtGain.mjGAIN_FIXED,
            biastype=mujoco.mjtBias.mjBIAS_AFFINE,
            dyntype=mujoco.mjtDyn.mjDYN_NONE,
            forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
            forcerange=[-limit, limit],
            ctrllimited=mujoco.mjtLimited.mjLIMITED_FALSE,
        )
        actuator.gainprm[0] = 1.0
        actuator.biasprm[2] = -motor.kd


class Motors:
    """The firmware of all motors of one robot in one simulation.

    Attributes:
        later: does after the delay what a command leads to; None: there is no delay.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, description: RobotDescription
    ) -> None:
        """Take over the actuators of `model`, damped until a first command comes."""
        motors = description.motors.values()
        self.count = len(description.motors)
        joints = [model.joint(motor.joint).id for motor in motors]
        self.q_index = model.jnt_qposadr[joints].copy()
        self.qd_index = model.jnt_dofadr[joints].copy()
        self.limit_nm: Array = np.array([motor.torque_limit_nm for motor in motors])
        self.temperature_c: Array = np.full(self.count, AMBIENT_C)
        self._heating = description.heating
        self.command_stamp_s = -np.inf
        self.watchdog = True
        self._off: list[int] = []
        self._damping: Array = np.array([motor.kd for motor in motors])
        self._ctrl = data.ctrl
        self._force = data.actuator_force
        bias = model.actuator_biasprm
        self._bias_kp, self._bias_kd = bias[:, 1], bias[:, 2]
        self._command: Array = np.empty((5, self.count))
        self._flat, self._rows = self._command.reshape(-1), tuple(self._command)
        self._sent = self._rows
        self._product: Array = np.empty(self.count)
        self._taken: tuple[Array, ...] = ()
        bounds = np.empty((5, self.count))
        bounds[0], bounds[1], bounds[2] = MAX_Q_RAD, MAX_QD_RAD_S, self.limit_nm
        bounds[3], bounds[4] = MAX_KP, MAX_KD
        self._upper: Array = bounds.reshape(-1)
        self._lower: Array = -self._upper
        self._lower[3 * self.count :] = 0.0
        self._strength: Array | None = None
        self._offset: Array = np.zeros(self.count)
        self._no_load: Array = np.zeros(self.count)
        self._bend: Array = np.zeros(self.count)
        self.later: Callable[[Callable[[], None]], None] | None = None
        self._orders = 0
        self._qvel, self._range = data.qvel, model.actuator_forcerange
        self.damp()

    def spoil(self, flaws: JointFlaws, fastest_rad_s: Array) -> None:
        """From now on encoders and torques are off.

        Args:
            flaws: by how much.
            fastest_rad_s: the speed limits, from which torques fall, shape (motors,).
        """
        self._strength, self._offset = flaws.strength, flaws.offset
        self._no_load, self._bend = flaws.no_load_rad_s, np.array(fastest_rad_s)
        self._taken = ()
        self.damp()

    def tire(self) -> None:
        """Let a motor that turns fast push no further than it can; braking it can as ever."""
        if self._strength is None:
            return
        speed = self._qvel[self.qd_index]
        left = (self._no_load - np.abs(speed)) / np.maximum(1e-9, self._no_load - self._bend)
        share = np.minimum(1.0, np.maximum(0.0, left))
        self._range[:, 0] = -self.limit_nm * np.where(speed < 0.0, share, 1.0)
        self._range[:, 1] = self.limit_nm * np.where(speed > 0.0, share, 1.0)

    def write(self, command: MotorCommand) -> MotorCommand:
        """Take a command from the bus; returns it as the packets could carry it.

        Raises:
            DriverError: if a value is not finite or a shape is wrong; then nothing changes.
        """
        fields = (command.q_des, command.qd_des, command.tau_ff, command.kp, command.kd)
        if not self._taken or not all(map(operator.is_, fields, self._taken)):
            self._take(fields)
        self.command_stamp_s = command.stamp_s
        self.watchdog = False
        return MotorCommand(command.stamp_s, *self._sent)

    def _take(self, fields: tuple[Array, ...]) -> None:
        """Put a new command in force; sent again, it is still (senders change no sent arrays)."""
        shape = self.limit_nm.shape
        for field in fields:
            if field.shape != shape:
                raise DriverError(f"a command has shape {field.shape}, motors want {shape}")
        flat = np.concatenate(fields)
        if not math.isfinite(np.add.reduce(flat)):
            raise DriverError(f"a command is not finite: {_not_finite(flat.reshape(5, -1))}")
        np.minimum(flat, self._upper, out=flat)
        np.maximum(flat, self._lower, out=flat)
        self._taken, self._sent = fields, tuple(flat.reshape(5, -1))
        if self.later is None:
            self._obey(flat)
            return
        self._orders += 1
        order = self._orders
        self.later(lambda: self._obey(flat) if order > self._forgotten else None)

    def _obey(self, flat: Array) -> None:
        self._flat[:] = flat
        self._apply()

    def damp(self) -> None:
        """What the watchdog does: no stiffness, velocity target zero."""
        self.watchdog = True
        self._taken = ()
        self._forgotten = self._orders
        self._command[:4] = 0.0
        self._command[4] = self._damping
        self._apply()

    @property
    def stiff(self) -> bool:
        """Whether any motor holds a position."""
        return bool(self._command[3].any())

    def set_off(self, motor: int, *, off: bool) -> None:
        """Let one motor (by index) damp whatever it is told, or obey again."""
        self._off = sorted({*self._off, motor} if off else {*self._off} - {motor})
        self._taken = ()

    def heat(self, duration_s: float) -> None:
        """Let the windings take the losses of the last torques for `duration_s`."""
        heating = self._heating
        load = self._force / (heating.continuous_share * self.limit_nm)
        target_c = AMBIENT_C + heating.rise_k * load * load
        share = 1.0 - np.exp(-duration_s / heating.time_constant_s)
        self.temperature_c += share * (target_c - self.temperature_c)

    def _apply(self) -> None:
        if self._off:
            self._command[:4, self._off] = 0.0
            self._command[4, self._off] = self._damping[self._off]
        q_des, qd_des, tau_ff, kp, kd = self._rows
        ctrl = self._ctrl
        np.multiply(kp, q_des, out=ctrl)
        np.multiply(kd, qd_des, out=self._product)
        ctrl += self._product
        ctrl += tau_ff
        np.negative(kp, out=self._bias_kp)
        np.negative(kd, out=self._bias_kd)
        if self._strength is not None:
            ctrl -= kp * self._offset  # its loop is closed on what the encoder says
            ctrl *= self._strength
            self._bias_kp *= self._strength
            self._bias_kd *= self._strength


def _not_finite(rows: Array) -> str:
    """Name the first value that is not a number, `kp[3]` for example."""
    row, column = (int(index) for index in np.argwhere(~np.isfinite(rows))[0])
    return f"{('q_des', 'qd_des', 'tau_ff', 'kp', 'kd')[row]}[{column}]"
