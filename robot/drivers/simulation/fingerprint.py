"""The hash by which plant and controller make sure that they mean the same robot."""

from __future__ import annotations

from robot.model.description import RobotDescription


def fingerprint(description: RobotDescription) -> bytes:
    """SHA-256 of the description and its MJCF, wherever they lie, 32 bytes."""
    return description.digest()
