"""The user's own configuration, as far as drivers ask for it: which devices may be opened.

    # ~/.config/humanoid/config.toml
    devices = ["/dev/video0", "realsense"]

A robot's folder may be a stranger's, whoever names it: the user, a mission, a run's header. What it
says of devices is therefore a wish; only what stands here is opened.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Any, cast

from robot.errors import DeviceNotAllowed, Problem
from robot.files import plain_data
from robot.files.ordinary_files import open_ordinary

MAX_BYTES = 64_000


def folder() -> Path:
    """Where this user's configuration lies."""
    base = os.environ.get("XDG_CONFIG_HOME", "")
    # The standard wants relative ones ignored: https://specifications.freedesktop.org/basedir-spec
    above = Path(base) if Path(base).is_absolute() else Path(os.path.expanduser("~/.config"))  # noqa: PTH111 - it never raises
    return above / "humanoid"


def check_device(device: str) -> None:
    """Whether the user lets robots open a device.

    Args:
        device: its path under `/dev`, or the name of a driver that looks for its device by itself.

    Raises:
        DeviceNotAllowed: the user's file does not name it, with the cure.
    """
    file = folder() / "config.toml"
    if device not in _devices(file):
        text = f"{device} is not opened, since a robot's files may be a stranger's"
        cure = f'if it is to be, write devices = ["{device}"] into {file}'
        raise DeviceNotAllowed([Problem(text, suggestion=cure)])


def _devices(file: Path) -> list[object]:
    """The devices that a file names; none where it is not the user's alone, or cannot be read."""
    try:
        with open_ordinary(file) as opened:
            found = os.fstat(opened.fileno())
            if found.st_uid not in (0, os.geteuid()) or found.st_mode & stat.S_IWOTH:
                return []
            said = plain_data.from_toml(opened.read(MAX_BYTES).decode())
    except (OSError, ValueError):
        return []
    devices = cast("dict[str, Any]", said).get("devices")
    return list(cast("list[object]", devices)) if isinstance(devices, list) else []
