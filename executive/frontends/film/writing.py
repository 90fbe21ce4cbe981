"""Pictures into a film: GIF by Pillow, which is always here; WebM and MP4 by PyAV (extra: film)."""

from __future__ import annotations

import importlib.util
import io
from collections.abc import Iterator
from pathlib import Path

import msgspec
from PIL import Image

from executive.frontends.film.pictures import Frame
from robot.errors import ConfigError, Problem
from robot.ordinary_files import write_ordinary


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
COLOURS = 128
"""Of a GIF."""


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
    """All pictures with the colours of the first: what stands still costs nothing then."""
    first = next(frames).quantize(COLOURS, dither=Image.Dither.NONE)
    rest = (frame.quantize(palette=first, dither=Image.Dither.NONE) for frame in frames)
    file = io.BytesIO()
    first.save(
        file, "GIF", save_all=True, append_images=rest, duration=1000 // kind.rate_hz, loop=0,
        optimize=False,
    )  # fmt: skip
    return file.getvalue()
