"""The folder of a run: what was asked for, the journal, and how it ended."""

from __future__ import annotations

import contextlib
import re
import shutil
from pathlib import Path

import msgspec

from executive.engine.executive import Outcome
from executive.journal.journal import Journal
from executive.meaning.request import Setting
from executive.runs import provenance
from executive.runs.provenance import Origin
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


def header(where: Setting, *, text: str, seed: int, runtime: str, attended: bool = False) -> Header:
    """The header of a run that starts now."""
    return Header(
        text=text,
        world=where.world.name,
        robot=where.robot_name,
        seed=seed,
        runtime=runtime,
        varied=where.world.vary_seed is not None,
        attended=attended,
        origin=provenance.of(where.world, where.description),
    )


def begin(journal: Journal, header: Header, *, now_s: float, folder: Path | None) -> None:
    """Write what a run is started with into its folder, and as the journal's first event."""
    if folder is not None:
        save(folder, "run.json", header)
    journal.write(now_s, "run", **msgspec.to_builtins(header))


def carry_missions_over(left_by: Path, folder: Path) -> None:
    """Keep the mission files of a run that is gone on with in another folder there, too."""
    with contextlib.suppress(OSError):  # then they are read where they come from
        shutil.copytree(left_by / MISSIONS, folder / MISSIONS, dirs_exist_ok=True)


class Summary(msgspec.Struct, frozen=True, kw_only=True):
    """How a run ended (`summary.json`); wall times stand only here and in `wall.jsonl`.

    `placed` says where things are believed to be; nothing here is the simulator's truth.
    """

    status: str
    code: str
    cause: str
    suggestion: str
    exit_status: int
    simulated_s: float
    wall_s: float
    recoveries: int
    clamped: int
    refused: int
    placed: tuple[Placed, ...] = ()
    expected: tuple[Expected, ...] = ()
    late: tuple[str, ...] = ()
    folder: str = ""

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a second of wall time."""
        return self.simulated_s / self.wall_s if self.wall_s > 0.0 else 0.0


class Expected(msgspec.Struct, frozen=True, kw_only=True):
    """Something that a mission expected at its end, whether it was so, and what was found."""

    check: str
    so: bool
    found: str = ""


class Placed(msgspec.Struct, frozen=True, kw_only=True):
    """Where an object is believed to be at the end."""

    object: str
    where: str
    x_m: float
    y_m: float
    z_m: float


MOST_AT_ONCE = 100
BROKEN = frozenset({"plant_lost", "internal"})
"""Codes that mean that the system broke, not the task."""


def exit_status(outcome: Outcome) -> int:
    """0 done, 1 failed, 3 the system broke."""
    if outcome.failure is None:
        return 0
    return 3 if outcome.failure.code in BROKEN else 1


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
