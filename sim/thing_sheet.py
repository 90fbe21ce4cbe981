"""One picture of all that the catalogue has, each thing on a ground of its own."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import mujoco
import numpy as np

from robot.se3 import SE3
from sim import bodies
from sim.assembly import set_light
from sim.paint import Paint
from sim.render import Image, Renderer, View
from sim.things.making import made
from sim.world_schema import Object

APART_M = 1.2
CELL_PX, CAPTION_PX = 200, 34
COLUMNS = 8
SCALE = 3.4
"""How far the eye is, of the largest extent of what it looks at."""
LEAST_M = 0.35
INK, PAPER = (40, 42, 46), (232, 233, 235)


def sheet(kinds: Iterable[str], *, variant: int = 0) -> Image:
    """A table of pictures with the names below, shape (height, width, 3)."""
    names = list(kinds)
    things = [made(name, variant) for name in names]
    spec = mujoco.MjSpec()
    paint = Paint(spec)
    set_light(spec, (0.0, 0.0, APART_M * len(names), APART_M))
    for light in spec.lights:
        light.castshadow = False  # its map is too coarse for a print on a can
    size = [APART_M * (len(names) + 4), 20.0, 0.1]
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=size,
        material=paint.plain("ground", (0.86, 0.86, 0.86)),
    )
    for number, (name, thing) in enumerate(zip(names, things, strict=True)):
        item = Object(
            id=f"thing_{number}", category=thing.category, color=thing.color, shape=thing.shape,
            size_m=thing.size_m, mass_kg=1.0, on="", kind=name, variant=variant,
        )  # fmt: skip
        at = SE3.from_xy_yaw(APART_M * number, 0.0, 0.0, z_m=thing.size_m[2] / 2)
        bodies.add_object(spec, item, at, paint)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    cells: list[Image] = []
    with Renderer(model, width=CELL_PX, height=CELL_PX) as renderer:
        for number, (name, thing) in enumerate(zip(names, things, strict=True)):
            extent = max(2 * thing.radius_m, thing.size_m[2], LEAST_M / SCALE)
            view = View(
                at=(APART_M * number, 0.0, thing.size_m[2] / 2), distance_m=SCALE * extent / 1.9,
                heading_deg=118.0, down_deg=28.0,
            )  # fmt: skip
            cells.append(_captioned(renderer.image(data, view), name, thing.mass_kg))
    blank = np.full_like(cells[0], PAPER[0])
    rows = [cells[start : start + COLUMNS] for start in range(0, len(cells), COLUMNS)]
    rows[-1] += [blank] * (COLUMNS - len(rows[-1]))
    return np.concatenate([np.concatenate(row, axis=1) for row in rows], axis=0)


def _captioned(image: Image, name: str, mass_kg: float) -> Image:
    """A picture with a name and a weight below."""
    from PIL import Image as Picture
    from PIL import ImageDraw, ImageFont

    cell = Picture.new("RGB", (CELL_PX, CELL_PX + CAPTION_PX), PAPER)
    cell.paste(Picture.fromarray(image), (0, 0))
    draw: Any = ImageDraw.Draw(cell)
    text = f"{name}, {1000 * mass_kg:.0f} g"
    draw.text((CELL_PX / 2, CELL_PX + CAPTION_PX / 2), text, fill=INK, anchor="mm",
              font=ImageFont.load_default(size=15))  # fmt: skip
    return np.asarray(cell)
