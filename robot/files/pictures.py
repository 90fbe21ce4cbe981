"""Pictures out of files that may be a stranger's: ordinary ones, of bounded size."""

from __future__ import annotations

import io
import warnings
from contextlib import nullcontext
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from robot.errors import ConfigError, Problem
from robot.files.muted import muted
from robot.files.ordinary_files import read_ordinary

Picture = NDArray[np.uint8]
"""Grey, shape (height, width), or red, green, blue, shape (height, width, 3)."""
FORMATS = ("JPEG", "PNG", "BMP", "PPM", "TIFF", "WEBP")
ENDINGS = frozenset({".jpg", ".jpeg", ".png", ".bmp", ".pgm", ".ppm", ".tif", ".tiff", ".webp"})
MOST_BYTES, MOST_PIXELS = 100_000_000, 50_000_000
MOST_PICTURES = 2000
MOST_SCANNED = 10 * MOST_PIXELS
"""Pixels of a JPEG times its scans, each of which is decoded over the one before."""
_SCAN = b"\xff\xda"
"""Begins one (ITU-T T.81, table B.1); in what is packed, ff is followed by 00."""


def read_grey(path: Path) -> Picture:
    """A picture in shades of grey, shape (height, width).

    Raises:
        ConfigError: it cannot be read, is no picture, or too large.
    """
    return _read(path, "L")


def read_colour(path: Path, *, most_pixels: int = MOST_PIXELS) -> Picture:
    """A picture in red, green and blue, shape (height, width, 3).

    Raises:
        ConfigError: it cannot be read, is no picture, or too large.
    """
    return _read(path, "RGB", most_pixels)


def pictures_in(place: Path) -> list[Path]:
    """The pictures of a folder, or those that a pattern (`FOLDER/left*.png`) fits, by name.

    Raises:
        ConfigError: there is no such folder, or it holds none.
    """
    folder, pattern = (place, "*") if place.is_dir() else (place.parent, place.name)
    try:
        found = sorted(path for path in folder.iterdir() if path.match(pattern))
    except OSError as error:
        raise _wrong(folder, error.strerror or "this folder cannot be read") from None
    found = [path for path in found if path.suffix.lower() in ENDINGS]
    if not found:
        endings = ", ".join(sorted(ENDINGS))
        raise _wrong(place, "there is no picture", f"their names end in {endings}")
    if len(found) > MOST_PICTURES:
        raise _wrong(place, f"more than {MOST_PICTURES} pictures are too many", "take some of them")
    return found


def _read(path: Path, mode: str, most_pixels: int = MOST_PIXELS) -> Picture:
    try:
        data = read_ordinary(path, limit=MOST_BYTES)
    except OSError as error:
        raise _wrong(path, error.strerror or "it cannot be read") from None
    try:
        with (
            warnings.catch_warnings(action="ignore"),  # what is wrong is said once, below
            Image.open(io.BytesIO(data), formats=FORMATS) as image,
            # libtiff writes what it finds wrong by itself.
            muted() if image.format == "TIFF" else nullcontext(),
        ):
            if image.width * image.height * data.count(_SCAN) > MOST_SCANNED:
                raise _wrong(path, f"it has {data.count(_SCAN)} scans", "save it anew, as PNG")
            return _decoded(path, image, mode, most_pixels)
    except UnidentifiedImageError:
        raise _wrong(path, "this is no picture", f"known are {', '.join(FORMATS)}") from None
    except ConfigError:
        raise
    except Exception:  # of a broken picture each of Pillow's decoders raises what it happens to
        raise _wrong(path, "this picture is broken", "take it anew, or leave it out") from None


def _decoded(path: Path, image: Image.Image, mode: str, most_pixels: int) -> Picture:
    if image.width * image.height > most_pixels:
        raise _wrong(path, f"more than {most_pixels / 1e6:g} megapixels are too many")
    if image.mode.startswith("I;16"):  # 16 bits of grey: Pillow would cut them off at 255
        image = Image.fromarray((np.asarray(image) >> 8).astype(np.uint8))
    return np.asarray(image.convert(mode))


def _wrong(path: Path, message: str, cure: str | None = None) -> ConfigError:
    return ConfigError([Problem(message=message, file=str(path), suggestion=cure)])
