"""Arrays out of a NumPy archive (.npz) that may be a stranger's: named ones, within bounds.

NumPy's own reader makes room for whatever a header claims, before a byte of it has come.
"""

from __future__ import annotations

import io
import math
import tokenize
import zipfile
import zlib
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.ordinary_files import open_ordinary

MOST_BYTES = 100_000_000
"""Of an array: an hour of 20 scans a second of 690 beams in millimetres."""
_MOST_HEADER = 10_000
_MOST_ENTRIES = 1000


class Archive:
    """What a NumPy archive holds: read by name, when asked for."""

    def __init__(self, path: Path) -> None:
        """Look what is in it.

        Raises:
            ConfigError: it is missing, no ordinary file, no archive, or a broken one.
        """
        self._path = path
        try:
            with open_ordinary(path) as file, zipfile.ZipFile(file) as archive:
                entries = archive.namelist()[:_MOST_ENTRIES]
        except OSError as error:
            raise self._wrong(error.strerror or "it cannot be read") from None
        except (zipfile.BadZipFile, ValueError, NotImplementedError):
            raise self._wrong("this is no NumPy archive, or a part of it is missing") from None
        self.names = frozenset(entry.removesuffix(".npy") for entry in entries)

    def first_of(self, names: Iterable[str]) -> str | None:
        """The first of some names that the archive holds."""
        return next((name for name in names if name in self.names), None)

    def numbers(self, name: str, *, axes: int) -> NDArray[np.float64]:
        """An array of real numbers with so many axes.

        Raises:
            ConfigError: there is none of that name, it is broken, too large, or something else.
        """
        array = self._array(name)
        if array.dtype.kind not in "iuf" or array.ndim != axes:
            what = "real numbers" if axes == 1 else f"real numbers on {axes} axes"
            raise self._wrong(f"{name} holds no {what}")
        return array.astype(np.float64)

    def _array(self, name: str) -> NDArray[np.generic]:
        if name not in self.names:
            raise self._wrong(f"it holds no {name}")
        try:
            with (
                open_ordinary(self._path) as file,
                zipfile.ZipFile(file) as archive,
                archive.open(f"{name}.npy") as entry,
            ):
                claimed = archive.getinfo(f"{name}.npy").file_size  # may be too little
                data = b"" if claimed > MOST_BYTES else entry.read(MOST_BYTES + 1)
        except OSError as error:
            raise self._wrong(error.strerror or "it cannot be read") from None
        except (zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError, RuntimeError,
                NotImplementedError):  # fmt: skip
            raise self._wrong(f"{name} in it is broken") from None
        if claimed > MOST_BYTES or len(data) > MOST_BYTES:
            raise self._wrong(f"{name} is larger than {MOST_BYTES / 1e6:g} MB")
        return self._decoded(name, data)

    def _decoded(self, name: str, data: bytes) -> NDArray[np.generic]:
        stream = io.BytesIO(data)
        try:
            version = npy.read_magic(stream)
            read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
            shape, _, dtype = read(stream, max_header_size=_MOST_HEADER)
            size = math.prod(shape) * dtype.itemsize
            if dtype.hasobject or min(shape, default=0) < 0 or size != len(data) - stream.tell():
                raise ValueError
            return npy.read_array(io.BytesIO(data), max_header_size=_MOST_HEADER)
        except (ValueError, TypeError, SyntaxError, tokenize.TokenError, OverflowError,
                MemoryError, RecursionError):  # fmt: skip
            raise self._wrong(f"{name} in it is broken") from None

    def _wrong(self, message: str) -> ConfigError:
        return ConfigError([Problem(message=message, file=str(self._path))])
