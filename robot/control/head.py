"""Keep the camera on a point: with the neck, or with the waist where there is none."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from robot.control.legs import Legs
from robot.kinematics.dynamics import Dynamics
from robot.messages import Activity, Look
from robot.model import looking
from robot.model.body import BodyModel, Turn, as_index
from robot.se3 import Array


class Head:
    """Reference of the head's yaw and pitch."""

    def __init__(self, body: BodyModel, q_start: Array) -> None:
        """Hold the posture it starts in."""
        self.body = body
        self._gaze = body.description.gaze
        self.motors = as_index(np.array(body.description.indices("head")))
        self._lower = body.lower_rad[self.motors].tolist()
        self._upper = body.upper_rad[self.motors].tolist()
        self.q: Array = q_start[self.motors].copy()
        self._point: Array | None = None
        self._camera = body.site_id(body.description.sensors.camera.site)
        self.activity = Activity(id=0, status="done")

    def look(self, command: Look) -> None:
        """Take a new point of N to look at."""
        self._point = np.array(command.p_N)
        self.activity = Activity(id=command.id, status="running")

    def update(self, dt_s: float, dynamics: Dynamics, measured: Array) -> None:
        """Turn towards the point, however the body moves; `measured` yaw and pitch [rad]."""
        if self._point is None:
            return
        data = dynamics.data
        rotation = data.xmat[self.body.torso_body].reshape(3, 3)
        x, y, z = ((self._point - data.site_xpos[self._camera]) @ rotation).tolist()
        step, arrived = self._gaze.rate_rad_s * dt_s, True
        for k, angle in enumerate((math.atan2(y, x), -math.atan2(z, math.hypot(x, y)))):
            wanted = max(self._lower[k], min(self._upper[k], angle))
            before = float(self.q[k])
            self.q[k] = before + max(-step, min(step, wanted - before))
            arrived = arrived and abs(wanted - float(measured[k])) < self._gaze.done_rad
        if arrived and self.activity.status == "running":
            self.activity = Activity(id=self.activity.id, status="done")


class WaistGaze:
    """The gaze of a robot whose camera is fixed to its trunk.

    It turns its waist only while it stands and nothing else asks for a lean; walking, it sees what
    is ahead. What is well inside the picture is not turned to. `motors` and `q` are those of its
    neck: none.
    """

    def __init__(self, body: BodyModel, legs: Legs) -> None:
        """Look where the trunk faces."""
        self.motors = slice(0, 0)
        self.q: Array = np.zeros(0)
        self.activity = Activity(id=0, status="done")
        self._legs, self._gaze = legs, body.description.gaze
        camera = body.description.sensors.camera
        self._camera = body.site_id(camera.site)
        self._half_aside_rad, self._half_down_rad = looking.half_picture_rad(camera)
        motors, turns = body.description.indices("waist"), body.turns("waist")
        self._dofs = {turn: int(body.qpos_of[i]) for i, turn in zip(motors, turns, strict=True)}
        self._sign = -1.0 if body.waist_below else 1.0
        self._point: Array = np.zeros(3)

    def look(self, command: Look) -> None:
        """Take a new point of N to look at."""
        self._point = np.array(command.p_N)
        self.activity = Activity(id=command.id, status="running")

    def update(self, _dt_s: float, dynamics: Dynamics, _measured: Array) -> None:
        """Turn the waist until the point is in the picture, or as far as it goes."""
        if self.activity.status != "running":
            return
        data = dynamics.data
        rotation = data.site_xmat[self._camera].reshape(3, 3)
        right, down, ahead = ((self._point - data.site_xpos[self._camera]) @ rotation).tolist()
        aside_rad = _beyond(math.atan2(right, ahead), self._half_aside_rad)
        down_rad = _beyond(math.atan2(down, math.hypot(right, ahead)), self._half_down_rad)
        there = aside_rad == 0.0 and down_rad == 0.0
        if not there and not self._legs.waist_is_free:
            return
        yaw_rad = self._angle(data, "yaw") - aside_rad
        pitch_rad = self._angle(data, "pitch") + down_rad
        back_rad, forward_rad = self._gaze.waist_pitch_rad
        most_rad = self._gaze.waist_yaw_rad
        yaw_rad = max(-most_rad, min(most_rad, yaw_rad))
        pitch_rad = max(back_rad, min(forward_rad, pitch_rad))
        if there or not self._legs.turn_waist(yaw_rad, pitch_rad):
            self.activity = Activity(id=self.activity.id, status="done")

    def _angle(self, data: Any, turn: Turn) -> float:
        """Of the trunk by one of the waist's joints, 0 where it has none of these."""
        return self._sign * float(data.qpos[self._dofs[turn]]) if turn in self._dofs else 0.0


def _beyond(angle_rad: float, limit_rad: float) -> float:
    """How far an angle is over a limit, to either side; 0 inside."""
    return angle_rad - max(-limit_rad, min(limit_rad, angle_rad))
