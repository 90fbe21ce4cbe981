"""One arm: follow a joint trajectory, move the grasp frame on a line in N, or brake and hold.

The line is differential inverse kinematics by damped least squares (Nakamura & Hanafusa, 1986) on
the arm's own joints, closed over the measured grasp pose, so that neither the body's sway nor the
motors' sag shows at the hand. It is done here, not through mink, for its cost: 30 us a tick.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.control.braking import Brake
from robot.kinematics.dynamics import Dynamics
from robot.kinematics.spline import ClampedSpline
from robot.messages import Activity, HoldArm, MoveArm, MoveHand, Side
from robot.model.body import BodyModel, as_index
from robot.se3 import SE3, Array, rotation_vector

DAMPING = 0.03  # of the least squares: near a singularity the joints stay slow
NEARER_M, BEHIND_M, HELD_BACK_S = 0.02, 0.015, 0.5
"""A hand that is so far behind its line, and in that time got no nearer to its end by so much, is
held back by something."""
SAME_AIM_M = 0.02
"""A line that is aimed anew so near to where it went before goes on."""
END_ZONE_RAD = 0.3
"""Before a joint's end: there it is moved away from it, where that leaves the hand alone."""


class Arm:
    """Reference of one arm.

    Attributes:
        q, qd, qdd: reference of the arm's joints, shape (joints,).
        activity: about the last command.
    """

    def __init__(self, body: BodyModel, side: Side, q_start: Array) -> None:
        """Hold the posture it starts in."""
        self.body = body
        self.limits = body.description.arms
        self.side: Side = side
        self.motors = as_index(np.array(body.description.indices(f"{side}_arm")))
        self.dofs = as_index(body.dof_of[self.motors])
        self.lower, self.upper = body.lower_rad[self.motors], body.upper_rad[self.motors]
        self.q: Array = q_start[self.motors].copy()
        self.qd: Array = np.zeros(len(self.q))
        self.qdd: Array = np.zeros(len(self.q))
        self.activity = Activity(id=0, status="done")
        self._time_s = 0.0
        self._spline: ClampedSpline | None = None
        self._line: Line | None = None
        self._nearest_m, self._held_back_s = math.inf, 0.0
        self._brake: Brake | None = None
        nv = body.model.nv
        self._jac: Array = np.zeros((6, nv))

    def follow(self, command: MoveArm) -> None:
        """Start a joint trajectory from the present reference."""
        positions = np.array(command.positions_rad)
        times = np.array(command.times_s)
        problem = self._problem(times, positions)
        if problem:
            self.activity = Activity(id=command.id, status="failed", detail=problem)
            return
        if times[0] > 0.0:
            times = np.concatenate([[0.0], times])
            positions = np.vstack([self.q, positions])
        else:
            positions[0] = self.q
        self._begin(command.id)
        self._spline = ClampedSpline(times, positions)

    def _problem(self, times: Array, positions: Array) -> str:
        if positions.ndim != 2 or positions.shape[1] != len(self.q):
            return f"positions must have {len(self.q)} columns"
        if len(times) != len(positions) or len(times) == 0 or times[-1] <= 0.0:
            return "times and positions must be as many, and end after now"
        if not np.isfinite(times).all() or (np.diff(times) <= 0.0).any() or times[0] < 0.0:
            return "times must be finite and grow"
        if times[0] == 0.0 and len(times) < 2:
            return "a trajectory needs a point after now"
        low, high = self.lower - 1e-3, self.upper + 1e-3
        inside = (positions >= low) & (positions <= high)  # False for what is not a number
        if not inside.all():
            return "a position is outside the joint limits"
        return ""

    def reach(self, command: MoveHand, X_NG: SE3, load_n: float) -> None:
        """Start a straight line of the grasp frame from its measured pose X_NG."""
        if len(command.near_rad) not in (0, len(self.q)):
            detail = f"near_rad must have {len(self.q)} values"
            self.activity = Activity(id=command.id, status="failed", detail=detail)
            return
        before, going_on = self._line, self.activity.status == "running"
        self._begin(command.id)
        self._line = Line(command, X_NG, load_n)
        if before is None or not going_on or not self._line.aims_as(before):
            self._nearest_m, self._held_back_s = math.inf, 0.0

    def hold(self, command: HoldArm, measured: Array) -> None:
        """Brake, and hold the joints where they come to rest; `measured` shape (joints,)."""
        self._begin(command.id)
        self._come_to_rest(measured)

    def _begin(self, command_id: int) -> None:
        self._spline = self._line = self._brake = None
        self._time_s = 0.0
        self.activity = Activity(id=command_id, status="running")

    def _come_to_rest(self, measured: Array) -> None:
        """Brake; a joint that something holds back from its reference rests, and stops pressing."""
        self._spline = self._line = None
        self._time_s = 0.0
        free = np.abs(self.q - measured) < self.limits.joints_done_rad
        self._brake = Brake(
            np.where(free, self.q, measured),
            np.where(free, self.qd, 0.0),
            np.where(free, self.qdd, 0.0),
            acceleration=self.limits.brake_rad_s2,
            jerk=self.limits.brake_rad_s3,
        )

    def update(
        self, dt_s: float, dynamics: Dynamics, measured: Array, *, load_n: float, standing: bool
    ) -> None:
        """Advance the reference; `measured` are the arm's joints, shape (joints,)."""
        self._time_s += dt_s
        if self._spline is not None:
            self._follow(measured)
        elif self._brake is not None:
            self._slow_down(self._brake)
        elif self._line is not None:
            if self.activity.status != "running" and not standing:
                self._come_to_rest(measured)
            else:
                self._track(dt_s, dynamics, measured, load_n)

    def _slow_down(self, brake: Brake) -> None:
        q, qd, self.qdd = brake.at(self._time_s)
        self.q = np.minimum(np.maximum(q, self.lower), self.upper)
        self.qd = np.where(self.q == q, qd, 0.0)
        if self._time_s >= brake.duration_s:
            self.qd, self.qdd = np.zeros_like(q), np.zeros_like(q)
            self._brake = None
            if self.activity.status == "running":
                self.activity = Activity(id=self.activity.id, status="done")

    def _follow(self, measured: Array) -> None:
        assert self._spline is not None
        end_s = float(self._spline.times_s[-1])
        over = self._time_s >= end_s
        self.q, self.qd, self.qdd = self._spline.at(min(self._time_s, end_s))
        if over:
            self.qd, self.qdd = np.zeros_like(self.q), np.zeros_like(self.q)
        if over:
            error = float(np.abs(self.q - measured).max())
            if error < self.limits.joints_done_rad:
                self.activity = Activity(id=self.activity.id, status="done")
                self._spline = None
            elif self._time_s > end_s + self.limits.give_up_s:
                detail = f"{error:.2f} rad short"
                self.activity = Activity(id=self.activity.id, status="failed", detail=detail)
                self._spline = None

    def _track(self, dt_s: float, dynamics: Dynamics, measured: Array, load_n: float) -> None:
        """One step of the closed-loop line."""
        line = self._line
        assert line is not None
        data, model = dynamics.data, self.body.model
        site = self.body.grasp_site[self.side]
        if line.contact(load_n) and self.activity.status == "running":
            self.activity = Activity(id=self.activity.id, status="done", detail="contact")
            line.freeze(self.body.site_pose(data, site))
        X_target, velocity = line.at(self._time_s)
        error = np.empty(6)
        error[:3] = np.array(X_target.p) - data.site_xpos[site]
        rotation = X_target.rotation() @ data.site_xmat[site].reshape(3, 3).T
        error[3:] = rotation_vector(rotation)
        distance = float(np.linalg.norm(error[:3]))
        angle = float(np.linalg.norm(error[3:]))
        self._report(line, distance, angle)
        most_m = self.limits.line_most_m
        if distance > most_m:
            error[:3] *= most_m / distance
        twist = self.limits.line_rate_1_s * error
        twist[:3] += velocity
        jac = self._jac
        mujoco.mj_jacSite(model, data, jac[:3], jac[3:], site)
        rate = self._rate(jac[:, self.dofs], twist, line.near_rad, dt_s=dt_s)
        peak, fastest = float(np.abs(rate).max()), self.limits.line_speed_rad_s
        if peak > fastest:
            rate *= fastest / peak
        q, lead = self.q + rate * dt_s, self.limits.line_lead_rad
        q = np.minimum(np.maximum(q, measured - lead), measured + lead)
        q = np.minimum(np.maximum(q, self.lower), self.upper)
        self.q, self.qd = q, rate
        self.qdd[:] = 0.0
        left_m = line.left_m(data.site_xpos[site])
        self._stop_pressing(dt_s, measured, left_m=left_m, behind_m=distance)

    def _stop_pressing(
        self, dt_s: float, measured: Array, *, left_m: float, behind_m: float
    ) -> None:
        """Fail and come to rest where the hand gets no nearer to its goal, and the line goes on.

        However often the line is aimed anew meanwhile. Else it presses: a hand under the edge of a
        board bent the trunk for two seconds, slipped off, and the robot fell over.
        """
        if self._nearest_m - left_m > NEARER_M or left_m < self.limits.line_near_m:
            self._nearest_m, self._held_back_s = left_m, 0.0
            return
        self._held_back_s += dt_s if behind_m > BEHIND_M else 0.0
        if self._held_back_s > HELD_BACK_S and self.activity.status == "running":
            detail = f"something holds it back, {1000 * left_m:.0f} mm short"
            self.activity = Activity(id=self.activity.id, status="failed", detail=detail)
            self._come_to_rest(measured)

    def _rate(self, jac: Array, twist: Array, near_rad: Array | None, *, dt_s: float) -> Array:
        """Joint rates that move the hand by a twist; none goes beyond its end.

        A joint that would is left where it is, and the others are asked again without it: else they
        go on as if it moved, and the hand leaves its line.
        """
        moving = np.ones(len(self.q), dtype=bool)
        while True:
            part: Array = jac * moving
            damped = part @ part.T + DAMPING**2 * np.eye(6)
            rate = part.T @ np.linalg.solve(damped, twist)
            near = self._off_its_ends() if near_rad is None else near_rad
            rate += moving * self._elbow_rate(part, damped, near)
            q = self.q + rate * dt_s
            ended = moving & ((q < self.lower) & (rate < 0.0) | (q > self.upper) & (rate > 0.0))
            if not ended.any():
                return rate
            moving &= ~ended

    def _off_its_ends(self) -> Array:
        """The joints as they are, those near their ends a little off them; shape (joints,).

        The hand is left alone; the elbow goes where the joints have room for the rest of the line.
        """
        low: Array = self.lower + END_ZONE_RAD
        high: Array = self.upper - END_ZONE_RAD
        return np.minimum(np.maximum(self.q, low), high)

    def _elbow_rate(self, jac: Array, damped: Array, near_rad: Array) -> Array:
        """Joint rates, shape (joints,), to the joints near, of what leaves the hand alone."""
        wanted = self.limits.elbow_1_s * (near_rad - self.q)
        free = wanted - jac.T @ np.linalg.solve(damped, jac @ wanted)
        return free * min(1.0, self.limits.elbow_rad_s / max(1e-9, float(np.abs(free).max())))

    def _report(self, line: Line, distance_m: float, angle_rad: float) -> None:
        if self.activity.status != "running" or self._time_s < line.duration_s:
            return
        limits = self.limits
        if distance_m < limits.line_done_m and angle_rad < limits.line_done_rad:
            self.activity = Activity(id=self.activity.id, status="done")
        elif self._time_s > line.duration_s + limits.give_up_s:
            near = distance_m < limits.line_near_m
            detail = f"{1000 * distance_m:.0f} mm and {angle_rad:.2f} rad short"
            status = "done" if near else "failed"
            self.activity = Activity(id=self.activity.id, status=status, detail=detail)


class Line:
    """A straight line of the grasp frame with minimum-jerk timing."""

    def __init__(self, command: MoveHand, X_NG: SE3, load_n: float) -> None:
        """From X_NG to the command's pose at its speed."""
        self._start, self._goal = X_NG, command.X_NG
        self._delta: Array = np.array(command.X_NG.p) - np.array(X_NG.p)
        self._turn: Array = rotation_vector(command.X_NG.rotation() @ X_NG.rotation().T)
        length = float(np.linalg.norm(self._delta))
        angle = float(np.linalg.norm(self._turn))
        speed = max(0.01, command.speed_m_s)
        self.duration_s = max(0.15, 1.5 * length / speed, 1.5 * angle / (5.0 * speed))
        self._stop_load_n = command.stop_load_n
        self._load_n = load_n
        self.near_rad = np.array(command.near_rad) if command.near_rad else None

    def at(self, time_s: float) -> tuple[SE3, Array]:
        """Pose and linear velocity [m/s] at `time_s` from the start."""
        if time_s >= self.duration_s:
            return self._goal, np.zeros(3)
        t = time_s / self.duration_s
        share = 10 * t**3 - 15 * t**4 + 6 * t**5
        rate = (30 * t**2 - 60 * t**3 + 30 * t**4) / self.duration_s
        p = np.array(self._start.p) + share * self._delta
        angle = float(np.linalg.norm(self._turn))
        rotation = self._start.rotation()
        if angle > 1e-6:
            quat = np.zeros(4)
            matrix = np.zeros(9)
            mujoco.mju_axisAngle2Quat(quat, self._turn / angle, share * angle)
            mujoco.mju_quat2Mat(matrix, quat)
            rotation = matrix.reshape(3, 3) @ rotation
        return SE3.from_rotation(rotation, p), rate * self._delta

    def left_m(self, p_N: Array) -> float:
        """How far a point is from its end."""
        return float(np.linalg.norm(np.array(self._goal.p) - p_N))

    def aims_as(self, other: Line) -> bool:
        """Whether its end is about that of another line."""
        return math.dist(self._goal.p, other._goal.p) < SAME_AIM_M

    def contact(self, load_n: float) -> bool:
        """Has the load changed as much as asked for?"""
        if self._stop_load_n is None:
            return False
        return abs(load_n - self._load_n) >= self._stop_load_n

    def freeze(self, X_NG: SE3) -> None:
        """End here."""
        self._goal, self.duration_s, self._stop_load_n = X_NG, 0.0, None
