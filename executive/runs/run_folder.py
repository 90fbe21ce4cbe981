"""The folder of a run, and what it is started with (`run.json`)."""

from __future__ import annotations

import contextlib
import errno
import os
import re
import stat
from itertools import islice
from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta

from executive.journal import holding, motion, places, sensed
from executive.journal.journal import FILE, WALL_FILE
from executive.runs import provenance
from executive.runs.provenance import Origin
from executive.runs.runtimes import Setup
from robot import shots
from robot.errors import ConfigError, Problem
from robot.files.exchangeable import check_way
from robot.files.ordinary_files import is_within, make_below, read_ordinary, write_ordinary
from robot.files.yaml_nodes import MAX_BYTES
from robot.messages import EyesBy, LocalisedBy

MISSIONS = "missions"
"""Folder in that of a run: the mission files that its jobs are made from."""

LOGS = "logs"
"""Folder in that of a run: what the processes of a live one write."""

WRITTEN = (
    FILE, WALL_FILE, motion.FILE, sensed.FILE, shots.COLOUR_FILE, shots.DEPTH_FILE,
    "run.json", "summary.json", "timing.json",
)  # fmt: skip
"""Files of a run. In a stranger's folder one may be a pipe, whose writer waits for ever when it is
full, or a link that leads elsewhere."""


class Header(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What a run was started with: enough to start it again (`run.json`).

    What was asked for stands here as `text` for people; what jobs are made of, in the journal.
    `reality`: the profile of the simulated one (docs/realities.md); a journal that names none, nor
    eyes, is of a time when there was no other.
    `driver`: of the motors, where that is not the one that the robot's description names.
    `eyes`: who told where the things were, the oracle or the robot's own camera.
    `localisation`: who told where the robot was, the oracle or its own lidar.
    `attended`: a person was there, to ask for more and to inject faults.
    """

    text: str
    world: str
    robot: str
    seed: Annotated[int, Meta(ge=0)]
    runtime: str
    varied: bool = False
    reality: str = "ideal"
    driver: str = ""
    eyes: EyesBy = "oracle"
    localisation: LocalisedBy = "oracle"
    attended: bool = False
    origin: Origin | None = None


def header(setup: Setup, *, text: str, attended: bool = False) -> Header:
    """The header of a run that starts now."""
    where = setup.where
    return Header(
        text=text,
        world=where.world.name,
        robot=where.robot_name,
        seed=setup.seed,
        runtime=setup.kind,
        varied=where.world.vary_seed is not None,
        reality=where.world.profile,
        driver=setup.driver,
        eyes=where.world.eyes,
        localisation=where.world.localisation,
        attended=attended,
        origin=provenance.of(where.world, where.description),
    )


def carry_missions_over(left_by: Path, folder: Path) -> None:
    """Keep the mission files of a run that is gone on with in another folder there, too."""
    with contextlib.suppress(OSError):  # then they are read where they come from
        for path in sorted(islice((left_by / MISSIONS).rglob("*"), MOST_MISSIONS)):
            if path.is_file() and is_within(left_by, path):
                data = read_ordinary(path, limit=MAX_BYTES)
                copy = folder / path.relative_to(left_by)
                make_below(folder, copy.parent)
                write_ordinary(copy, data)


MOST_AT_ONCE = 100
MOST_MISSIONS = 1000
"""Files that a run of a stranger has kept."""
FULL = (errno.ENOSPC, errno.EDQUOT)
BARRED = (errno.EACCES, errno.EPERM, errno.EROFS)
ELSEWHERE = "name a folder of your own with --run-dir, or begin in one"
PRIVATE = 0o700
"""Mode of a run's folder: it says what was said, by whom, and where people and things were."""


def place_for_new() -> tuple[Path, str]:
    """Where the folders of new runs go, and why not into the current folder, if so.

    Raises:
        ConfigError: if others could exchange the current folder, and there is no home.
    """
    try:
        check_way(places.HERE, cure=ELSEWHERE)
    except ConfigError as refused:
        home = places.at_home()
        if home is None:
            raise
        try:
            home.parent.mkdir(mode=PRIVATE, parents=True, exist_ok=True)
            home.mkdir(mode=PRIVATE, exist_ok=True)
            check_way(home, cure=ELSEWHERE)
        except (ConfigError, OSError):
            raise refused from None
        return home, f"This run is kept in {home}: {refused.problems[0].message}."
    return places.HERE, ""


def folder_for(text: str, *, stamp: str, base: Path = places.HERE) -> Path:
    """A new folder, whose name sorts by time and says what it was about.

    It is made here, so that two runs that begin in the same second have one each; where the disk
    has no room for one, the journal says so.

    Raises:
        ConfigError: if others could exchange `base`, as in a current folder that is shared, or it
            may not be written.
    """
    slug = re.sub(r"[^a-z0-9]+", "-", text.casefold()).strip("-")
    if len(slug) > 40:
        slug = slug[:40].rpartition("-")[0] or slug[:40]
    first = base / f"{stamp}-{slug or 'run'}"
    check_way(base, cure=ELSEWHERE)
    check_writable(first)
    with contextlib.suppress(OSError):
        base.mkdir(parents=True, exist_ok=True)
    for folder in [first, *(first.with_name(f"{first.name}-{n}") for n in range(2, MOST_AT_ONCE))]:
        try:
            folder.mkdir(mode=PRIVATE)
        except FileExistsError:
            continue
        except OSError as error:
            if error.errno in BARRED:
                raise _barred(base, error) from None
            break
        return folder
    return first


def check_writable(folder: Path) -> None:
    """Refuse a folder that could not be made, or written into, for want of the right to.

    A robot that is up tells of nothing that happens to it there, and has worked in vain. Nothing
    is made; what cannot be told before is found when the folder is.

    Raises:
        ConfigError: if that is so.
    """
    there = next((one for one in (folder, *folder.absolute().parents) if one.is_dir()), folder)
    if os.path.lexists(there) and not os.access(there, os.W_OK | os.X_OK, effective_ids=True):
        raise _barred(there.absolute(), None)


def _barred(folder: Path, error: OSError | None) -> ConfigError:
    why = f": {error.strerror}" if error is not None else ""
    text = f"the folder {folder.absolute()} cannot be written{why}, so nothing of a run is kept"
    return ConfigError([Problem(text, suggestion=ELSEWHERE)])


def check_free(folder: Path) -> None:
    """Refuse a folder that holds a run already: two journals in one file tell nothing.

    Raises:
        ConfigError: if it does.
    """
    if os.path.lexists(folder / FILE):
        raise _taken(folder, "already holds a run")


_claimed: dict[tuple[int, int], int] = {}
"""By device and inode, the descriptors that hold this process's folders until it ends."""


def claim(folder: Path, *, wanted: bool = True) -> None:
    """Make a folder for this process's run, and keep all others out of it until it ends.

    Args:
        folder: of the run.
        wanted: whether somebody named it, and is told if it cannot be made; else the journal tells
            of it, and the run goes on without. A disk that is full stops nobody.

    Raises:
        ConfigError: if it is in use, of another user, no folder, or others could exchange it.
    """
    check_way(folder, cure=ELSEWHERE)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileExistsError):
            folder.mkdir(mode=PRIVATE)
        opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    except (NotADirectoryError, FileExistsError):
        if wanted or os.path.lexists(folder):
            raise _taken(folder, "is no folder") from None
        return
    except OSError as error:
        if os.path.lexists(folder) or (wanted and error.errno not in FULL):
            raise _taken(folder, f"cannot be used: {error.strerror}") from None
        return
    try:
        _lock(folder, opened)
    except BaseException:
        os.close(opened)
        raise


def _lock(folder: Path, opened: int) -> None:
    found = os.fstat(opened)
    if found.st_uid != os.geteuid():
        raise _taken(folder, "belongs to another user")
    for name in (LOGS, MISSIONS):
        if (folder / name).is_symlink():
            raise _taken(folder, f"has a link, {name}, in place of a folder")
    for name in WRITTEN:
        with contextlib.suppress(FileNotFoundError):
            if not stat.S_ISREG(os.lstat(name, dir_fd=opened).st_mode):
                raise _taken(folder, f"has something else in place of an ordinary file, {name}")
    identity = (found.st_dev, found.st_ino)
    if identity in _claimed:
        os.close(opened)
        return
    try:
        held = holding.hold(folder, opened)
    except BlockingIOError:
        raise _taken(folder, "is used by another run just now") from None
    except OSError:  # a file system without locks: good enough to write to
        _claimed[identity] = opened
        return
    os.close(opened)
    _claimed[identity] = held


def _taken(folder: Path, why: str) -> ConfigError:
    return ConfigError([Problem(f"{folder} {why}", suggestion="choose another --run-dir")])


def save(folder: Path, name: str, value: msgspec.Struct) -> str:
    """Write a struct as JSON; returns what went wrong, or an empty text."""
    try:
        data = msgspec.json.format(msgspec.json.encode(value, order="deterministic"))
        folder.mkdir(mode=PRIVATE, parents=True, exist_ok=True)
        write_ordinary(folder / name, data + b"\n")
    except OSError as error:
        return f"{folder / name} cannot be written: {error.strerror}"
    return ""
