"""NumPy archives (.npz): arrays by name out of those of strangers, within bounds; and made anew.

NumPy's own reader makes room for whatever a header claims, before a byte of it has come, and what
an array holds may be anything that can be pickled. Here the header is read first: what the array is
to be, and what it takes in memory as the numbers that the reader works with, are looked at before
the array is. All arrays of an archive share one room, so a small file cannot become a large one.
"""

from __future__ import annotations

import io
import math
import os
import tokenize
import zipfile
import zlib
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, BinaryIO

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import open_ordinary

MOST_BYTES = 100_000_000
"""Of all arrays in memory, where nothing else is said: an hour of 20 scans a second of 690 beams
in mm."""
PLAIN = "biufSU"
"""Kinds of numbers, and text."""
_REAL = "iuf"
_FLOAT_BYTES = 8
_MOST_HEADER = 10_000
_MOST_DIRECTORY = 200_000
"""Bytes of an archive's table of contents: some 2000 arrays."""
_VERSIONS = {(1, 0), (2, 0), (3, 0)}
_PACKED = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
"""What NumPy writes; other packings have decoders of their own, with rooms of their own."""
_END, _END_64, _END_BYTES, _LOCATOR_BYTES = b"PK\5\6", b"PK\6\7", 22, 20
_MOST_COMMENT = 65_535
_LAST_CODE_POINT = 0x10FFFF

Plain = NDArray[np.generic]
Shape = tuple[int | None, ...]
"""Sizes of axes; None for any."""


@dataclass(frozen=True)
class Claim:
    """What the header of an array says of it."""

    shape: tuple[int, ...]
    in_columns: bool
    dtype: np.dtype[np.generic]

    @property
    def size(self) -> int:
        """How many elements."""
        return math.prod(self.shape)


class Archive:
    """What a NumPy archive holds: read by name, when asked for."""

    def __init__(self, path: Path, *, limit: int = MOST_BYTES, cure: str = "") -> None:
        """Look what is in it.

        Args:
            path: the archive.
            limit: of all arrays that are read from it, as they are handed out [bytes].
            cure: where the reader of a complaint learns more.

        Raises:
            ConfigError: it is missing, no ordinary file, no archive, or a broken one.
        """
        self._path = path
        self._limit = self._room = limit
        self._cure = cure
        with self._opened("") as archive:
            entries = archive.namelist()
        self.names = frozenset(entry.removesuffix(".npy") for entry in entries)

    def arrays(self, names: Mapping[str, bool], *, what: str) -> dict[str, Plain]:
        """Arrays of plain numbers and text by name, as they are stored.

        Args:
            names: of those that are wanted, and whether the archive must have them.
            what: what the archive should be, for people: "a lidar recording".

        Raises:
            ConfigError: one is lacking, broken, too large, or holds something else.
        """
        self.need([name for name, needed in names.items() if needed], what=what)
        return {name: self.array(name) for name in sorted(self.names.intersection(names))}

    def need(self, names: list[str], *, what: str) -> None:
        """Refuse an archive that lacks one of those. Raises ConfigError."""
        if lacking := sorted(set(names) - self.names):
            raise self.wrong(f"this is not {what}: it lacks {', '.join(lacking)}")

    def numbers(self, name: str, *, shape: Shape, most_rows: int = 0) -> NDArray[np.float64]:
        """An array of real numbers of that shape.

        Args:
            name: of the array.
            shape: that it has to have.
            most_rows: that it may have; 0: as many as there is room for.

        Raises:
            ConfigError: there is none of that name, it is broken, too large, or something else.
        """

        def check(claim: Claim) -> None:
            self._check(name, claim, shape)
            if most_rows and claim.shape[0] > most_rows:
                raise self.wrong(f"{name} has more than {most_rows} rows")

        array = self._taken(name, check, least_bytes=_FLOAT_BYTES)
        with np.errstate(over="ignore"):  # of wider numbers: infinite, as any that is too large
            return array.astype(np.float64, copy=False)

    def array(self, name: str, *, shape: Shape | None = None) -> Plain:
        """An array of plain numbers or text, as it is stored; it cannot be written to.

        Args:
            name: of the array.
            shape: that it has to have, of real numbers then.

        Raises:
            ConfigError: there is none of that name, it is broken, too large, or something else.
        """

        def check(claim: Claim) -> None:
            if shape is not None:
                self._check(name, claim, shape)

        return self._taken(name, check, least_bytes=1)

    def _check(self, name: str, claim: Claim, shape: Shape) -> None:
        fits = len(shape) == len(claim.shape) and all(
            wanted in (None, size) for wanted, size in zip(shape, claim.shape, strict=True)
        )
        if claim.dtype.kind not in _REAL or not fits:
            held = f"{claim.dtype} in the shape {_sizes(claim.shape)}"
            raise self.wrong(
                f"{name} must hold real numbers in the shape {_sizes(shape)}, not {held}"
            )

    def claim(self, name: str) -> Claim:
        """What the header of an array says of it.

        Raises:
            ConfigError: there is none of that name, or it is broken.
        """
        with self._opened(name) as archive, archive.open(self._entry(archive, name)) as entry:
            return _claim(entry)

    def wrong(self, message: str) -> ConfigError:
        """A complaint about this archive."""
        cure = self._cure
        return ConfigError([Problem(message=message, file=str(self._path), suggestion=cure)])

    def _taken(self, name: str, check: Callable[[Claim], None], *, least_bytes: int) -> Plain:
        """An array for which there is room once its elements take so much."""
        with self._opened(name) as archive, archive.open(self._entry(archive, name)) as entry:
            claim = _claim(entry)
            dtype = claim.dtype
            if not dtype.hasobject and (dtype.kind not in PLAIN or dtype.itemsize == 0):
                raise self.wrong(f"{name} holds no real numbers, and no text")
            if dtype.hasobject or min(claim.shape, default=0) < 0:
                raise ValueError
            check(claim)
            length = claim.size * dtype.itemsize
            taken = claim.size * max(dtype.itemsize, least_bytes)
            if taken > self._room:
                raise self.wrong(f"{name} makes it larger than {self._limit / 1e6:g} MB")
            data = entry.read(length + 1)
        if len(data) != length:
            raise self._broken(name)
        self._room -= taken
        array: Plain = np.frombuffer(data, dtype).reshape(
            claim.shape, order="F" if claim.in_columns else "C"
        )
        if dtype.kind == "U" and length and not _is_text(array):
            raise self._broken(name)
        return array

    @contextmanager
    def _opened(self, name: str) -> Generator[zipfile.ZipFile]:
        """The archive, and complaints in its name, or in that of an array."""
        try:
            with open_ordinary(self._path) as file:
                _check_directory(file)
                with zipfile.ZipFile(file) as archive:
                    yield archive
        except OSError as error:
            raise self.wrong(error.strerror or "it cannot be read") from None
        except (zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError, RuntimeError,
                NotImplementedError, TypeError, SyntaxError, tokenize.TokenError, OverflowError,
                MemoryError, RecursionError):  # fmt: skip
            raise self._broken(name) from None

    def _entry(self, archive: zipfile.ZipFile, name: str) -> zipfile.ZipInfo:
        if name not in self.names:
            raise self.wrong(f"it holds no {name}")
        entry = archive.getinfo(f"{name}.npy")
        if entry.compress_type not in _PACKED:
            raise self.wrong(f"{name} is packed as NumPy packs nothing (numpy.savez_compressed)")
        return entry

    def _broken(self, name: str) -> ConfigError:
        if name:
            return self.wrong(f"{name} in it is broken")
        return self.wrong("this is no NumPy archive, or a part of it is missing")


def _check_directory(file: BinaryIO) -> None:
    """Refuse a table of contents for which there is no room: zipfile takes all of it at once.

    Raises:
        ValueError: it is none, or too large. Where its end is, zipfile finds in the same way.
    """
    size = file.seek(0, os.SEEK_END)
    file.seek(max(0, size - _MOST_COMMENT - _END_BYTES - _LOCATOR_BYTES))
    tail = file.read()
    file.seek(0)
    at = len(tail) - _END_BYTES
    if at < 0 or not (tail[at:].startswith(_END) and tail.endswith(b"\0\0")):
        at = tail.rfind(_END)
    if at < 0 or len(tail) - at < _END_BYTES:
        raise ValueError
    directory = int.from_bytes(tail[at + 12 : at + 16], "little")
    beyond = tail[max(0, at - _LOCATOR_BYTES) : at].startswith(_END_64)
    if directory > _MOST_DIRECTORY or beyond:  # of 64 bits: for more than 4 GB
        raise ValueError


def _claim(entry: IO[bytes]) -> Claim:
    version = npy.read_magic(entry)
    if version not in _VERSIONS:
        raise ValueError
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    return Claim(*read(entry, max_header_size=_MOST_HEADER))


def _is_text(array: Plain) -> bool:
    """Whether all code points of an array of text are some."""
    flat = np.ascontiguousarray(array).reshape(-1)
    points = flat.view(np.dtype(np.uint32).newbyteorder(array.dtype.byteorder))
    return int(points.max()) <= _LAST_CODE_POINT


def _sizes(shape: Shape) -> str:
    return f"({', '.join('n' if size is None else str(size) for size in shape[:5])})"


def packed(arrays: Mapping[str, Plain]) -> bytes:
    """An archive of arrays; the same arrays make the same bytes."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            data = io.BytesIO()
            npy.write_array(data, np.asarray(array), allow_pickle=False)
            # With a date of its own each file would differ from the one before.
            member = zipfile.ZipInfo(f"{name}.npy", (1980, 1, 1, 0, 0, 0))
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, data.getvalue())
    return file.getvalue()
