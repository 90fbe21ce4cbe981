"""Other bodies, made of Juno: without hands, without a neck, smaller."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec
import mujoco
import pytest
from msgspec.structs import asdict, replace

from robot.errors import ConfigError
from robot.model import description
from robot.model.description import RobotDescription

JUNO = description.load()


def shipped_or_skip(name: str) -> str:
    """The name of a robot that comes along, where the published model that it may need is here."""
    try:
        description.load(name)
    except ConfigError as error:
        if name == "juno":
            raise
        pytest.skip(f"no model of the {name} here: {error}")
    return name


def handless() -> RobotDescription:
    """Arms that end at the wrist; the fingers hang on, but no motor moves them."""
    robot = _without_motors(JUNO, "gripper")
    return replace(robot, name="handless", hands={}, handling=None)


def neckless(folder: Path) -> RobotDescription:
    """The head fixed to the trunk; it looks with its waist."""
    robot = _without_motors(JUNO, "head_")
    text = Path(JUNO.source.path).read_text()
    text = re.sub(r'<(joint|general) name="head_[^>]*/>', "", text)
    (folder / "juno.xml").write_text(text)
    gaze = replace(JUNO.gaze, waist_yaw_rad=0.8, waist_pitch_rad=(-0.3, 0.4))
    return replace(robot, name="neckless", gaze=gaze, folder=str(folder), mjcf_folder=str(folder))


def stiff(folder: Path) -> RobotDescription:
    """A waist that only turns: it bends forward at its hips."""
    robot = _without_motors(_without_motors(JUNO, "waist_roll"), "waist_pitch")
    text = Path(JUNO.source.path).read_text()
    text = re.sub(r'<(joint|general) name="waist_(roll|pitch)"[^>]*/>', "", text)
    (folder / "juno.xml").write_text(text)
    return replace(robot, name="stiff", folder=str(folder), mjcf_folder=str(folder))


def smaller(folder: Path, scale: float = 0.9) -> RobotDescription:
    """Every length smaller, the masses as they are."""
    spec = mujoco.MjSpec.from_file(JUNO.source.path)
    for one in [*spec.bodies, *spec.geoms, *spec.sites, *spec.cameras]:
        one.pos = scale * one.pos
    for body in spec.bodies:
        body.ipos = scale * body.ipos
    for geom in spec.geoms:
        geom.size = scale * geom.size
        geom.fromto = scale * geom.fromto
    spec.compile()
    (folder / "juno.xml").write_text(spec.to_xml())
    walking = _scaled(
        JUNO.walking, ("base_height_m", "stance_width_m", "min_stance_width_m"), scale
    )
    balance = _scaled(JUNO.balance, ("lowest_base_m", "highest_base_m", "squat_base_m"), scale)
    feet = {
        side: _scaled(foot, ("half_length_m", "half_width_m"), scale)
        for side, foot in JUNO.feet.items()
    }
    return replace(
        JUNO, name="smaller", walking=walking, balance=balance, feet=feet, shoulder_height_m=0.0,
        arm_reach_m=0.0, shoulder_aside_m=0.0, folder=str(folder), mjcf_folder=str(folder),
    )  # fmt: skip


def written(robot: RobotDescription, folder: Path) -> str:
    """The description as a file (JSON is YAML), its MJCF beside it; gives its path."""
    path = folder / f"{robot.name}.yaml"
    if not (folder / robot.mjcf).exists():
        (folder / robot.mjcf).write_text(Path(robot.source.path).read_text())
    path.write_bytes(msgspec.json.encode(robot))
    return str(path)


def _without_motors(robot: RobotDescription, part: str) -> RobotDescription:
    """Without the motors whose names say so; it does not know how to get up any more."""
    postures = {
        name: {motor: value for motor, value in posture.items() if part not in motor}
        for name, posture in robot.postures.items()
    }
    return replace(
        robot,
        motors={name: motor for name, motor in robot.motors.items() if part not in name},
        groups={
            group: tuple(name for name in names if part not in name)
            for group, names in robot.groups.items()
        },
        postures=postures,
        getting_up=None,
    )


def _scaled(struct, fields: tuple[str, ...], scale: float):
    values = asdict(struct)
    return replace(struct, **{field: scale * values[field] for field in fields})
