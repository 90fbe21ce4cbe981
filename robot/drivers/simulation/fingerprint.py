"""The hash by which plant and controller make sure that they mean the same robot."""

from __future__ import annotations

import hashlib

import msgspec

from robot.model.description import RobotDescription


def fingerprint(description: RobotDescription) -> bytes:
    """SHA-256 of the description and its MJCF, wherever they lie, 32 bytes."""
    placeless = msgspec.structs.replace(description, folder="")
    digest = hashlib.sha256(msgspec.json.encode(placeless))
    digest.update(description.mjcf_path().read_bytes())
    return digest.digest()
