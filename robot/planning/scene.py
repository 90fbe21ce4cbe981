"""The planner's own MuJoCo model: the robot among solids, for asking what touches what.

Compiling one takes about 2 ms, so a scene is made for each request and nothing in it moves but the
robot; a few are kept by content. A geom's margin is the clearance asked for, so that any contact
MuJoCo reports is too near.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from itertools import product
from typing import TypeAlias

import mujoco
import numpy as np

from robot.messages import Side
from robot.model import mjcf
from robot.model.description import RobotDescription
from robot.planning.numerics import Indices, Mask
from robot.planning.requests import Held
from robot.planning.solids import Solid
from robot.se3 import SE3, Array

HELD = "held"
SELF_CLEARANCE_M = 0.004
"""Clearance of the robot from itself, split between two geoms [m]."""

_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
_KINDS = {"box": mujoco.mjtGeom.mjGEOM_BOX, "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER}


@dataclass(frozen=True, slots=True)
class Touch:
    """Two things nearer to each other than they should be; `distance_m` < 0: they overlap."""

    first: str
    second: str
    distance_m: float

    def __str__(self) -> str:
        """`right_hand and table`."""
        return f"{self.first} and {self.second}"


class Scene:
    """The robot among solids, one of its hands perhaps holding something.

    Motor values are in motor order (fingers in m). Contacts count when they involve a geom that
    was asked about, are nearer than the clearance, and are not between names that may touch.
    """

    def __init__(
        self,
        robot: RobotDescription,
        solids: tuple[Solid, ...] = (),
        held: tuple[Side, Held] | None = None,
        thing: tuple[Solid, ...] = (),
    ) -> None:
        """Compile the model; `thing` are solids on one body, which `move_thing` puts elsewhere."""
        self.robot = robot
        self.model, self._owner = _compile(robot, solids, held, thing)
        self.data = mujoco.MjData(self.model)
        self._bind()

    def _bind(self) -> None:
        model = self.model
        joints = [model.joint(motor.joint) for motor in self.robot.motors.values()]
        self._addresses: Indices = np.array([int(joint.qposadr[0]) for joint in joints])
        self._couplings = [
            (
                int(model.jnt_qposadr[model.eq_obj1id[e]]),
                int(model.jnt_qposadr[model.eq_obj2id[e]]),
                model.eq_data[e, :2].copy(),
            )
            for e in range(model.neq)
            if model.eq_type[e] == mujoco.mjtEq.mjEQ_JOINT and model.eq_obj2id[e] >= 0
        ]
        self.solid_geoms = np.array([owner.startswith("solid:") for owner in self._owner])
        self.names = [owner.removeprefix("solid:") for owner in self._owner]
        self.solids = {
            name for name, owner in zip(self.names, self._owner, strict=True) if name != owner
        }
        self._held = np.array([owner == HELD for owner in self._owner])
        self._arms = {
            side: self._geoms_below(self._shoulder(side)) for side in self.robot.arm_sides
        }
        self.trunk_geoms = ~np.any([self.solid_geoms, *self._arms.values()], axis=0)
        self._grasp_sites = {
            side: model.site(hand.grasp_site).id for side, hand in self.robot.hands.items()
        }

    # --- posing ----------------------------------------------------------------------------

    def pose(self, X_WB: SE3, q_rad: Array | tuple[float, ...]) -> None:
        """Put the base at X_WB and all motors at `q_rad`, shape (motors,)."""
        qpos = self.data.qpos
        qpos[:3] = X_WB.p
        qpos[3:7] = X_WB.quat_wxyz
        qpos[self._addresses] = q_rad
        self._couple()

    def set_motors(self, indices: Indices, values: Array | list[float]) -> None:
        """Move some motors, given by their indices."""
        self.data.qpos[self._addresses[indices]] = values

    def _couple(self) -> None:
        qpos = self.data.qpos
        for driven, driver, poly in self._couplings:
            qpos[driven] = poly[0] + poly[1] * qpos[driver]

    def move_thing(self, X_WG: SE3) -> None:
        """Put the movable solids elsewhere."""
        self.data.mocap_pos[0] = X_WG.p
        self.data.mocap_quat[0] = X_WG.quat_wxyz

    def update(self) -> None:
        """Recompute where everything is."""
        mujoco.mj_kinematics(self.model, self.data)

    def body_pose(self, name: str) -> SE3:
        """Pose of a body in W, after `update`."""
        body = self.model.body(name).id
        return SE3.from_rotation(self.data.xmat[body].reshape(3, 3), self.data.xpos[body])

    def grasp_pose(self, side: Side) -> SE3:
        """X_WG of a hand, after `update`."""
        site = self._grasp_sites[side]
        return SE3.from_rotation(self.data.site_xmat[site].reshape(3, 3), self.data.site_xpos[site])

    def grasp_rotation(self, side: Side) -> Array:
        """R_WG of a hand, row-major, shape (9,), after `update`."""
        return self.data.site_xmat[self._grasp_sites[side]]

    # --- touching --------------------------------------------------------------------------

    def arm_geoms(self, side: Side) -> Mask:
        """Which geoms an arm moves, the held thing included, shape (geoms,), bool."""
        return self._arms[side]

    def rest_geoms(self, side: Side) -> Mask:
        """The robot's geoms that the arm of `side` does not move."""
        return ~(self._arms[side] | self.solid_geoms)

    def _shoulder(self, side: Side) -> int:
        """Body id of the first link of an arm."""
        first = self.robot.motors[self.robot.groups[f"{side}_arm"][0]].joint
        return int(self.model.joint(first).bodyid[0])

    def _geoms_below(self, root: int) -> Mask:
        """Which geoms hang on a body and on what moves with it."""
        result = np.zeros(self.model.ngeom, dtype=bool)
        for geom in range(self.model.ngeom):
            body = int(self.model.geom_bodyid[geom])
            while body not in (root, 0):
                body = int(self.model.body_parentid[body])
            result[geom] = body == root
        return result

    def set_clearance(
        self,
        clearance_m: float,
        *,
        special: dict[str, float] | None = None,
        held_m: float = 0.0,
    ) -> None:
        """Ask for this distance to every solid, or another to those named in `special` [m].

        `held_m` is added to all distances of the held thing.
        """
        margin = np.where(self.solid_geoms, clearance_m, 0.5 * SELF_CLEARANCE_M)
        margin[self._held] = held_m
        for geom in np.flatnonzero(self.solid_geoms):
            if special and self.names[geom] in special:
                margin[geom] = special[self.names[geom]]
        self.model.geom_margin[:] = margin
        # The broad phase goes by bodies: their margins are the largest of their geoms'.
        self.model.body_margin[:] = 0.0
        np.maximum.at(self.model.body_margin, self.model.geom_bodyid, margin)

    def around_m(self, geoms: Mask, X_WS: SE3) -> float:
        """Radius of the upright cylinder about a stance that holds some geoms [m], after `update`.

        Boxes around each count, so it is a few millimetres more than the truth.
        """
        rows = np.flatnonzero(geoms)
        rotation = self.data.geom_xmat[rows].reshape(-1, 1, 3, 3)
        centre, half = self.model.geom_aabb[rows, None, :3], self.model.geom_aabb[rows, None, 3:]
        corners = (rotation @ (centre + _CORNERS * half)[..., None])[..., 0]
        at = corners[..., :2] + self.data.geom_xpos[rows, None, :2] - np.array(X_WS.p[:2])
        return float(np.max(np.linalg.norm(at, axis=-1)))

    def touches(
        self,
        geoms: Mask,
        *,
        allowed: frozenset[str] = frozenset(),
        slack: dict[tuple[str, str], float] | None = None,
        solids_only: bool = False,
    ) -> list[Touch]:
        """What is too near to one of `geoms` (a bool a geom), after `update`.

        Args:
            geoms: which geoms are asked about.
            allowed: solids (by id) that may be touched.
            slack: pairs (part of the robot, thing or other part) that may come as near as this [m].
            solids_only: leave out the robot touching itself.
        """
        mujoco.mj_collision(self.model, self.data)
        if not self.data.ncon:
            return []
        found: list[Touch] = []
        pairs: list[list[int]] = self.data.contact.geom.tolist()
        distances: list[float] = self.data.contact.dist.tolist()
        for pair, distance in zip(pairs, distances, strict=True):
            a, b = reversed(pair) if self.solid_geoms[pair[0]] else pair
            if not (geoms[a] or geoms[b]):
                continue
            first, second = self.names[a], self.names[b]
            if second in allowed or (solids_only and not self.solid_geoms[b]):
                continue
            if slack and distance > slack.get((first, second), np.inf):
                continue
            found.append(Touch(first, second, distance))
        return found


_Key: TypeAlias = tuple[tuple[Solid, ...], tuple[Side, Held] | None, tuple[Solid, ...]]


class SceneCache:
    """The last few scenes, by content: requests of one moment share their model."""

    def __init__(self, robot: RobotDescription, *, size: int = 6) -> None:
        """Start empty."""
        self._robot = robot
        self._size = size
        self._scenes: OrderedDict[_Key, Scene] = OrderedDict()

    def get(
        self,
        solids: tuple[Solid, ...],
        held: tuple[Side, Held] | None = None,
        thing: tuple[Solid, ...] = (),
    ) -> Scene:
        """A scene of these; its poses and clearance are whatever was asked for last."""
        key = (solids, held, thing)
        scene = self._scenes.pop(key, None) or Scene(self._robot, solids, held, thing)
        self._scenes[key] = scene
        while len(self._scenes) > self._size:
            self._scenes.popitem(last=False)
        return scene


MOST_SPECS = 2
"""Robots whose MJCF is kept: one that is planned for, and another in an evaluation of several."""
_SPECS: OrderedDict[mjcf.Source, mujoco.MjSpec] = OrderedDict()
_LOCK = threading.Lock()


def _robot_spec(robot: RobotDescription) -> mujoco.MjSpec:
    """The robot's MJCF without what never touches anything; read once."""
    key = robot.source
    with _LOCK:
        if key not in _SPECS:
            spec = mjcf.spec(key)
            for geom in list(spec.geoms):
                if geom.contype == 0 and geom.conaffinity == 0:
                    spec.delete(geom)
            used = {geom.meshname for geom in spec.geoms}
            for mesh in [mesh for mesh in spec.meshes if mesh.name not in used]:
                spec.delete(mesh)
            for sensor in list(spec.sensors):
                spec.delete(sensor)
            # Nothing has a weight here; but a link whose mass came from a geom that is gone would
            # be refused.
            spec.compiler.boundmass = spec.compiler.boundinertia = 1e-6
            _SPECS[key] = spec
            while len(_SPECS) > MOST_SPECS:
                _SPECS.popitem(last=False)
        _SPECS.move_to_end(key)
        return _SPECS[key].copy()


def _compile(
    robot: RobotDescription,
    solids: tuple[Solid, ...],
    held: tuple[Side, Held] | None,
    thing: tuple[Solid, ...],
) -> tuple[mujoco.MjModel, list[str]]:
    """The model, and the owner of each geom: a body's name, `held`, or `solid:` and an id."""
    spec = _robot_spec(robot)
    for index, solid in enumerate(solids):
        geom = spec.worldbody.add_geom(name=f"solid/{index}", contype=0, conaffinity=1)
        _shape(geom, solid.kind, solid.size_m, solid.X_WG)
    if held is not None:
        side, load = held
        hand = spec.body(robot.hands[side].body)
        geom = hand.add_geom(name=HELD, contype=1, conaffinity=1)
        X_HandG = _site_pose(spec, robot.hands[side].grasp_site)
        _shape(
            geom, load.shape.kind, load.shape.size_m, X_HandG @ load.X_GO @ load.shape.X_BodyShape
        )
        for piece in load.shape.sticking_out:
            more = hand.add_geom(contype=1, conaffinity=1, name=f"{HELD}{len(hand.geoms)}")
            X_GP = load.X_GO @ load.shape.X_BodyShape @ piece.X_ShapePiece
            _shape(more, piece.kind, piece.size_m, X_HandG @ X_GP)
        for finger in robot.hands[side].finger_bodies:
            spec.add_exclude(bodyname1=robot.hands[side].body, bodyname2=finger)
    if thing:
        body = spec.worldbody.add_body(name="thing", mocap=True)
        for index, part in enumerate(thing):
            geom = body.add_geom(name=f"thing/{index}", contype=0, conaffinity=1)
            _shape(geom, part.kind, part.size_m, part.X_WG)
    model = spec.compile()
    owners: list[str] = []
    for geom in range(model.ngeom):
        name = model.geom(geom).name
        if name.startswith("solid/"):
            owners.append("solid:" + solids[int(name.removeprefix("solid/"))].id)
        elif name.startswith(HELD):
            owners.append(HELD)
        elif name.startswith("thing/"):
            owners.append("solid:" + thing[int(name.removeprefix("thing/"))].id)
        else:
            owners.append(model.body(int(model.geom_bodyid[geom])).name)
    return model, owners


def _site_pose(spec: mujoco.MjSpec, name: str) -> SE3:
    site = spec.site(name)
    x, y, z = (float(value) for value in site.pos)
    w, i, j, k = (float(value) for value in site.quat)
    norm = float(np.sqrt(w * w + i * i + j * j + k * k))
    return SE3((x, y, z), (w / norm, i / norm, j / norm, k / norm))


def _shape(geom: object, kind: str, size_m: tuple[float, float, float], pose: SE3) -> None:
    """Give a spec's geom a primitive's form and place (the bindings have no types)."""
    x, y, z = size_m
    size = [x / 2, y / 2, z / 2] if kind == "box" else [x / 2, z / 2, 0.0]
    for name, value in (
        ("type", _KINDS[kind]),
        ("size", size),
        ("pos", list(pose.p)),
        ("quat", list(pose.quat_wxyz)),
        ("mass", 0.001),
    ):
        setattr(geom, name, value)
