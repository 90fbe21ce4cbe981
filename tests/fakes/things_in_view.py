"""Things as eyes see them, for what makes names and tracks of them."""

from __future__ import annotations

import numpy as np

from robot.messages import RgbdImage
from robot.perception.sight.measuring import Measured
from robot.perception.things.eyes import SeenThing
from robot.perception.things.naming import Classes, Name, Sure

CLASSES = Classes(
    ("mug", "wine_glass", "banana", "apple", "cereal_box", "", "nothing"),
    ("cups", "cups", "fruit", "fruit", "boxes", "", "nothing"),
)
SURE = Sure(0.9, 0.97)
CUP_M = (0.07, 0.07, 0.10)


def picture_of(depth_m: np.ndarray, *, focal_px: float = 208.0) -> RgbdImage:
    """A picture in one colour with a depth for each pixel, shape (height, width)."""
    height, width = depth_m.shape
    pixels = np.tile(np.array((40, 160, 60), np.uint8), (height, width, 1))
    return RgbdImage(
        stamp_s=0.0, width=width, height=height, focal_px=(focal_px, focal_px),
        centre_px=((width - 1) / 2, (height - 1) / 2), frame="head_camera",
        colours=pixels.tobytes(), depth_m=depth_m.astype(np.float32).tobytes(),
    )  # fmt: skip


def measured(
    p_W: tuple[float, float, float] = (1.0, 0.0, 0.76),
    *,
    kind: str = "",
    certain: float = 0.6,
    colours: tuple[str, ...] = ("red",),
    size_m: tuple[float, float, float] = CUP_M,
    pixels: int = 500,
    is_whole: bool = True,
    sigma_m: float = 0.004,
) -> Measured:
    """A look at a thing that is taken for a kind, with so much certainty."""
    chances = np.full(len(CLASSES.names), (1.0 - certain) / (len(CLASSES.names) - 1))
    chances[CLASSES.names.index(kind)] = certain
    mask = np.zeros((60, 80), dtype=np.bool_)
    mask.ravel()[:pixels] = True
    thing = SeenThing(
        name=Name("", "", 0.0), chances=chances, colours=colours, p_W=np.array(p_W),
        covariance_W=np.eye(3) * sigma_m**2, size_m=size_m, upright=0.99, pixels=mask, range_m=1.0,
    )  # fmt: skip
    return Measured(
        thing, np.array(p_W), np.eye(3) * sigma_m**2, size_m, size_m[0], 0.004, 0.0,
        p_W[2] - size_m[2] / 2, is_whole,
    )  # fmt: skip
