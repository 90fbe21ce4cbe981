"""A picture of any size as what a network takes, and boxes of the network in the picture again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from robot.files.pictures import Picture

BORDER = 114
"""The grey around a picture that is not of the network's proportions, as YOLO is trained with."""

Array = NDArray[np.float32]


@dataclass(frozen=True)
class Letterbox:
    """How a picture lies in the network's: `network = scale * picture + offset` [px]."""

    scale: float
    offset_x: int
    offset_y: int

    def boxes_in_picture(self, boxes: Array, size: tuple[int, int]) -> Array:
        """Boxes x1, y1, x2, y2 of the network in a picture of so many pixels across and down."""
        moved = boxes - np.array([self.offset_x, self.offset_y] * 2, dtype=np.float32)
        inside = np.clip(moved / self.scale, 0.0, np.array(size * 2, dtype=np.float32))
        return inside.astype(np.float32)


def letterboxed(picture: Picture, size: tuple[int, int]) -> tuple[Array, Letterbox]:
    """A picture in the middle of grey, as the network takes it.

    Args:
        picture: red, green, blue, shape (height, width, 3).
        size: width and height that the network takes.

    Returns:
        Red, green, blue from 0 to 1, shape (1, 3, height, width); and how the picture lies in it.
    """
    height, width = picture.shape[:2]
    scale = min(size[0] / width, size[1] / height)
    across, down = max(1, round(width * scale)), max(1, round(height * scale))
    offset_x, offset_y = (size[0] - across) // 2, (size[1] - down) // 2
    resized = Image.fromarray(picture).resize((across, down), Image.Resampling.BILINEAR)
    canvas = np.full((size[1], size[0], 3), BORDER, dtype=np.uint8)
    canvas[offset_y : offset_y + down, offset_x : offset_x + across] = np.asarray(resized)
    tensor = canvas.transpose(2, 0, 1)[None].astype(np.float32) / np.float32(255.0)
    return np.ascontiguousarray(tensor), Letterbox(scale, offset_x, offset_y)
