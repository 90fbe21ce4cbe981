"""What is kept of a run, and the file in which it is kept: one JSON line a run."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, TypeVar

import msgspec
from msgspec import Meta

from executive.evaluation.campaign import Run, key_of
from executive.journal import holding
from robot.closing import Closing
from robot.errors import ConfigError, Problem
from robot.files.config import nearest
from robot.files.ordinary_files import open_ordinary, open_to_append

FILE = "results.jsonl"
MAX_BYTES = 500_000_000
MOST_OF_A_LINE = 100_000
"""Bytes; a record has some 300."""
MOST_LINES = 200_000
"""A line a run: more than that nobody has run, and they are all kept at hand."""
OTHER_FOLDER = "name another folder, or leave --resume out"
S = TypeVar("S", bound=msgspec.Struct)
_Count = Annotated[int, Meta(ge=0, le=1_000_000_000)]
_Time = Annotated[float, Meta(ge=0.0, le=1e7)]
CODE = ("executive", "intents", "robot", "sim")


class Record(msgspec.Struct, frozen=True, kw_only=True):
    """How one run ended.

    Attributes:
        key: of the run.
        digest: of what was run; empty in results of earlier versions.
        case, seed, recovery: which run.
        ok: whether it ended as expected, judged by the simulator's truth.
        code: "done", a failure's code, or "exception".
        cause: in words; what the truth objects to, where the robot says done.
        unsafe: whether it ended neither upright nor damped as expected.
        recoveries: how many were begun.
        codes: of all failures of steps on the way.
        took_s: simulated time.
        wall_s: wall time, set-up included.
        struck: how many faults happened.
        source: who judged.
        done: whether all is in truth as it was to be, and the robot stands.
        false: whether the robot says that it is done, and it is not.
        touched, too_near: as in `robot.reality.truth.Verdict`.
        remark: what people are told of how the mission was understood.
        journal: the folder of what it wrote, from that of the results; empty: it is not kept.
    """

    key: str
    digest: str = ""
    case: str
    seed: _Count
    recovery: bool
    ok: bool
    code: str
    cause: str = ""
    unsafe: bool = False
    recoveries: _Count = 0
    codes: tuple[str, ...] = ()
    took_s: _Time = 0.0
    wall_s: _Time = 0.0
    struck: _Count = 0
    source: str = "oracle"
    done: bool = False
    false: bool = False
    touched: tuple[str, ...] = ()
    too_near: tuple[str, ...] = ()
    remark: str = ""
    journal: str = ""


class Header(msgspec.Struct, frozen=True, kw_only=True):
    """The first line: with what code the results were made."""

    code: str


class Results(Closing):
    """The file of a campaign: a run that is in it is not run again.

    Every line is on the disk before `add` returns; a line that was torn, or says what
    no run can have come to, is left out, and its run is run again.

    Attributes:
        path: the file.
        records: by key.
        stale: whether other code made what is in it.
    """

    def __init__(self, folder: Path, *, fingerprint: str) -> None:
        """Open the file in `folder`, or begin one, and keep others from writing into it.

        Raises:
            ConfigError: the file is none of results, cannot be written, or another evaluation is
                at work on it.
        """
        self.path = folder / FILE
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._file = os.fdopen(open_to_append(self.path), "ab")
            self._held = os.fdopen(holding.hold(folder), "rb")
            self.records, self.stale, torn, begun = _read(self.path, fingerprint)
        except BlockingIOError:
            cure = "wait for it, or leave --resume out"
            raise _refusal(self.path, "another evaluation writes into it", cure) from None
        except OSError as error:
            raise _refusal(self.path, f"cannot be used: {error.strerror}", OTHER_FOLDER) from None
        if torn:
            self._write(b"\n")
        if not begun:
            self._write(_line(Header(code=fingerprint)))

    def left(self, runs: Iterable[Run]) -> list[Run]:
        """The runs that are not done yet.

        Raises:
            ConfigError: under the name of one of them something else was run.
        """
        found: list[Run] = []
        for run in runs:
            record = self.records.get(run.key)
            if record is None:
                found.append(run)
            elif record.digest and record.digest != run.digest:
                text = f"the results of {run.key!r} are of another mission, world or robot"
                raise _refusal(self.path, text, "the same options as then, or no --resume")
        return found

    def add(self, record: Record) -> None:
        """Keep a record; it survives whatever comes next. Raises ConfigError on a full disk."""
        self.records[record.key] = record
        self._write(_line(record))

    def close(self) -> None:
        """Let others write into the file."""
        self._file.close()
        self._held.close()

    def _write(self, data: bytes) -> None:
        try:
            self._file.write(data)
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            cure = "make room; what is in it is kept"
            raise _refusal(self.path, f"cannot be written: {error.strerror}", cure) from None


def _read(path: Path, fingerprint: str) -> tuple[dict[str, Record], bool, bool, bool]:
    """The records of a file, line by line.

    Returns:
        Them; whether other code made them; whether the last line was torn; whether it was begun.

    Raises:
        ConfigError: it is none of results.
        OSError: it cannot be read.
    """
    records: dict[str, Record] = {}
    with open_ordinary(path) as file:
        if os.fstat(file.fileno()).st_size > MAX_BYTES:
            raise _refusal(path, f"is larger than {MAX_BYTES / 1e6:g} MB", OTHER_FOLDER)
        line = first = file.readline(MOST_OF_A_LINE)
        header = _decode(first, Header)
        if first and header is None:
            raise _refusal(path, "this is no file of `humanoid eval`", OTHER_FOLDER)
        lines = 0
        while following := file.readline(MOST_OF_A_LINE):
            line, lines = following, lines + 1
            record = _decode(line, Record)
            if record is not None and record.key == _key(record):
                records[record.key] = record
            if lines > MOST_LINES:
                raise _refusal(path, f"has more than {MOST_LINES} lines", OTHER_FOLDER)
    stale = header is not None and header.code != fingerprint
    return records, stale, not line.endswith(b"\n") and bool(line), header is not None


def _key(record: Record) -> str:
    """What the record of such a run is kept under."""
    return key_of(record.case, record.seed, recovery=record.recovery)


def folder_to_resume(folder: Path) -> Path:
    """A folder of results that is there. Raises ConfigError with the nearest one that is."""
    if (folder / FILE).is_file():
        return folder
    there = sorted(str(path.parent) for path in folder.parent.glob(f"*/{FILE}"))
    cure = nearest(str(folder), there) if there else "leave --resume out to begin anew"
    raise ConfigError(
        [Problem("there are no results in this folder", str(folder), suggestion=cure)]
    )


def _refusal(path: Path, message: str, cure: str) -> ConfigError:
    return ConfigError([Problem(message, str(path), suggestion=cure)])


def fingerprint(root: Path) -> str:
    """Of all code and data that a run depends on."""
    digest = hashlib.sha256()
    for package in CODE:
        for path in sorted((root / package).rglob("*")):
            if path.suffix in (".py", ".yaml", ".xml"):
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _line(value: msgspec.Struct) -> bytes:
    return msgspec.json.encode(value, order="deterministic") + b"\n"


def _decode(line: bytes, kind: type[S]) -> S | None:
    try:
        return msgspec.json.decode(line, type=kind)
    except (msgspec.DecodeError, RecursionError):
        return None
