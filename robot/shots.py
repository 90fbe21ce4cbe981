"""Pictures that are kept of what the robot saw, for people who look on: a line of JSON each.

Colours and depth have a file each in the folder of a run, both of which only grow. Whoever watches
reads the newest, or the one of a time.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from robot.messages import Source

COLOUR_FILE, DEPTH_FILE = "colour.jsonl", "depth.jsonl"
MAX_LINE = 1_000_000
"""Bytes of a line; a picture of 320 x 240 has 15 kB."""
MOST_BYTES = 500_000_000
"""Of a file: ten hours of a picture a second. What comes then is not kept."""


class Shot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A picture, packed.

    Attributes:
        t_s: when it was taken.
        kind: red, green and blue, or depth in shades of grey.
        type: how `data` is packed.
        width, height: in pixels.
        focal_px: fx, fy.
        centre_px: cx, cy; the middle of a pixel has whole numbers.
        range_m: depth of the shade 255, the others in proportion; 0: nothing was measured.
        source: "emulated" where there is no camera but a simulation.
    """

    t_s: float
    kind: Literal["colour", "depth"]
    type: Literal["jpeg", "png"]
    data: bytes
    width: int
    height: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    range_m: float = 0.0
    source: Source = "emulated"


class Taken(msgspec.Struct, frozen=True):
    """Of a shot, when it was taken."""

    t_s: float


_SHOT, _TAKEN = msgspec.json.Decoder(Shot), msgspec.json.Decoder(Taken)
_WRONG = (msgspec.DecodeError, UnicodeDecodeError, RecursionError)


def encode(shot: Shot) -> bytes:
    """A shot as its line, without the line's end."""
    return msgspec.json.encode(shot, order="deterministic")


def decode(line: bytes) -> Shot | None:
    """The shot of a line; None if it is none."""
    try:
        return _SHOT.decode(line)
    except _WRONG:
        return None


def taken_s(line: bytes) -> float | None:
    """When the shot of a line was taken, without unpacking it; None if nobody knows."""
    try:
        return _TAKEN.decode(line).t_s
    except _WRONG:
        return None
