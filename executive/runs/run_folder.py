"""The folder of a run, and what it is started with (`run.json`)."""

from __future__ import annotations

import contextlib
import re
import shutil
from pathlib import Path

import msgspec

from executive.runs import provenance
from executive.runs.provenance import Origin
from executive.runs.runtimes import Setup
from robot.errors import ConfigError, Problem

MISSIONS = "missions"
"""Folder in that of a run: the mission files that its jobs are made from."""


class Header(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What a run was started with: enough to start it again (`run.json`).

    What was asked for stands here as `text` for people; what jobs are made of, in the journal.
    `attended`: a person was there, to ask for more and to inject faults.
    """

    text: str
    world: str
    robot: str
    seed: int
    runtime: str
    varied: bool = False
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
        attended=attended,
        origin=provenance.of(where.world, where.description),
    )


def carry_missions_over(left_by: Path, folder: Path) -> None:
    """Keep the mission files of a run that is gone on with in another folder there, too."""
    with contextlib.suppress(OSError):  # then they are read where they come from
        shutil.copytree(left_by / MISSIONS, folder / MISSIONS, dirs_exist_ok=True)


MOST_AT_ONCE = 100


def folder_for(text: str, *, stamp: str, base: Path = Path("runs")) -> Path:
    """A new folder, whose name sorts by time and says what it was about.

    It is made here, so that two runs that begin in the same second have one each; where none can be
    made, the journal says so.
    """
    slug = re.sub(r"[^a-z0-9]+", "-", text.casefold()).strip("-")
    if len(slug) > 40:
        slug = slug[:40].rpartition("-")[0] or slug[:40]
    first = base / f"{stamp}-{slug or 'run'}"
    for folder in [first, *(first.with_name(f"{first.name}-{n}") for n in range(2, MOST_AT_ONCE))]:
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError:
            break
        return folder
    return first


def check_free(folder: Path) -> None:
    """Refuse a folder that holds a run already: two journals in one file tell nothing.

    Raises:
        ConfigError: if it does.
    """
    if (folder / "journal.jsonl").exists():
        cure = "choose another --run-dir"
        raise ConfigError([Problem(f"{folder} already holds a run", suggestion=cure)])


def save(folder: Path, name: str, value: msgspec.Struct) -> str:
    """Write a struct as JSON; returns what went wrong, or an empty text."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        data = msgspec.json.format(msgspec.json.encode(value, order="deterministic"))
        (folder / name).write_bytes(data + b"\n")
    except OSError as error:
        return f"{folder / name} cannot be written: {error.strerror}"
    return ""
