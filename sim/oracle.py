"""What only the simulator knows, handed out as an *oracle* until perception replaces it.

Truth itself (`X_WB`, `X_WO`) is for tests, benchmarks and the journal's `truth` section. What
travels to the robot is poorer: a pose fix with noise, and sightings of what the head camera could
see, each object a few millimetres from where it is.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.messages import PoseFix, Sighting, Sightings
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array
from sim.rays import Rays
from sim.world_schema import World

FIX_NOISE_M = 0.003
FIX_NOISE_RAD = math.radians(0.2)
POSE_ERROR_M = 0.005
JITTER_M = 0.0005
FORGET_S = 1.0  # unseen for longer, an object comes back with another error
NEAR_M = 0.05
MIN_POINTS = 2  # of the sample points of an object that must be in plain sight
# Sample points, in half extents of an object: middle, and a way towards each side.
SAMPLES = 0.7 * np.array(
    [[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float
)


class Oracle:
    """Truth about one simulation, and the oracle messages made of it."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        world: World,
        *,
        robot: RobotDescription,
        rays: Rays,
        rng: np.random.Generator,
        pose_error_m: float = POSE_ERROR_M,
    ) -> None:
        """Look at a simulation; draws every error from `rng`.

        Args:
            model: of the simulation.
            data: of the simulation.
            world: what is in it.
            robot: who looks.
            rays: for what is hidden.
            rng: of every error.
            pose_error_m: how far from the truth objects are sighted.
        """
        self._model, self._data = model, data
        self._rays, self._rng = rays, rng
        self._pose_error_m = pose_error_m
        self._base_q = int(model.jnt_qposadr[model.body_jntadr[model.body(robot.base_body).id]])
        self._camera = robot.sensors.camera
        tan_y = math.tan(self._camera.fovy_rad / 2)
        self._tan = (tan_y * self._camera.width / self._camera.height, tan_y)
        self._objects = {
            item.id: _Target(model, f"object/{item.id}", np.array(item.size_m) / 2)
            for item in world.objects
        }
        self._people = {
            person.id: _Target(model, f"person/{person.id}", np.array([0.1, 0.1, person.height_m]))
            for person in world.people
        }
        self._error: dict[str, Array] = {}
        self._off, self._off_until_s = SE3(), -math.inf
        self._seen_s: dict[str, float] = {}

    def X_WB(self) -> SE3:
        """The true pose of the base."""
        return _pose(self._data.qpos[self._base_q : self._base_q + 7])

    def X_WO(self, id: str) -> SE3:
        """The true pose of an object or a person. Raises KeyError if there is none of that id."""
        target = self._objects.get(id) or self._people[id]
        return target.pose(self._data)

    def poses(self) -> dict[str, SE3]:
        """The true pose of every object."""
        return {id: target.pose(self._data) for id, target in self._objects.items()}

    def mislead(self, X_off: SE3, *, until_s: float) -> None:
        """Let fixes be off by a motion of the world's frame until then."""
        self._off, self._off_until_s = X_off, until_s

    def fix(self, stamp_s: float) -> PoseFix:
        """Where the base is, with noise."""
        misled = stamp_s < self._off_until_s
        X_WB = _about(self.X_WB(), self._off) if misled else self.X_WB()
        noise = self._rng.standard_normal(6)
        x, y, z = (float(v) for v in noise[:3] * FIX_NOISE_M)
        roll, pitch, yaw = (float(v) for v in noise[3:] * FIX_NOISE_RAD)
        turn = SE3.from_rpy(roll, pitch, yaw, (0.0, 0.0, 0.0))
        X_fix = SE3((X_WB.p[0] + x, X_WB.p[1] + y, X_WB.p[2] + z), X_WB.quat_wxyz) @ turn
        return PoseFix(stamp_s=stamp_s, X_WB=X_fix, source="oracle")

    def sightings(self, stamp_s: float) -> Sightings:
        """What is inside the head camera's view, in range and not hidden."""
        camera = self._data.site(self._camera.site)
        X_WC = SE3.from_rotation(camera.xmat.reshape(3, 3), camera.xpos)
        targets = {**self._objects, **self._people}
        seen = self._sight(targets, X_WC, stamp_s)
        return Sightings(
            stamp_s=stamp_s,
            objects=tuple(item for item in seen if item.id in self._objects),
            people=tuple(item for item in seen if item.id in self._people),
            source="oracle",
        )

    def _sight(self, targets: dict[str, _Target], X_WC: SE3, stamp_s: float) -> list[Sighting]:
        X_CW, eye = X_WC.inverse(), np.array(X_WC.p)
        poses = {id: target.pose(self._data) for id, target in targets.items()}
        rays = {
            id: vectors
            for id, target in targets.items()
            if len(vectors := self._in_view(target, poses[id], X_CW) - eye) >= MIN_POINTS
        }
        if not rays:
            return []
        hits = self._rays.bodies_hit(eye, np.concatenate(list(rays.values())))
        found: list[Sighting] = []
        for id, vectors in rays.items():
            hit, hits = hits[: len(vectors)], hits[len(vectors) :]
            if np.count_nonzero(hit == targets[id].body) >= MIN_POINTS:
                X_WO = poses[id]
                sighted = SE3(_moved(X_WO, self._offset(id, stamp_s)), X_WO.quat_wxyz)
                found.append(Sighting(id=id, X_CO=X_CW @ sighted))
        return found

    def _in_view(self, target: _Target, X_WO: SE3, X_CW: SE3) -> Array:
        """The sample points [m], shape (k, 3) in W, that lie inside the camera's view and range."""
        points_W = target.points @ X_WO.rotation().T + np.array(X_WO.p)
        x, y, depth = (points_W @ X_CW.rotation().T + np.array(X_CW.p)).T
        inside = (depth > NEAR_M) & (depth < self._camera.range_m)
        inside &= (np.abs(x) < self._tan[0] * depth) & (np.abs(y) < self._tan[1] * depth)
        return points_W[inside]

    def _offset(self, id: str, stamp_s: float) -> Array:
        """The error of an object's sighted position: the same while it stays in view."""
        if stamp_s - self._seen_s.get(id, -math.inf) > FORGET_S:
            direction = self._rng.standard_normal(3)
            self._error[id] = direction * (self._pose_error_m / np.linalg.norm(direction))
        self._seen_s[id] = stamp_s
        return self._error[id] + self._rng.standard_normal(3) * JITTER_M


class _Target:
    """Something that can be seen: its body, where its pose is kept, its sample points."""

    def __init__(self, model: mujoco.MjModel, body: str, half_m: Array) -> None:
        self.body = int(model.body(body).id)
        self.points = SAMPLES * half_m
        self._mocap = int(model.body_mocapid[self.body])
        if self._mocap >= 0:  # a person's origin is between the feet
            heights = np.array([0.2, 0.35, 0.5, 0.65, 0.74, 0.8, 0.93])
            self.points = np.outer(heights, [0.0, 0.0, half_m[2]])
        else:
            self._q = int(model.jnt_qposadr[model.body_jntadr[self.body]])

    def pose(self, data: mujoco.MjData) -> SE3:
        if self._mocap >= 0:
            i = self._mocap
            return _pose(np.concatenate([data.mocap_pos[i], data.mocap_quat[i]]))
        return _pose(data.qpos[self._q : self._q + 7])


def _about(X_WB: SE3, X_off: SE3) -> SE3:
    """A pose shifted in the world and turned about itself, both by `X_off`."""
    x, y, z = X_WB.p
    turned = SE3.from_xy_yaw(0.0, 0.0, X_off.yaw_rad) @ SE3((0.0, 0.0, 0.0), X_WB.quat_wxyz)
    return SE3((x + X_off.p[0], y + X_off.p[1], z), turned.quat_wxyz)


def _pose(values: Array) -> SE3:
    x, y, z, qw, qx, qy, qz = (float(value) for value in values)
    norm = math.sqrt(qw * qw + qx * qx + qy * qy + qz * qz)
    return SE3((x, y, z), (qw / norm, qx / norm, qy / norm, qz / norm))


def _moved(X_WO: SE3, offset: Array) -> tuple[float, float, float]:
    x, y, z = X_WO.p
    return (x + float(offset[0]), y + float(offset[1]), z + float(offset[2]))
