"""A map as a picture: dark is full, light is free, grey is unknown, the way in colour."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from robot.fusion.slam.map_file import SavedMap
from robot.fusion.slam.numerics import by_blocks

WAY = (31, 119, 180)
BEGIN, END = (44, 160, 44), (214, 39, 40)
MOST_PIXELS = 2400
WALL = 160


def drawn(saved: SavedMap) -> bytes:
    """A PNG with x to the right and y up, a pixel a cell or, of large maps, several."""
    cells = saved.grid.cells
    coarser = int(np.ceil(max(cells.shape) / MOST_PIXELS))
    if coarser > 1:
        light, dark = by_blocks(cells, coarser)
        # A wall must not vanish between free cells.
        cells = np.where(dark > WALL, dark, light)
    pixels = np.repeat(255 - cells[:, :, None], 3, axis=2).astype(np.uint8)
    where = (saved.trajectory[:, 1:3] - saved.grid.origin_m) / (saved.grid.cell_m * coarser)
    columns = np.clip(where.astype(np.int64), 0, np.array(cells.shape) - 1)
    pixels[columns[:, 0], columns[:, 1]] = WAY
    for index, colour in ((0, BEGIN), (-1, END)):
        if len(columns):
            x, y = columns[index]
            pixels[max(0, x - 3) : x + 4, max(0, y - 3) : y + 4] = colour
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels.transpose(1, 0, 2)[::-1])).save(file, "PNG")
    return file.getvalue()
