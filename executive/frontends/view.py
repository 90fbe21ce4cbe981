"""`humanoid view`: a picture of a world, or MuJoCo's own viewer."""

from __future__ import annotations

import os
from pathlib import Path

from executive.frontends.composition_root import REALITY
from executive.frontends.new_files import refuse_inputs
from executive.frontends.output import say
from executive.meaning.request import setting
from robot.errors import ConfigError, Problem

PICTURES = (".png", ".jpg", ".jpeg")


def look(world: str, robot: str, *, seed: int, snapshot: Path | None) -> int:
    """Render into a file, or open the viewer; returns the exit status.

    Raises:
        ConfigError: the display or a file is missing; the error names the cure.
    """
    if snapshot is None and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        cure = "make a picture instead: humanoid view --snapshot out.png"
        raise ConfigError([Problem("there is no display", suggestion=cure)])
    refuse_inputs([snapshot], [Path(world), Path(robot)])
    if snapshot is not None and snapshot.suffix.lower() not in PICTURES:
        cure = f"call it {snapshot.stem or 'world'}.png"
        text = f"pictures are written as {', '.join(PICTURES)}"
        raise ConfigError([Problem(text, str(snapshot), suggestion=cure)])
    where = setting(REALITY, world, robot=robot)
    plant = where.world.plant(where.description, seed=seed)
    if snapshot is None:
        plant.show()
        return 0
    try:
        plant.save_picture(snapshot)
    except OSError as error:
        text = f"cannot be written: {error.strerror}"
        raise ConfigError(
            [Problem(text, str(snapshot), suggestion="choose another file")]
        ) from None
    say(f"Done: {snapshot}")
    return 0
