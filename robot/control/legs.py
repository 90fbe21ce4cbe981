"""Legs and trunk: from commands and the gait to the whole-body task of this tick."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.control.trunk import Trunk
from robot.control.walking.dcm import Point
from robot.control.walking.footsteps import Sole, Target, Twist
from robot.control.walking.gait import Gait
from robot.control.walking.gait_reference import Reference
from robot.control.whole_body import Task, WholeBody
from robot.kinematics.dynamics import Dynamics
from robot.messages import Activity, Landing, OneLeg, Side, Stand, Walk, WalkTo
from robot.model.body import SIDES, BodyModel
from robot.physics import GRAVITY_M_S2
from robot.se3 import Array, wrap_angle

MAX_COM_ACC_M_S2 = 6.0  # more than friction gives is never asked for


class Legs:
    """Turns Stand, Walk, WalkTo and OneLeg into tasks for the whole body.

    Attributes:
        gait: the state machine of the feet.
        activity: about the last command.
        trunk: how the trunk is turned against them.
        height_m: base height reference above the soles.
    """

    def __init__(
        self, body: BodyModel, whole: WholeBody, left: Sole, right: Sole, height_m: float
    ) -> None:
        """Stand on the soles where they are, at the height it is at."""
        self.body = body
        self.description = body.description
        self.gait = Gait(self.description, {"left": left, "right": right})
        self.activity = Activity(id=0, status="done")
        self.height_m = height_m
        self._height_goal_m = self.description.walking.base_height_m
        self._height_rate_m_s = 0.0
        count = whole.active_count
        self._posture: Array = np.zeros(count)  # of the active joints; only the waist's counts
        self.trunk = Trunk(body, self._posture[whole.waist])
        self._posture_kp: Array = np.zeros(count)
        self._balance = balance = self.description.balance
        self._tasks = tasks = balance.tasks
        self._posture_kd: Array = np.full(count, tasks.joints_1_s)
        self._posture_kp[whole.waist] = tasks.waist.kp_1_s2
        self._posture_kd[whole.waist] = tasks.waist.kd_1_s
        self._posed = False
        self._whole = whole
        self._upright: Array = np.zeros(4)
        self._tilt: Array = np.zeros(3)
        self._expires_s = math.inf
        self._now_s = 0.0
        self._twist_goal = Twist()

    # --- commands ------------------------------------------------------------------------------

    def stand(self, command: Stand) -> None:
        """Finish stepping, then hold this height and trunk."""
        nominal = self.description.walking.base_height_m
        height = nominal if command.height_m is None else command.height_m
        balance = self._balance
        self._height_goal_m = max(balance.lowest_base_m, min(balance.highest_base_m, height))
        self.trunk.turn(command.yaw_rad, command.pitch_rad)
        self._posed = command.yaw_rad != 0.0 or command.pitch_rad != 0.0
        self._end_walk()
        self.gait.wish = None if self.gait.phase == "stand" else Twist()
        self._start(command.id)

    def walk(self, command: Walk) -> None:
        """Follow a twist until it expires."""
        limits = self.description.walking
        self._stand_tall()
        forward = max(-limits.max_backward_m_s, min(limits.max_forward_m_s, command.forward_m_s))
        left = max(-limits.max_sideways_m_s, min(limits.max_sideways_m_s, command.left_m_s))
        turn = max(-limits.max_turn_rad_s, min(limits.max_turn_rad_s, command.turn_rad_s))
        self._twist_goal = Twist(forward, left, turn)
        self._expires_s = self._now_s + command.hold_s
        if not isinstance(self.gait.wish, Twist):
            self.gait.wish = Twist()
        self._start(command.id)

    def walk_to(self, command: WalkTo) -> None:
        """Step to a stance."""
        self._stand_tall()
        self._end_walk()
        goal = Sole(command.x_m, command.y_m, command.yaw_rad)
        self.gait.wish = Target(goal, command.position_tolerance_m, command.yaw_tolerance_rad)
        self._start(command.id)

    def one_leg(self, command: OneLeg) -> None:
        """Stand on one foot for a while."""
        if not self.gait.settled():
            detail = "the robot must stand still first"
            self.activity = Activity(id=command.id, status="failed", detail=detail)
            return
        self._stand_tall()
        self.gait.wish = None
        self.gait.lift(command.side, command.duration_s)
        self._start(command.id)

    @property
    def waist_is_free(self) -> bool:
        """Whether the waist may be turned to look: it stands, and no command asks for a lean."""
        return self.gait.phase == "stand" and not self._posed

    def turn_waist(self, yaw_rad: float, pitch_rad: float) -> bool:
        """Turn the waist to look about; False where it is there already, or goes no further."""
        self.trunk.turn(yaw_rad, pitch_rad)
        self.trunk.moves = self.trunk.differs()
        return self.trunk.moves

    def landings(self) -> tuple[Landing, ...]:
        """Where the feet are to land, the next one first."""
        return tuple(
            Landing(side=side, x_m=sole.x, y_m=sole.y, yaw_rad=sole.yaw)
            for side, sole in self.gait.landings
        )

    def _start(self, command_id: int) -> None:
        self.activity = Activity(id=command_id, status="running")

    def _stand_tall(self) -> None:
        self._height_goal_m = self.description.walking.base_height_m
        self.trunk.turn(0.0, 0.0)
        self._posed = False

    def _end_walk(self) -> None:
        self._expires_s = math.inf
        self._twist_goal = Twist()

    # --- every tick ----------------------------------------------------------------------------

    def update(
        self, dt_s: float, dynamics: Dynamics, load: list[float], rest_acc: Array
    ) -> tuple[Task, Reference]:
        """The task of this tick and the gait's reference behind it."""
        self._now_s += dt_s
        self._ramp(dt_s)
        (x, y, z), (vx, vy, _) = dynamics.com.tolist(), dynamics.com_velocity.tolist()
        omega = math.sqrt(GRAVITY_M_S2 / max(0.2, z))
        self.gait.omega_1_s = omega
        xi = (x + vx / omega, y + vy / omega)
        measured: dict[Side, Sole] = {side: self._sole(dynamics, i) for i, side in enumerate(SIDES)}
        reference = self.gait.update(dt_s, xi, measured, load)
        self._report()
        return self._task(dynamics, reference, (x, y), omega, rest_acc=rest_acc), reference

    def _ramp(self, dt_s: float) -> None:
        """Move height, waist and twist towards their goals at bounded rates."""
        step = self._balance.height_m_s * dt_s
        change = max(-step, min(step, self._height_goal_m - self.height_m))
        self.height_m += change
        self._height_rate_m_s = change / dt_s
        self.trunk.ramp(self._balance.waist_rad_s * dt_s)
        if self._now_s > self._expires_s:
            self._twist_goal = Twist()
        wish = self.gait.wish
        if isinstance(wish, Twist):
            goal = self._twist_goal
            walking = self.description.walking
            tall = self.height_m > walking.base_height_m - walking.tall_m
            if not tall:
                goal = Twist()
            # The first step is decided long before it lands, and as long as the ramp is by then.
            if self.gait.phase == "stand" and wish == Twist():
                dt_s += walking.start_s + walking.single_support_s
            dv = walking.acceleration_m_s2 * dt_s
            dw = walking.turn_acceleration_rad_s2 * dt_s
            self.gait.wish = Twist(
                _towards(wish.forward_m_s, goal.forward_m_s, dv),
                _towards(wish.left_m_s, goal.left_m_s, dv),
                _towards(wish.turn_rad_s, goal.turn_rad_s, dw),
            )

    def _report(self) -> None:
        """A command is done when the feet rest and height and waist are there."""
        if self.activity.status != "running" or not self.gait.settled():
            return
        if math.isfinite(self._expires_s) and self._now_s <= self._expires_s:
            return
        there = abs(self.height_m - self._height_goal_m) < 1e-3
        if there and not self.trunk.moves:
            self.activity = Activity(id=self.activity.id, status="done")
            if isinstance(self.gait.wish, Twist):
                self.gait.wish = None
                self._end_walk()

    def _sole(self, dynamics: Dynamics, i: int) -> Sole:
        x, y, _ = dynamics.sole_position[i].tolist()
        (cosine, _, _), (sine, _, _), _ = dynamics.sole_rotation[i].tolist()
        return Sole(x, y, math.atan2(sine, cosine))

    def _task(
        self, dynamics: Dynamics, ref: Reference, com: Point, omega: float, *, rest_acc: Array
    ) -> Task:
        velocity = dynamics.sole_velocity.tolist()
        sole_acc = [a for i in (0, 1) for a in self._sole_acc(dynamics, ref, i, velocity)]
        weight_n = self.body.mass_kg * GRAVITY_M_S2
        return Task(
            com_acc=np.array(self._com_acc(dynamics, ref.zmp_command, com, omega)),
            own_acc=self._own_acc(dynamics, ref.heading_rad),
            sole_acc=np.array(sole_acc),
            contact=ref.contact,
            max_force_n=[share * weight_n for share in ref.max_force_share],
            rest_acc=rest_acc,
            strain=ref.strain,
        )

    def _com_acc(
        self, dynamics: Dynamics, zmp: Point, com: Point, omega: float
    ) -> tuple[float, float, float]:
        """The pendulum's, about the commanded ZMP; up and down, the pelvis' height's."""
        most, stiffness = MAX_COM_ACC_M_S2, omega * omega
        x, y = (max(-most, min(most, stiffness * (com[k] - zmp[k]))) for k in (0, 1))
        task = self._tasks.height
        rate_error = self._height_rate_m_s - float(dynamics.data.qvel[2])
        error = self.height_m - float(dynamics.data.qpos[2])
        return x, y, task.kp_1_s2 * error + task.kd_1_s * rate_error

    def _own_acc(self, dynamics: Dynamics, heading_rad: float) -> Array:
        """Of the base: over the feet as the trunk wants it; of the joints: the posture."""
        data, whole = dynamics.data, self._whole
        wanted, error = self._upright, self._tilt
        self.trunk.write_base(wanted, heading_rad)
        qpos, qvel = data.qpos, data.qvel
        mujoco.mju_subQuat(error, wanted, qpos[3:7])
        task = self._tasks.pelvis
        acc = np.empty(3 + whole.active_count)
        acc[:3] = task.kp_1_s2 * error - task.kd_1_s * qvel[3:6]
        posture = acc[3:]
        np.subtract(self._posture, qpos[whole.active_qpos], out=posture)
        posture *= self._posture_kp
        posture -= self._posture_kd * qvel[whole.active_dofs]
        return acc

    def _sole_acc(
        self, dynamics: Dynamics, ref: Reference, i: int, velocity: list[float]
    ) -> list[float]:
        """Still on the floor, or along the swing; `velocity` of both soles, 12 values."""
        swing, v = ref.swing, velocity[6 * i : 6 * i + 6]
        if ref.contact[i] or swing is None:
            return [-self._tasks.soles_1_s * value for value in v]
        kp, kd = self._tasks.swing.kp_1_s2, self._tasks.swing.kd_1_s
        x, y, yaw = swing.position
        wanted, rate = (x, y, swing.z), (*swing.velocity[:2], swing.vz)
        feed = (*swing.acceleration[:2], swing.az)
        p = dynamics.sole_position[i].tolist()
        acc = [feed[k] + kp * (wanted[k] - p[k]) + kd * (rate[k] - v[k]) for k in range(3)]
        turn_kp, turn_kd = self._tasks.swing_turn.kp_1_s2, self._tasks.swing_turn.kd_1_s
        (cosine, _, tilt_y), (sine, _, tilt_x), _ = dynamics.sole_rotation[i].tolist()
        yaw_error = wrap_angle(yaw - math.atan2(sine, cosine))
        tilt = (tilt_x, -tilt_y, yaw_error)  # z x (sole's z) levels the sole
        acc += [turn_kp * tilt[k] - turn_kd * v[3 + k] for k in range(3)]
        acc[5] += turn_kd * swing.velocity[2] + swing.acceleration[2]
        return acc


def _towards(value: float, goal: float, step: float) -> float:
    return value + max(-step, min(step, goal - value))
