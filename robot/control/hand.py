"""One hand: opening and force of its two coupled fingers.

As people do, it grips harder when what it holds is pulled at: with the force that the friction of
its pads asks for, times a margin, but never less than it was told, nor more than the motor bears
for a moment. While the hand is empty, what its force sensor shows besides the hand's own weight is
what the sensor is off by (several newtons, docs/realities.md): it is taken off from then on.
"""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.motor_bus import MotorState
from robot.messages import Activity, Grip, HandState, Side
from robot.model.body import BodyModel
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array, Vector3

MARGIN = 1.25
PULL_TIME_S, TIGHT_S = 0.01, 1.0  # of a pull: soon felt; gripped harder until it has rested so long
TARE_S = 5.0
"""Over so long the sensor's offset is averaged: ten steps of a walk, whose accelerations cancel.

A thing that the open hand brushes for a moment hardly counts; a drift of 0.2 N/√s is kept up with.
"""
STOPPED = "stopped by something"


class HandControl:
    """Reference of one hand's motor, and what its sensors say."""

    def __init__(self, body: BodyModel, side: Side, q_start: Array) -> None:
        """Hold the opening it starts with."""
        self.hand = body.description.hands[side]
        self.gripping = body.description.handy.gripping
        self.side: Side = side
        self.motor = body.description.motor_names.index(self.hand.motor)
        self.row = 0 if side == "left" else 1
        model = body.model
        self._weight_n = GRAVITY_M_S2 * float(model.body_subtreemass[body.body_id(self.hand.body)])
        self._kp = float(body.kp[self.motor])
        self.target: float = float(q_start[self.motor])
        self._reference = self.target
        self._force_n = self.hand.max_force_n
        self._most_n = self.gripping.peak_share * float(body.torque_limit_nm[self.motor])
        self._offset_n: Array = np.zeros(3)  # in the axes of the sensor
        self._empty_s = 0.0
        self._pull_n: Vector3 = (0.0, 0.0, 0.0)  # in the axes of N
        self._tight_n = 0.0
        self._tight_s = 0.0
        self.pulls = 0
        self._time_s = 0.0
        self._still_s = 0.0
        self.load_n = 0.0
        self.activity = Activity(id=0, status="done")

    def grip(self, command: Grip) -> None:
        """Take a new opening and force."""
        opening = min(self.hand.max_opening_m, max(0.0, command.opening_m))
        self.target = opening / self.hand.opening_per_motor
        self._force_n = min(self.hand.max_force_n, max(1.0, command.force_n))
        self._time_s, self._still_s = 0.0, 0.0
        self._tight_n = 0.0
        self.activity = Activity(id=command.id, status="running")

    def keep(self, state: MotorState) -> None:
        """Go on with the grip that another controller left: close with the force that is felt."""
        force_n = -float(state.tau[self.motor])
        if force_n > self.gripping.held_n:
            self.target, self._force_n = 0.0, min(self.hand.max_force_n, force_n)
            self.activity = Activity(id=0, status="done", detail=STOPPED)

    def update(
        self, dt_s: float, state: MotorState, *, wrist_wrench: Array, rotation_NW: Array
    ) -> float:
        """Advance; returns the motor's position target, limited so that kp x error is the force.

        `wrist_wrench` is measured at both wrists, shape (2, 6); `rotation_NW` turns the sensor's
        frame of this one into N, shape (3, 3).
        """
        self._time_s += dt_s
        measured_n = wrist_wrench[self.row, :3]
        if self.activity.status == "done" and self.activity.detail != STOPPED:
            self._tare(dt_s, measured_n, rotation_NW)
        x, y, z = rotation_NW.dot(measured_n - self._offset_n).tolist()
        load = -z - self._weight_n
        self.load_n += min(1.0, dt_s / self.gripping.load_s) * (load - self.load_n)
        q, qd = float(state.q[self.motor]), float(state.qd[self.motor])
        step = self.gripping.closing_m_s * dt_s
        self._reference += max(-step, min(step, self.target - self._reference))
        self._tighten(dt_s, (-x, -y, load))
        force_n = max(self._force_n, self._tight_n)
        reach = force_n / self._kp
        if self._tight_n:
            self._reference = max(self.target, q - reach)
        self._reference = max(q - reach, min(q + reach, self._reference))
        self._report(dt_s, q, qd)
        return self._reference

    def _tare(self, dt_s: float, measured_n: Array, rotation_NW: Array) -> None:
        """The hand is empty: all that its sensor bears is its own weight."""
        self._empty_s = min(TARE_S, self._empty_s + dt_s)
        off_n = measured_n + self._weight_n * rotation_NW[2]
        self._offset_n += dt_s / self._empty_s * (off_n - self._offset_n)

    def _tighten(self, dt_s: float, pull_n: Vector3) -> None:
        """Note how much harder to grip what is pulled at, and for how long; `pull_n` is in N."""
        self._tight_s -= dt_s
        if self._tight_s <= 0.0:
            self._tight_n = 0.0
        if self.activity.status != "done" or self.activity.detail != STOPPED:
            self._pull_n = (0.0, 0.0, 0.0)
            return  # it holds nothing
        gain = min(1.0, dt_s / PULL_TIME_S)
        x, y, z = (was + gain * (now - was) for was, now in zip(self._pull_n, pull_n, strict=True))
        self._pull_n = (x, y, z)
        needed_n = MARGIN * math.hypot(x, y, z) / (2.0 * self.gripping.friction)
        if needed_n <= max(self._force_n, self._tight_n):
            return
        self.pulls += not self._tight_n
        self._tight_n = min(self._most_n, needed_n)
        self._tight_s = TIGHT_S

    def _report(self, dt_s: float, q: float, qd: float) -> None:
        if self.activity.status != "running":
            return
        gripping = self.gripping
        still = abs(qd) < gripping.still_m_s
        self._still_s = self._still_s + dt_s if still else 0.0
        arrived = abs(q - self.target) * self.hand.opening_per_motor < gripping.done_m
        if arrived or min(self._still_s, self._time_s) > gripping.settle_s:
            detail = "" if arrived else STOPPED
            self.activity = Activity(id=self.activity.id, status="done", detail=detail)
        elif self._time_s > gripping.give_up_s:
            self.activity = Activity(id=self.activity.id, status="failed", detail="still moving")

    def state(self, motors: MotorState, X_NG: SE3) -> HandState:
        """What is known of the hand."""
        gain = self.hand.opening_per_motor
        return HandState(
            X_NG=X_NG,
            opening_m=gain * float(motors.q[self.motor]),
            opening_m_s=gain * float(motors.qd[self.motor]),
            load_n=self.load_n,
            pulls=self.pulls,
        )
