"""What was measured of a robot's joints: `identified.yaml` beside its description.

`humanoid motors identify` writes it, and simulations read it in every reality but `ideal`:

joints:
  left_knee: {friction_nm: 0.61, viscous_nm_s: 0.08, delay_s: 0.0052, backlash_rad: 0.0021}
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, TypeAlias

import msgspec
from msgspec import Meta

from robot.files import config
from robot.files import quantities as q
from robot.files.ordinary_files import write_ordinary
from robot.model.description import RobotDescription

FILE = "identified.yaml"
HEAD = "# What was measured of joints (humanoid motors identify); simulations read it.\n"

RubbingTorque: TypeAlias = Annotated[float, Meta(ge=0.0, le=200.0, extra={"unit": "N m"})]
Rubbing: TypeAlias = Annotated[float, Meta(ge=0.0, le=200.0, extra={"unit": "N m s/rad"})]
Play: TypeAlias = Annotated[float, Meta(ge=0.0, le=0.5, extra={"unit": "rad"})]


class Joint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One joint, as it is, at the joint.

    Attributes:
        friction_nm: Coulomb friction.
        viscous_nm_s: friction that grows with speed, per rad/s.
        delay_s: from a command to its torque.
        backlash_rad: play between motor and joint.
    """

    friction_nm: RubbingTorque
    viscous_nm_s: Rubbing = 0.0
    delay_s: q.Lag
    backlash_rad: Play


class _File(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    joints: dict[str, Joint]


def beside(robot: RobotDescription) -> Mapping[str, Joint]:
    """What was measured of a robot's joints, by name; nothing if nobody did.

    Raises:
        ConfigError: the file is there and says what cannot be meant.
    """
    return read(robot.path().with_name(FILE))


def read(path: Path) -> Mapping[str, Joint]:
    """The same, of a file. Raises ConfigError as `beside`."""
    return config.load(path, _File).joints if path.exists() else {}


def write(path: Path, found: Mapping[str, Joint]) -> None:
    """Put joints in the place of what the file said of them; of others it says what it did.

    Raises:
        ConfigError: the file is there and is none of these.
        OSError: it cannot be written.
    """
    lines = [
        f"  {name}: {{" + ", ".join(f"{key}: {value:.6g}" for key, value in _items(joint)) + "}\n"
        for name, joint in ({**read(path), **found}).items()
    ]
    write_ordinary(path, (HEAD + "joints:\n" + "".join(lines)).encode())


def _items(joint: Joint) -> list[tuple[str, float]]:
    return [(key, getattr(joint, key)) for key in Joint.__struct_fields__]
