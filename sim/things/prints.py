"""Pictures on things, drawn by code: names, stripes, dots and rings in two colours of the palette.

A picture is 8-bit red, green, blue, shape (height, width, 3), its first row on top, and goes around
once.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.palette import COLORS
from sim.things.catalogue import Print

Picture = NDArray[np.uint8]
WIDTH_PX, HEIGHT_PX = 384, 128
INKS = ("black", "charcoal", "white", "cream", "red", "blue", "green", "yellow", "orange", "purple")
APART = 0.35
"""Least distance of two colours that can be told apart on a label, of the square root of 3."""


def picture(wanted: Print, color: str, word: str, rng: np.random.Generator) -> Picture:
    """A label for a thing of a colour."""
    ground = color
    if wanted.colors:
        ground = wanted.colors[int(rng.integers(len(wanted.colors)))]
    second = _other([ground], rng)
    third = _other([ground, second], rng)
    canvas = np.empty((HEIGHT_PX, WIDTH_PX, 3), dtype=np.uint8)
    canvas[:] = _ink(ground)
    rows, columns = np.mgrid[:HEIGHT_PX, :WIDTH_PX]
    match wanted.style:
        case "stripes":
            count = int(rng.integers(4, 10))
            canvas[(columns * count * 2 // WIDTH_PX) % 2 == 1] = _ink(second)
        case "rings":
            for _ in range(int(rng.integers(1, 4))):
                middle, half = rng.uniform(0.1, 0.9), rng.uniform(0.03, 0.10)
                canvas[np.abs(rows / HEIGHT_PX - middle) < half] = _ink(second)
        case "dots":
            pitch = WIDTH_PX // int(rng.integers(8, 16))
            across = (columns + pitch // 2 * (rows // pitch % 2)) % pitch - pitch / 2
            down = rows % pitch - pitch / 2
            canvas[across**2 + down**2 < (0.3 * pitch) ** 2] = _ink(second)
        case "brand":
            _brand(canvas, wanted.text or word, second, third, rng)
    return canvas


def _brand(canvas: Picture, text: str, second: str, third: str, rng: np.random.Generator) -> None:
    """Twice a name with an ornament, so that one is seen from every side, and small print."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(canvas)
    draw: Any = ImageDraw.Draw(image)
    edge = int(rng.integers(6, 22))
    for top in (0, HEIGHT_PX - edge):
        draw.rectangle((0, top, WIDTH_PX, top + edge), fill=_ink(second))
    half = WIDTH_PX // 2
    size = min(44, int(1.7 * half / max(4, len(text))))
    is_round = bool(rng.integers(2))
    for left in (0, half):
        middle = (left + half // 2, HEIGHT_PX // 2)
        spread = (int(rng.integers(34, 60)), int(rng.integers(24, 40)))
        corners = (middle[0] - spread[0], middle[1] - spread[1],
                   middle[0] + spread[0], middle[1] + spread[1])  # fmt: skip
        (draw.ellipse if is_round else draw.rectangle)(corners, fill=_ink(third))
        draw.text(middle, text.upper(), fill=_ink(second), anchor="mm",
                  font=ImageFont.load_default(size=size))  # fmt: skip
        x = left + half - 22
        for bar in range(0, 20, 2):
            if rng.integers(2):
                draw.rectangle((x + bar, HEIGHT_PX // 2 - 18, x + bar, HEIGHT_PX // 2 + 18),
                               fill=(15, 15, 15))  # fmt: skip
    canvas[:] = np.asarray(image)


def _other(there: Sequence[str], rng: np.random.Generator) -> str:
    """A colour that can be told from those that are there."""
    far = [
        name
        for name in INKS
        if all(np.linalg.norm(np.subtract(COLORS[name], COLORS[one])) > APART for one in there)
    ]
    return far[int(rng.integers(len(far)))]


def _ink(name: str) -> tuple[int, int, int]:
    red, green, blue = (round(255 * share) for share in COLORS[name])
    return (red, green, blue)
