"""What a run's outcome depends on besides what was asked: software, world, robot; as hashes."""

from __future__ import annotations

import hashlib
import importlib.metadata
import platform
from functools import cache
from pathlib import Path

import msgspec

import executive
from robot.model.description import RobotDescription
from robot.reality.contract import World

PACKAGES = ("executive", "intents", "robot", "sim")
LIBRARIES = ("mujoco", "numpy", "ompl", "daqp", "py-trees")


class Origin(msgspec.Struct, frozen=True, kw_only=True):
    """Hashes of contents (SHA-256, the first 16 digits) and versions of what computes.

    Attributes:
        software: of every module of this package.
        world: of the world as it was loaded, shuffled where that was asked for.
        robot: of the description and its MJCF.
        versions: of the package, Python, and the libraries that have a say in the result.
    """

    software: str
    world: str
    robot: str
    versions: dict[str, str]


def of(world: World, robot: RobotDescription) -> Origin:
    """The origin of a run that starts now."""
    return Origin(
        software=software(),
        world=_digest(world.content()),
        robot=robot.digest().hex()[:16],
        versions=versions(),
    )


def differences(then: Origin, now: Origin) -> list[str]:
    """What is not as it was, in words; empty when all is the same."""
    found = [
        f"the {name} is another one"
        for name in ("world", "robot")
        if getattr(then, name) != getattr(now, name)
    ]
    if then.software != now.software:
        found.append("the software is another one")
    for name in sorted({*then.versions, *now.versions}):
        before, after = then.versions.get(name, "none"), now.versions.get(name, "none")
        if before != after:
            found.append(f"{name} was {before}, is {after}")
    return found


@cache
def software() -> str:
    """Hash of every module of the four packages, wherever they lie."""
    root = Path(executive.__file__).parent.parent
    digest = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def versions() -> dict[str, str]:
    """Versions of the package, Python, and the libraries that have a say in the result."""
    found = {"humanoid-executive": _version("humanoid-executive")}
    found |= {name: _version(name) for name in LIBRARIES}
    return {**found, "python": platform.python_version()}


def _version(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "none"


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]
