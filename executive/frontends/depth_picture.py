"""A camera's picture for people: colours, and beside them depth as colours with a scale."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from robot.messages import RgbdImage

Pixels = NDArray[np.uint8]
STOPS = np.array(
    [(48, 18, 59), (65, 110, 224), (36, 192, 213), (120, 240, 100), (240, 190, 50), (228, 70, 20)],
    dtype=np.float64,
)[::-1]
"""Near is warm, far is cold: after Google's turbo (Mikhailov 2019)."""
NOTHING = (0, 0, 0)
"""Where no depth was measured."""
SCALE_SHARE = 0.06
"""Of the picture's height, below the depth."""


def span_m(depth_m: NDArray[np.float32]) -> tuple[float, float]:
    """From where to where a scale goes: all that was measured but single pixels."""
    measured = depth_m[depth_m > 0.0]
    if not measured.size:
        return 0.0, 1.0
    near, far = np.percentile(measured, (0.5, 99.5)).tolist()
    return near, max(far, near + 0.1)


def in_colours(depth_m: NDArray[np.float32], near_m: float, far_m: float) -> Pixels:
    """Depth [m], shape (height, width), as a picture; black where none was measured."""
    share = np.clip((depth_m - near_m) / (far_m - near_m), 0.0, 1.0) * (len(STOPS) - 1)
    places = np.arange(len(STOPS))
    channels = [np.interp(share, places, STOPS[:, channel]) for channel in range(3)]
    picture = np.stack(channels, axis=-1).astype(np.uint8)
    picture[depth_m <= 0.0] = NOTHING
    return picture


def side_by_side(image: RgbdImage) -> Pixels:
    """Colours on the left; depth on the right, if there is any, with its scale below."""
    colours, depth_m = image.picture(), image.depth()
    if depth_m is None:
        return colours
    near_m, far_m = span_m(depth_m)
    bar = max(12, round(SCALE_SHARE * image.height))
    whole = Image.new("RGB", (2 * image.width, image.height + bar), "#ffffff")
    whole.paste(Image.fromarray(colours), (0, 0))
    whole.paste(Image.fromarray(in_colours(depth_m, near_m, far_m)), (image.width, 0))
    row = np.linspace(near_m, far_m, image.width // 2, dtype=np.float32)
    scale = in_colours(np.tile(row, (bar // 2, 1)), near_m, far_m)
    whole.paste(Image.fromarray(scale), (image.width + image.width // 4, image.height + bar // 4))
    draw, font = ImageDraw.Draw(whole), ImageFont.load_default(0.75 * bar)
    middle = image.height + bar // 2
    at = image.width + image.width // 4
    draw.text((at - bar // 2, middle), f"{near_m:.1f} m", "#1b2230", font, anchor="rm")
    at += image.width // 2
    draw.text((at + bar // 2, middle), f"{far_m:.1f} m", "#1b2230", font, anchor="lm")
    return np.asarray(whole)
