"""What is kept of a run, and the file in which it is kept: one JSON line a run."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TypeVar

import msgspec

from executive.evaluation.campaign import Run
from robot.errors import ConfigError
from robot.ordinary_files import open_to_append, read_ordinary

MAX_BYTES = 200_000_000
"""Of a campaign's records: one of them has about 1 kB."""

FILE = "results.jsonl"
S = TypeVar("S", bound=msgspec.Struct)
CODE = ("executive", "intents", "robot", "sim")


class Record(msgspec.Struct, frozen=True, kw_only=True):
    """How one run ended.

    Attributes:
        key: of the run.
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
    """

    key: str
    case: str
    seed: int
    recovery: bool
    ok: bool
    code: str
    cause: str = ""
    unsafe: bool = False
    recoveries: int = 0
    codes: tuple[str, ...] = ()
    took_s: float = 0.0
    wall_s: float = 0.0
    struck: int = 0
    source: str = "oracle"


class Header(msgspec.Struct, frozen=True, kw_only=True):
    """The first line: with what code the results were made."""

    code: str


class Results:
    """The file of a campaign: a run that is in it is not run again.

    Every line is on the disk before `add` returns; a line that was torn is left out.

    Attributes:
        path: the file.
        records: by key.
        stale: whether other code made what is in it.
    """

    def __init__(self, folder: Path, *, fingerprint: str) -> None:
        """Open the file in `folder`, or begin one. Raises ConfigError if that cannot be done."""
        self.path = folder / FILE
        self.records: dict[str, Record] = {}
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ConfigError(f"{folder} cannot be made: {error.strerror}") from None
        data = self._read()
        lines = data.splitlines()
        header = _decode(lines[0], Header) if lines else None
        self.stale = header is not None and header.code != fingerprint
        for line in lines[1:]:
            record = _decode(line, Record)
            if record is not None:
                self.records[record.key] = record
        if data and not data.endswith(b"\n"):
            self._write(b"\n")
        if header is None:
            self._write(_line(Header(code=fingerprint)))

    def left(self, runs: Iterable[Run]) -> list[Run]:
        """The runs that are not done yet."""
        return [run for run in runs if run.key not in self.records]

    def add(self, record: Record) -> None:
        """Keep a record; it survives whatever comes next."""
        self.records[record.key] = record
        self._write(_line(record))

    def _write(self, data: bytes) -> None:
        try:
            with os.fdopen(open_to_append(self.path), "ab") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            raise ConfigError(f"{self.path} cannot be written: {error.strerror}") from None

    def _read(self) -> bytes:
        try:
            return read_ordinary(self.path, limit=MAX_BYTES)
        except FileNotFoundError:
            return b""
        except OSError as error:
            raise ConfigError(f"{self.path} cannot be read: {error.strerror}") from None


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
    except msgspec.DecodeError:
        return None
