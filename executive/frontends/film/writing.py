"""Pictures into a film: GIF by Pillow, which is always here; WebM and MP4 by PyAV (extra: film)."""

from __future__ import annotations

import importlib.util
import io
import itertools
from collections.abc import Iterator
from pathlib import Path

import msgspec
from PIL import Image, ImageColor

from executive.frontends.film.pictures import Frame
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import write_ordinary


class Kind(msgspec.Struct, frozen=True, kw_only=True):
    """A kind of film: its encoder (none: Pillow), pictures a second, and how many at most."""

    suffix: str
    codec: str
    rate_hz: int
    most_frames: int
    options: dict[str, str] = {}


FORMATS: tuple[Kind, ...] = (
    Kind(
        suffix=".webm", codec="libvpx-vp9", rate_hz=20, most_frames=40_000,
        options={"deadline": "realtime", "cpu-used": "8", "crf": "34", "b": "0"},
    ),
    Kind(
        suffix=".mp4", codec="libx264", rate_hz=20, most_frames=40_000,
        options={"preset": "veryfast", "crf": "24"},
    ),
    Kind(suffix=".gif", codec="", rate_hz=10, most_frames=900),
)  # fmt: skip
COLOURS = 256
"""Of a GIF."""
HUES, VALUES = 12, (40, 65, 90)
"""Of the colours that a GIF can show from its beginning, whatever its first picture shows."""


def best() -> str:
    """What is made where nobody says: a WebM if that can be, else a GIF."""
    return ".webm" if importlib.util.find_spec("av") else ".gif"


def kind_of(path: Path) -> Kind:
    """The kind of film that a file is called by.

    Raises:
        ConfigError: if none is, or what makes it is not installed.
    """
    suffix = path.suffix.lower()
    found = next((kind for kind in FORMATS if kind.suffix == suffix), None)
    if found is None:
        cure = f"call it {path.stem or 'film'}.webm"
        text = f"films are written as {', '.join(kind.suffix for kind in FORMATS)}"
        raise ConfigError([Problem(text, str(path), suggestion=cure)])
    if found.codec and not importlib.util.find_spec("av"):
        cure = "pip install 'humanoid-executive[film]', or call it .gif"
        text = f"a {suffix} takes PyAV, which is not installed"
        raise ConfigError([Problem(text, str(path), suggestion=cure)])
    return found


def write(path: Path, kind: Kind, frames: Iterator[Frame], *, width: int, height: int) -> None:
    """Write a film; whole, or not at all. Raises ConfigError if it cannot be written."""
    if kind.codec:
        from executive.frontends.film.encoding import encoded

        data = encoded(
            frames, codec=kind.codec, container=kind.suffix.removeprefix("."),
            rate_hz=kind.rate_hz, size=(width, height), options=kind.options,
        )  # fmt: skip
    else:
        data = _gif(kind, frames)
    try:
        write_ordinary(path, data)
    except OSError as error:
        text = f"cannot be written: {error.strerror}"
        raise ConfigError(
            [Problem(text, str(path), suggestion="choose another --output")]
        ) from None


def _gif(kind: Kind, frames: Iterator[Frame]) -> bytes:
    """All pictures in the same few colours: what stands still costs nothing then."""
    first = next(frames)
    palette = _palette(first)
    pictures = (
        frame.quantize(palette=palette, dither=Image.Dither.NONE)
        for frame in itertools.chain([first], frames)
    )
    file = io.BytesIO()
    next(pictures).save(
        file, "GIF", save_all=True, append_images=pictures, duration=1000 // kind.rate_hz, loop=0,
        optimize=False,
    )  # fmt: skip
    return file.getvalue()


def _palette(first: Frame) -> Frame:
    """Colours of the first picture, and of what may come into view later: of each hue some.

    An octree keeps those that are rare (a red cup in a grey room); a median cut gives them up.
    """
    width, height = first.size
    strip = max(1, height // 10)
    sample = Image.new("RGB", (width, height + strip))
    sample.paste(first, (0, 0))
    for column in range(HUES):
        for row, value in enumerate(VALUES):
            colour = ImageColor.getrgb(f"hsv({360 * column // HUES}, 85%, {value}%)")
            left, right = (width * edge // HUES for edge in (column, column + 1))
            top, bottom = (height + strip * edge // len(VALUES) for edge in (row, row + 1))
            sample.paste(colour, (left, top, right, bottom))
    return sample.quantize(COLOURS, method=Image.Quantize.FASTOCTREE)
