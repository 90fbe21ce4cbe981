"""What a plant looks like, for whoever draws it elsewhere: a `robot.reality.visual_scene`."""

# pyright: basic

from __future__ import annotations

from typing import Any, Literal

import mujoco
import numpy as np

from robot.model.description import RobotDescription
from robot.reality.visual_scene import (
    Camera,
    Flat,
    Geom,
    Joint,
    Kind,
    Mesh,
    Rgba,
    Role,
    Site,
    VisualBody,
    VisualScene,
)
from sim.bodies import BUMP, SILL
from sim.plant import Plant
from sim.rays import UNSENSED

SHOWN_GROUPS = (0, 1, 2, UNSENSED)
"""As in the pictures of `sim.render`: the shapes of collisions alone are left out."""
FREE = mujoco.mjtJoint.mjJNT_FREE.value
JOINTS: dict[int, Literal["hinge", "slide"]] = {
    mujoco.mjtJoint.mjJNT_HINGE.value: "hinge",
    mujoco.mjtJoint.mjJNT_SLIDE.value: "slide",
}
KINDS: dict[int, Kind] = {
    mujoco.mjtGeom.mjGEOM_BOX.value: "box",
    mujoco.mjtGeom.mjGEOM_SPHERE.value: "sphere",
    mujoco.mjtGeom.mjGEOM_ELLIPSOID.value: "ellipsoid",
    mujoco.mjtGeom.mjGEOM_CYLINDER.value: "cylinder",
    mujoco.mjtGeom.mjGEOM_CAPSULE.value: "capsule",
    mujoco.mjtGeom.mjGEOM_MESH.value: "mesh",
}
"""The plane that all stands on is left out: whoever draws has a ground."""
ROLES: dict[str, Role] = {
    "object": "object", "person": "person", "wall": "wall", "furniture": "furniture",
}  # fmt: skip
MESH = mujoco.mjtGeom.mjGEOM_MESH.value
NO_COLOUR = (0.5, 0.5, 0.5, 1.0)
"""MuJoCo's own: a geom with it has that of its material."""
WHERE_LIGHT, WHERE_DARK = (0.25, 0.25), (0.75, 0.25)
"""In a checker's texture, as parts of its width and height."""


def scene(plant: Plant) -> VisualScene:
    """Its bodies as they stand now, the robot's joints at 0 but for the base's pose."""
    return _Reading(plant).scene()


class _Reading:
    def __init__(self, plant: Plant) -> None:
        self._model: Any = plant.model
        self._data: Any = plant.data
        self._robot = plant.robot
        self._world = plant.world
        self._titles = {
            f"{kind}/{item.id}": item.title
            for kind, items in (
                ("object", plant.world.objects),
                ("person", plant.world.people),
                ("furniture", plant.world.furniture),
            )
            for item in items
        }
        self._motors = _motors(self._model, plant.robot)

    def scene(self) -> VisualScene:
        model, count = self._model, self._model.nbody
        base = int(model.body(self._robot.base_body).id)
        foot = next(iter(self._robot.feet.values()))
        meshes = tuple(self._mesh(number) for number in range(model.nmesh))
        return VisualScene(
            bodies=tuple(self._body(number, base) for number in range(count)),
            meshes=meshes,
            base=base,
            motors=len(self._robot.motor_names),
            posture=self._robot.posture("nominal"),
            bounds_m=self._world.bounds_m,
            camera=self._camera(),
            lidar=self._site(self._robot.sensors.lidar.site),
            grasps={side: self._site(hand.grasp_site) for side, hand in self._robot.hands.items()},
            sole_m=(foot.half_length_m, foot.half_width_m),
            motor_names=self._robot.motor_names,
            torque_limits_nm=tuple(one.torque_limit_nm for one in self._robot.motors.values()),
        )

    def _site(self, name: str) -> Site:
        site = self._model.site(name)
        return Site(body=int(site.bodyid[0]), X_BS=_flat(site.pos, site.quat))

    def _camera(self) -> Camera:
        camera = self._robot.sensors.camera
        site = self._site(camera.site)
        return Camera(
            body=site.body,
            X_BS=site.X_BS,
            fovy_rad=camera.fovy_rad,
            width=camera.width,
            height=camera.height,
        )

    def _body(self, number: int, base: int) -> VisualBody:
        model, data = self._model, self._data
        name = str(model.body(number).name)
        kind, slash, rest = name.partition("/")
        of_floor = number == 0 or name in (SILL, BUMP)
        role: Role = "floor" if of_floor else ROLES[kind] if slash else "robot"
        parent = -1 if number == 0 else int(model.body_parentid[number]) or -1
        joints = range(
            model.body_jntadr[number], model.body_jntadr[number] + model.body_jntnum[number]
        )
        loose = number == base or parent < 0
        pose = (
            (data.xpos[number], data.xquat[number])
            if loose
            else (model.body_pos[number], model.body_quat[number])
        )
        first, geoms = model.body_geomadr[number], model.body_geomnum[number]
        return VisualBody(
            id=rest if slash else name,
            role=role,
            name=self._titles.get(name, ""),
            X_PB=_flat(*pose),
            parent=parent,
            joints=tuple(self._joint(one) for one in joints if model.jnt_type[one] in JOINTS)
            if role == "robot"
            else (),
            geoms=tuple(
                self._geom(one)
                for one in range(first, first + geoms)
                if model.geom_group[one] in SHOWN_GROUPS and int(model.geom_type[one]) in KINDS
            ),
        )

    def _joint(self, number: int) -> Joint:
        model = self._model
        motor, gain = self._motors.get(number, (-1, 0.0))
        return Joint(
            kind=JOINTS[int(model.jnt_type[number])],
            axis=_three(model.jnt_axis[number]),
            at_m=_three(model.jnt_pos[number]),
            motor=motor,
            gain=gain,
        )

    def _geom(self, number: int) -> Geom:
        model = self._model
        kind = KINDS[int(model.geom_type[number])]
        tile_m, rgba2, rgba = (0.0, 0.0), None, self._colour(number)
        checker = self._checker(number)
        if checker is not None:
            rgba, rgba2, tile_m = checker
        return Geom(
            kind=kind,
            size_m=_three(model.geom_size[number]),
            X_BG=_flat(model.geom_pos[number], model.geom_quat[number]),
            rgba=rgba,
            rgba2=rgba2,
            tile_m=tile_m,
            mesh=int(model.geom_dataid[number]) if kind == "mesh" else -1,
        )

    def _colour(self, number: int) -> Rgba:
        model = self._model
        own, material = model.geom_rgba[number], int(model.geom_matid[number])
        if material >= 0 and np.allclose(own, NO_COLOUR):
            own = model.mat_rgba[material]
        picture = self._picture(number)
        if picture is not None and model.geom_type[number] == MESH:
            own = (*(picture.mean(axis=(0, 1)) / 255.0), 1.0)  # nobody draws prints elsewhere
        red, green, blue, alpha = (round(float(one), 3) for one in own)
        return (red, green, blue, alpha)

    def _checker(self, number: int) -> tuple[Rgba, Rgba, tuple[float, float]] | None:
        """The two colours of a floor covering, and the size of its tiles."""
        model, pixels = self._model, self._picture(number)
        if pixels is None or model.geom_type[number] == MESH:
            return None
        height, width = pixels.shape[:2]

        def at(where: tuple[float, float]) -> Rgba:
            red, green, blue = pixels[int(where[1] * height)][int(where[0] * width)] / 255.0
            return (round(float(red), 3), round(float(green), 3), round(float(blue), 3), 1.0)

        repeat = model.mat_texrepeat[int(model.geom_matid[number])]
        half = model.geom_size[number]
        tile_m = (float(half[0] / repeat[0]), float(half[1] / repeat[1]))
        return at(WHERE_LIGHT), at(WHERE_DARK), tile_m

    def _picture(self, number: int) -> Any:
        """The texture of a geom, shape (height, width, 3), 8 bit; None: it has none."""
        model = self._model
        material = int(model.geom_matid[number])
        if material < 0:
            return None
        texture = int(model.mat_texid[material][mujoco.mjtTextureRole.mjTEXROLE_RGB.value])
        if texture < 0:
            return None
        width, height = int(model.tex_width[texture]), int(model.tex_height[texture])
        start = int(model.tex_adr[texture])
        return model.tex_data[start : start + width * height * 3].reshape(height, width, 3)

    def _mesh(self, number: int) -> Mesh:
        model = self._model
        first, count = int(model.mesh_vertadr[number]), int(model.mesh_vertnum[number])
        face, faces = int(model.mesh_faceadr[number]), int(model.mesh_facenum[number])
        return Mesh(
            points_m=model.mesh_vert[first : first + count].astype("<f4").tobytes(),
            faces=model.mesh_face[face : face + faces].astype("<u4").tobytes(),
        )


def _motors(model: Any, robot: RobotDescription) -> dict[int, tuple[int, float]]:
    """By joint: the motor that moves it, and by how much; coupled joints too."""
    motors = {
        int(model.joint(motor.joint).id): (place, 1.0)
        for place, motor in enumerate(robot.motors.values())
    }
    for one in range(model.neq):
        if model.eq_type[one] == mujoco.mjtEq.mjEQ_JOINT and int(model.eq_obj2id[one]) in motors:
            place, _ = motors[int(model.eq_obj2id[one])]
            motors[int(model.eq_obj1id[one])] = (place, float(model.eq_data[one][1]))
    return motors


def _three(values: Any) -> tuple[float, float, float]:
    x, y, z = (round(float(one), 5) for one in values)
    return (x, y, z)


def _flat(position: Any, quaternion_wxyz: Any) -> Flat:
    x, y, z = _three(position)
    a, b, c, d = (round(float(one), 6) for one in quaternion_wxyz)
    return (x, y, z, a, b, c, d)
