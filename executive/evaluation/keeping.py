"""The journals of runs that went wrong: kept beside the results, for people to look."""

from __future__ import annotations

import contextlib
import re
import shutil
from itertools import count
from pathlib import Path

import msgspec

from executive.evaluation.campaign import Run
from executive.evaluation.record import Record
from executive.journal.journal import FILE as JOURNAL

FOLDER = "journals"
"""Beside the results: a folder a run, which `humanoid why`, `dump` and `film` read."""
RECORD = "record.json"
"""In such a folder: how the run was judged, which its journal does not know."""
MOST_KEPT = 200
"""A run is about a megabyte: of a campaign in which everything fails, the first show enough."""
_MOST_LETTERS = 60


def worth_a_look(record: Record) -> bool:
    """Whether a run went wrong, or touched or came near what it should not."""
    went_wrong = not record.ok or record.false or record.unsafe
    return bool(went_wrong or record.touched or record.too_near)


def keep(run: Run, record: Record, left_by: Path, place: Path) -> Record:
    """Move what a run wrote under `place`, if it is worth a look; its record says where that is.

    A refused sentence wrote nothing, and a disk that takes no more ends no evaluation: then the
    record stays as it is.
    """
    if not worth_a_look(record) or not (left_by / JOURNAL).is_file():
        return record
    if place.is_symlink():  # what is resumed may be a stranger's
        return record
    with contextlib.suppress(OSError):
        place.mkdir(parents=True, exist_ok=True)
        if len(list(place.iterdir())) >= MOST_KEPT:
            return record
        folder = _new_folder(place, name_of(run))
        record = msgspec.structs.replace(record, journal=f"{place.name}/{folder.name}")
        for path in left_by.iterdir():
            shutil.move(path, folder / path.name)
        data = msgspec.json.format(msgspec.json.encode(record, order="deterministic"))
        (folder / RECORD).write_bytes(data + b"\n")
    return record


def name_of(run: Run) -> str:
    """What the folder of a run is called: its case, its seed, and whether recovery was off."""
    slug = re.sub(r"[^a-z0-9]+", "-", run.case.name.casefold()).strip("-")
    off = "" if run.recovery else "-no-recovery"
    return f"{slug[:_MOST_LETTERS].strip('-') or 'case'}-seed{run.seed}{off}"


def _new_folder(place: Path, name: str) -> Path:
    """One that was not there: a run that was given up may have left one of its name."""
    for number in count(1):
        folder = place / (name if number == 1 else f"{name}-{number}")
        with contextlib.suppress(FileExistsError):
            folder.mkdir(mode=0o700)
            return folder
    raise AssertionError("counting never ends")
