"""NumPy archives (.npz): arrays by name out of those of strangers, within bounds; and made anew.

NumPy's own reader makes room for whatever a header claims, before a byte of it has come, and what
an array holds may be anything that can be pickled.
"""

from __future__ import annotations

import io
import math
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.ordinary_files import open_ordinary

MOST_BYTES = 100_000_000
"""Of an array, where nothing else is said: an hour of 20 scans a second of 690 beams in mm."""
PLAIN = "biufSU"
"""Kinds of numbers, and text."""
_MOST_HEADER = 10_000
_MOST_ENTRIES = 1000


Plain = NDArray[np.generic]


class Archive:
    """What a NumPy archive holds: read by name, when asked for."""

    def __init__(self, path: Path, *, limit: int = MOST_BYTES, cure: str = "") -> None:
        """Look what is in it.

        Args:
            path: the archive.
            limit: of each array [bytes].
            cure: where the reader of a complaint learns more.

        Raises:
            ConfigError: it is missing, no ordinary file, no archive, or a broken one.
        """
        self._path = path
        self._limit = limit
        self._cure = cure
        try:
            with open_ordinary(path) as file, zipfile.ZipFile(file) as archive:
                entries = archive.namelist()[:_MOST_ENTRIES]
        except OSError as error:
            raise self._wrong(error.strerror or "it cannot be read") from None
        except (zipfile.BadZipFile, ValueError, NotImplementedError):
            raise self._wrong("this is no NumPy archive, or a part of it is missing") from None
        self.names = frozenset(entry.removesuffix(".npy") for entry in entries)

    def arrays(self, names: Mapping[str, bool], *, what: str) -> dict[str, Plain]:
        """Arrays of plain numbers and text by name.

        Args:
            names: of those that are wanted, and whether the archive must have them.
            what: what the archive should be, for people: "a lidar recording".

        Raises:
            ConfigError: one is lacking, broken, too large, or holds something else.
        """
        lacking = sorted(
            name for name, needed in names.items() if needed and name not in self.names
        )
        if lacking:
            raise self._wrong(f"this is not {what}: it lacks {', '.join(lacking)}")
        return {name: self.array(name) for name in sorted(self.names.intersection(names))}

    def numbers(self, name: str, *, axes: int) -> NDArray[np.float64]:
        """An array of real numbers with so many axes.

        Raises:
            ConfigError: there is none of that name, it is broken, too large, or something else.
        """
        array = self.array(name)
        if array.dtype.kind not in "iuf" or array.ndim != axes:
            what = "real numbers" if axes == 1 else f"real numbers on {axes} axes"
            raise self._wrong(f"{name} holds no {what}")
        return array.astype(np.float64)

    def array(self, name: str) -> Plain:
        """An array of plain numbers or text.

        Raises:
            ConfigError: there is none of that name, it is broken, too large, or something else.
        """
        if name not in self.names:
            raise self._wrong(f"it holds no {name}")
        try:
            with (
                open_ordinary(self._path) as file,
                zipfile.ZipFile(file) as archive,
                archive.open(f"{name}.npy") as entry,
            ):
                claimed = archive.getinfo(f"{name}.npy").file_size  # may be too little
                data = b"" if claimed > self._limit else entry.read(self._limit + 1)
        except OSError as error:
            raise self._wrong(error.strerror or "it cannot be read") from None
        except (zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError, RuntimeError,
                NotImplementedError):  # fmt: skip
            raise self._wrong(f"{name} in it is broken") from None
        if claimed > self._limit or len(data) > self._limit:
            raise self._wrong(f"{name} is larger than {self._limit / 1e6:g} MB")
        return self._decoded(name, data)

    def _decoded(self, name: str, data: bytes) -> Plain:
        stream = io.BytesIO(data)
        try:
            version = npy.read_magic(stream)
            read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
            shape, _, dtype = read(stream, max_header_size=_MOST_HEADER)
            size = math.prod(shape) * dtype.itemsize
            if not dtype.hasobject and (dtype.kind not in PLAIN or dtype.itemsize == 0):
                raise self._wrong(f"{name} holds no real numbers, and no text")
            if dtype.hasobject or min(shape, default=0) < 0 or size != len(data) - stream.tell():
                raise ValueError
            return npy.read_array(io.BytesIO(data), max_header_size=_MOST_HEADER)
        except (ValueError, TypeError, SyntaxError, tokenize.TokenError, OverflowError,
                MemoryError, RecursionError):  # fmt: skip
            raise self._wrong(f"{name} in it is broken") from None

    def _wrong(self, message: str) -> ConfigError:
        cure = self._cure
        return ConfigError([Problem(message=message, file=str(self._path), suggestion=cure)])


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
