"""Arrays out of an npz that may be a stranger's: plain numbers only, as many as were agreed on.

`numpy.load` believes what the header of an array says of its size, and what it holds may be
anything that can be pickled.
"""

from __future__ import annotations

import io
import math
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.ordinary_files import open_ordinary

MOST_BYTES = 400_000_000
"""Of one array: 5 hours of a lidar with 360 beams, 30 times a second, in 2 bytes a beam."""
MOST_FILE_BYTES = 1_000_000_000
MOST_MEMBERS = 100
PLAIN = "biufU"
"""Kinds of numbers, and text."""

Plain = NDArray[np.generic]


def read(path: Path, names: Mapping[str, bool], *, what: str, cure: str) -> dict[str, Plain]:
    """Arrays of a file, by name.

    Args:
        path: the npz.
        names: of the arrays that are read, and whether the file must have them.
        what: what the file should be, for people: "a lidar recording".
        cure: where the reader learns more.

    Raises:
        ConfigError: it cannot be read, lacks an array, or holds something else.
    """

    def wrong(text: str) -> ConfigError:
        return ConfigError([Problem(text, str(path), suggestion=cure)])

    try:
        with open_ordinary(path) as file:
            if file.seek(0, io.SEEK_END) > MOST_FILE_BYTES:
                raise wrong(f"the file is larger than {MOST_FILE_BYTES / 1e6:g} MB")
            file.seek(0)
            with zipfile.ZipFile(file) as archive:
                members = archive.namelist()
                if len(members) > MOST_MEMBERS:
                    raise wrong(f"this is not {what}: it holds {len(members)} arrays")
                found = {name for name in names if f"{name}.npy" in members}
                lacking = sorted(
                    name for name, needed in names.items() if needed and name not in found
                )
                if lacking:
                    raise wrong(f"this is not {what}: it lacks {', '.join(lacking)}")
                return {name: _array(archive, name) for name in sorted(found)}
    except OSError as error:
        raise wrong(f"cannot be read: {error.strerror or error}") from None
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError):
        raise wrong(f"this is not {what}: it is no npz, or a damaged one") from None
    except ValueError as error:
        raise wrong(f"this is not {what}: {error}") from None


def _array(archive: zipfile.ZipFile, name: str) -> Plain:
    """One array; raises ValueError for what is none, or too large a one."""
    with archive.open(f"{name}.npy") as member:
        shape, by_columns, kind = _header(member, name)
        if kind.kind not in PLAIN or kind.itemsize == 0:
            raise ValueError(f"{name} does not hold plain numbers")
        size = math.prod(shape) * kind.itemsize
        if size > MOST_BYTES:
            raise ValueError(f"{name} is larger than {MOST_BYTES / 1e6:g} MB")
        data = member.read(size)
    if len(data) != size:
        raise ValueError(f"{name} ends too early")
    return np.frombuffer(data, dtype=kind).reshape(shape, order="F" if by_columns else "C")


def _header(member: IO[bytes], name: str) -> tuple[tuple[int, ...], bool, np.dtype[np.generic]]:
    version = np.lib.format.read_magic(member)
    if version == (1, 0):
        return np.lib.format.read_array_header_1_0(member)
    if version == (2, 0):
        return np.lib.format.read_array_header_2_0(member)
    raise ValueError(f"{name} is of an unknown version")


def packed(arrays: Mapping[str, Plain]) -> bytes:
    """An npz of arrays; the same arrays make the same bytes."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            data = io.BytesIO()
            np.lib.format.write_array(data, np.asarray(array), allow_pickle=False)
            # With a date of its own each file would differ from the one before.
            member = zipfile.ZipInfo(f"{name}.npy", (1980, 1, 1, 0, 0, 0))
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, data.getvalue())
    return file.getvalue()
