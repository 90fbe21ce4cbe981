"""A robot's URDF, for other tools: written from the compiled MJCF, so that the two agree.

Links are the MJCF's bodies, each in the frame of its joint; sites become fixed links without mass.
Capsules become a cylinder with two spheres, ellipsoids (which URDF has not) the box around them,
as a picture only. What URDF cannot say (contact, sensors, armature) is left out.
"""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from robot.errors import DescriptionError, Problem
from robot.model.body import BodyModel
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array

_GEOM, _JOINT = mujoco.mjtGeom, mujoco.mjtJoint


def urdf(description: RobotDescription) -> str:
    """The robot as URDF (https://wiki.ros.org/urdf/XML), SI units, base link first.

    Raises:
        DescriptionError: the MJCF does not fit the description, or has what URDF cannot say: two
            joints on one body, a ball joint, a mesh.
    """
    return _Writer(description).text()


class _Writer:
    """Writes one robot."""

    def __init__(self, description: RobotDescription) -> None:
        self._description = description
        self._body = BodyModel(description)
        self._model: Any = self._body.model
        self._root = ET.Element("robot", name=description.name)

    def text(self) -> str:
        """The whole file."""
        for body in range(1, self._model.nbody):
            self._link(body)
            self._joint_to_parent(body)
        for site in range(self._model.nsite):
            self._frame(site)
        ET.indent(self._root)
        return ET.tostring(self._root, encoding="unicode", xml_declaration=True) + "\n"

    # --- links ---

    def _link(self, body: int) -> None:
        model = self._model
        link = ET.SubElement(self._root, "link", name=self._name(body))
        mass_kg = float(model.body_mass[body])
        if mass_kg > 0.0:
            X = _shift(_pose(model.body_ipos[body], model.body_iquat[body]), self._anchor(body))
            inertial = ET.SubElement(link, "inertial")
            _origin(inertial, X)
            ET.SubElement(inertial, "mass", value=_number(mass_kg))
            ixx, iyy, izz = (_number(value) for value in model.body_inertia[body])
            ET.SubElement(inertial, "inertia", ixx=ixx, iyy=iyy, izz=izz, ixy="0", ixz="0", iyz="0")
        first, count = int(model.body_geomadr[body]), int(model.body_geomnum[body])
        for geom in range(first, first + count):
            self._geom(link, geom, self._anchor(body))

    def _geom(self, link: ET.Element, geom: int, anchor: Array) -> None:
        model = self._model
        solid = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
        X = _shift(_pose(model.geom_pos[geom], model.geom_quat[geom]), anchor)
        for kind, sizes, X_GeomPart in self._parts(geom):
            tags = ("visual", "collision") if solid else ("visual",)
            for tag in tags:
                element = ET.SubElement(link, tag)
                _origin(element, X @ X_GeomPart)
                ET.SubElement(ET.SubElement(element, "geometry"), kind, sizes)
                if tag == "visual":
                    name = f"material_{int(model.geom_matid[geom])}"
                    material = ET.SubElement(element, "material", name=name)
                    ET.SubElement(material, "color", rgba=_numbers(self._color(geom)))

    def _parts(self, geom: int) -> list[tuple[str, dict[str, str], SE3]]:
        """The URDF shapes of a geom, each with its attributes and pose."""
        model, kind = self._model, _GEOM(int(self._model.geom_type[geom]))
        x, y, z = (float(value) for value in model.geom_size[geom])
        if kind == _GEOM.mjGEOM_SPHERE:
            return [("sphere", {"radius": _number(x)}, SE3())]
        if kind in (_GEOM.mjGEOM_BOX, _GEOM.mjGEOM_ELLIPSOID):
            return [("box", {"size": _numbers((2 * x, 2 * y, 2 * z))}, SE3())]
        if kind in (_GEOM.mjGEOM_CYLINDER, _GEOM.mjGEOM_CAPSULE):
            sizes = {"radius": _number(x), "length": _number(2 * y)}
            caps = [("sphere", {"radius": _number(x)}, SE3((0, 0, end))) for end in (y, -y)]
            return [("cylinder", sizes, SE3()), *(caps if kind == _GEOM.mjGEOM_CAPSULE else [])]
        raise self._cannot(f"geom {geom} of body {self._name(model.geom_bodyid[geom])!r}")

    def _color(self, geom: int) -> Array:
        material = int(self._model.geom_matid[geom])
        rgba = self._model.mat_rgba[material] if material >= 0 else self._model.geom_rgba[geom]
        return np.asarray(rgba, dtype=np.float64)

    # --- joints ---

    def _joint_to_parent(self, body: int) -> None:
        """The joint between a body and its parent; the base stands free."""
        model = self._model
        parent, joint = int(model.body_parentid[body]), self._joint(body)
        if parent == 0:
            return
        in_parent = _shift(_pose(model.body_pos[body], model.body_quat[body]), self._anchor(parent))
        X = in_parent @ SE3(_tuple(self._anchor(body)))
        if joint is None:
            self._fixed(f"{self._name(body)}_fixed", self._name(parent), self._name(body), X)
            return
        hinge = _JOINT(int(model.jnt_type[joint])) == _JOINT.mjJNT_HINGE
        kind = "revolute" if hinge else "prismatic"
        element = self._fixed(model.joint(joint).name, self._name(parent), self._name(body), X)
        element.set("type", kind)
        ET.SubElement(element, "axis", xyz=_numbers(model.jnt_axis[joint]))
        self._limits(element, joint)
        self._mimic(element, joint)

    def _fixed(self, name: str, parent: str, child: str, X: SE3) -> ET.Element:
        element = ET.SubElement(self._root, "joint", name=name, type="fixed")
        ET.SubElement(element, "parent", link=parent)
        ET.SubElement(element, "child", link=child)
        _origin(element, X)
        return element

    def _limits(self, element: ET.Element, joint: int) -> None:
        """Range from the MJCF, effort and velocity from the description."""
        low, high = (_number(value) for value in self._model.jnt_range[joint])
        name = self._model.joint(joint).name
        motors = [m for m in self._description.motors.values() if m.joint == name]
        effort = motors[0].torque_limit_nm if motors else 0.0
        velocity = motors[0].velocity_limit_rad_s if motors else 0.0
        ET.SubElement(
            element, "limit", lower=low, upper=high, effort=_number(effort),
            velocity=_number(velocity),
        )  # fmt: skip

    def _mimic(self, element: ET.Element, joint: int) -> None:
        """A joint that an equality couples to another one (the second finger of a hand)."""
        model = self._model
        for eq in range(model.neq):
            coupled = mujoco.mjtEq(int(model.eq_type[eq])) == mujoco.mjtEq.mjEQ_JOINT
            if coupled and model.eq_obj1id[eq] == joint and model.eq_obj2id[eq] >= 0:
                offset, gain = model.eq_data[eq][:2]
                ET.SubElement(
                    element, "mimic", joint=model.joint(int(model.eq_obj2id[eq])).name,
                    multiplier=_number(gain), offset=_number(offset),
                )  # fmt: skip

    def _joint(self, body: int) -> int | None:
        """The joint of a body, None if it is rigid or free."""
        model = self._model
        first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        if count > 1:
            raise self._cannot(f"body {self._name(body)!r} with {count} joints")
        kind = _JOINT(int(model.jnt_type[first])) if count else _JOINT.mjJNT_FREE
        if kind == _JOINT.mjJNT_FREE:
            return None
        if kind == _JOINT.mjJNT_BALL:
            raise self._cannot(f"the ball joint of body {self._name(body)!r}")
        return first

    def _anchor(self, body: int) -> Array:
        """Where the joint of a body sits in the body's frame: the link's origin, shape (3,)."""
        joint = self._joint(body)
        return np.zeros(3) if joint is None else np.array(self._model.jnt_pos[joint])

    def _frame(self, site: int) -> None:
        """A site as a link without mass."""
        model, body = self._model, int(self._model.site_bodyid[site])
        if body == 0:
            return
        name = f"{model.site(site).name}_frame"
        ET.SubElement(self._root, "link", name=name)
        X = _shift(_pose(model.site_pos[site], model.site_quat[site]), self._anchor(body))
        self._fixed(f"{name}_fixed", self._name(body), name, X)

    def _name(self, body: int) -> str:
        return str(self._model.body(body).name) or f"body_{body}"

    def _cannot(self, what: str) -> DescriptionError:
        file = str(self._description.mjcf_path())
        return DescriptionError([Problem(f"URDF cannot say {what}", file)])


def _pose(position: Any, quat_wxyz: Any) -> SE3:
    w, x, y, z = (float(value) for value in quat_wxyz)
    return SE3(_tuple(position), (w, x, y, z))


def _tuple(values: Any) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return (x, y, z)


def _shift(X: SE3, anchor: Array) -> SE3:
    """The same pose from a frame whose origin is at the anchor."""
    p = np.array(X.p) - anchor
    return SE3(_tuple(p), X.quat_wxyz)


def _origin(element: ET.Element, X: SE3) -> None:
    """An <origin>; URDF's angles are fixed-axis roll, pitch, yaw."""
    r = X.rotation()
    pitch = np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0]))
    if abs(np.cos(pitch)) > 1e-9:
        roll, yaw = np.arctan2(r[2, 1], r[2, 2]), np.arctan2(r[1, 0], r[0, 0])
    else:  # looking straight up or down: all the turning is put into the roll
        roll, yaw = np.arctan2(-r[1, 2], r[1, 1]), 0.0
    ET.SubElement(element, "origin", xyz=_numbers(X.p), rpy=_numbers((roll, pitch, yaw)))


def _number(value: Any) -> str:
    return f"{float(value):.9g}"


def _numbers(values: Any) -> str:
    return " ".join(_number(value) for value in values)
