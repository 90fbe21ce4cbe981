"""Things in one picture of the robot's camera: what is seen of them, as plain data and as boxes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from robot.messages import RgbdImage
from robot.perception.things.eyes import Eyes, SeenThing
from robot.se3 import SE3

Pixels = NDArray[np.uint8]
LARGER = 2
"""Boxes and words are drawn on a picture so many times as large."""
KNOWN, KIN, UNKNOWN = "#17b26a", "#f5a524", "#e5484d"
"""A kind is told, only a family, neither."""
FONT_PX = 11.0


def seen_things(image: RgbdImage, X_WC: SE3) -> list[SeenThing]:
    """The things of a picture. Raises ConfigError if onnxruntime is not there."""
    return Eyes().look(image, X_WC)


def boxed(image: RgbdImage, things: list[SeenThing]) -> Pixels:
    """The picture, larger, with a box and words for each thing."""
    size = LARGER * image.width, LARGER * image.height
    canvas = Image.fromarray(image.picture()).resize(size, Image.Resampling.NEAREST)
    draw, font = ImageDraw.Draw(canvas), ImageFont.load_default(FONT_PX)
    for thing in things:
        colour = KNOWN if thing.name.kind else KIN if thing.name.family else UNKNOWN
        left, top, right, bottom = (LARGER * side for side in thing.box)
        draw.rectangle((left - 1, top - 1, right, bottom), outline=colour)
        text = f"{thing.words} {100.0 * thing.name.score:.0f}"
        width = draw.textlength(text, font)
        x = min(float(left), size[0] - width - 2.0)
        y = top - FONT_PX - 4.0 if top > FONT_PX + 4.0 else bottom + 1.0
        draw.rectangle((x - 1, y, x + width + 1, y + FONT_PX + 2), fill=colour)
        draw.text((x, y), text, "#000000", font)
    return np.asarray(canvas)


def plain(thing: SeenThing) -> dict[str, object]:
    """All there is to say of a thing: SI units, in the world's frame."""
    return {
        "words": thing.words, "kind": thing.name.kind, "family": thing.name.family,
        "score": round(thing.name.score, 4), "colours": list(thing.colours),
        "position": thing.p_W.round(4).tolist(),
        "sigma": np.sqrt(np.diag(thing.covariance_W)).round(4).tolist(),
        "size": [round(side, 4) for side in thing.size_m],
        "upright": round(thing.upright, 3), "box": list(thing.box),
        "pixels": int(thing.pixels.sum()), "range": round(thing.range_m, 3),
    }  # fmt: skip
