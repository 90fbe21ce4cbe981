"""The head: keep the camera on a point."""

from __future__ import annotations

import math

import numpy as np

from robot.kinematics.dynamics import Dynamics
from robot.messages import Activity, Look
from robot.model.body import BodyModel, as_index
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
