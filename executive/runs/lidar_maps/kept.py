"""Where maps are kept, and when one has to be made.

A map is known by the hash of what stands fast in its world (walls and furniture, not things, people
or where the robot begins), of the robot's lidar, and of the way maps are made. It is kept with the
user's caches; those of worlds that come with the package come with it, too.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import msgspec

from executive.meaning.request import Setting
from robot.errors import ConfigError, Problem
from robot.files.exchangeable import check_way
from robot.files.ordinary_files import make_below
from robot.files.user_state import user_cache_folder
from robot.printable import printable

SHIPPED = Path(__file__).parent / "shipped"
WAY = "led walk 1"
"""How maps are made; another word for another way, so that old ones are not taken."""
NAME_LENGTH = 40

Tell = Callable[[str], None]


def tell_on_screen(text: str) -> None:
    """Say something beside what a command writes."""
    sys.stderr.write(printable(text) + "\n")
    sys.stderr.flush()


def key_of(where: Setting) -> str:
    """What a map of this world by this robot is known by."""
    known, lidar = where.world_map, where.description.sensors.lidar
    people = {person.id for person in known.people}
    fast = [one for one in known.obstacles if one.id not in people]
    content = msgspec.json.encode([WAY, where.description.name, lidar, fast])
    return hashlib.sha256(content).hexdigest()[:16]


def needed(where: Setting, *, tell: Tell = tell_on_screen) -> Path | None:
    """The map that the robot finds itself in; None where it is told where it is.

    One that is not there is made first, which takes a while and is said.

    Raises:
        ConfigError: it cannot be made, or kept, or somebody else could exchange it.
    """
    if where.world.localisation != "lidar":
        return None
    if is_shipped(where):
        return _shipped(where)
    name, folder = _file_name(where), user_cache_folder()
    if folder is None:
        cure = "set HOME, or XDG_CACHE_HOME"
        raise ConfigError([Problem("there is no folder to keep maps in", suggestion=cure)])
    path = folder / "maps" / name
    _check_private(path)
    if not _is_whole(path, tell):
        from executive.runs.lidar_maps import led_walk  # a whole simulation
        from robot.fusion.slam import map_file  # scipy, which no other run needs

        tell(f"no map of {where.world.name} yet: leading the robot through it first (once)")
        saved = led_walk.survey(where, tell=tell)
        make_below(folder, path.parent)
        map_file.save(path, saved)
        tell(f"the map is kept as {path}")
    return path


def is_shipped(where: Setting) -> bool:
    """Whether the map of this world by this robot comes with the package."""
    return _shipped(where).is_file()


def is_kept(where: Setting) -> bool:
    """Whether there is a map of this world by this robot, so that none has to be made.

    One that cannot be read, or that somebody else could exchange, is none: nobody asked for it.
    """
    if is_shipped(where):
        return True
    folder = user_cache_folder()
    if folder is None:
        return False
    path = folder / "maps" / _file_name(where)
    if not os.path.lexists(path):
        return False
    from robot.fusion.slam import map_file  # scipy

    try:
        _check_private(path)
        map_file.load(path)
    except ConfigError:
        return False
    return True


def _shipped(where: Setting) -> Path:
    return SHIPPED / _file_name(where)


def _check_private(path: Path) -> None:
    """Refuse a map by which somebody else could tell the robot where it is."""
    cure = "set XDG_CACHE_HOME to a folder of your own"
    check_way(path.parent, cure=cure)
    with suppress(OSError):
        if path.lstat().st_uid not in (0, os.geteuid()):
            raise ConfigError([Problem("belongs to another user", str(path), suggestion=cure)])


def _is_whole(path: Path, tell: Tell) -> bool:
    """Whether a map is there that can be read; one that cannot is made again."""
    if not os.path.lexists(path):
        return False
    from robot.fusion.slam import map_file  # scipy

    try:
        map_file.load(path)
    except ConfigError as wrong:
        tell(f"{path} is made again: {wrong.problems[0].message}")
        return False
    return True


def _file_name(where: Setting) -> str:
    stem = "".join(c if c.isalnum() else "-" for c in Path(where.world.name).stem)
    return f"{stem[:NAME_LENGTH]}-{where.description.name}-{key_of(where)}.map.npz"
