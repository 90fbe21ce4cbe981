"""The form of every kind of furniture: the parts it is made of, and the surfaces it offers.

One form serves the physics (`sim.assembly`) and the robot's prior map (`sim.atlas`). Parts and
surfaces are in the furniture's frame: x out of its front, z up, the origin on the floor under the
middle of its footprint.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import msgspec

from robot.se3 import Vector3
from sim.world_schema import Furniture

PANEL_M = 0.02
OPEN_M = 2.0  # clearance of a surface with nothing above it
BOARDS_M = (0.60, 0.87, 1.14)
LEVELS = {2: ("lower", "upper"), 3: ("lower", "middle", "upper")}
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")


class Part(msgspec.Struct, frozen=True):
    """A box or an upright cylinder: centre and full size [m]; `color` "" is the furniture's."""

    p: Vector3
    size_m: Vector3
    color: str = ""
    kind: Literal["box", "cylinder"] = "box"


class Surface(msgspec.Struct, frozen=True, kw_only=True):
    """A horizontal rectangle to put things on: its centre, extent and the free height above it.

    `level` tells the boards of a shelf apart ("lower"); "" is the furniture as a whole.
    """

    p: Vector3
    size_m: tuple[float, float]
    clearance_m: float = OPEN_M
    level: str = ""


class Form(msgspec.Struct, frozen=True):
    """What a piece of furniture is made of, and what can be put on it."""

    parts: tuple[Part, ...]
    surfaces: tuple[Surface, ...] = ()


class Kind(msgspec.Struct, frozen=True, kw_only=True):
    """A kind of furniture: how it is built, and what a world file need not say."""

    build: Callable[[Furniture, Vector3], Form]
    size_m: Vector3
    color: str
    movable: bool = False


def form(item: Furniture) -> Form:
    """The form of a piece of furniture (its kind must be known)."""
    return KINDS[item.kind].build(item, size_m(item))


def size_m(item: Furniture) -> Vector3:
    """Depth, width, height; a shelf is at least as high as its highest board."""
    depth, width, height = item.size_m or KINDS[item.kind].size_m
    if item.kind == "shelf":
        boards = item.boards_m or BOARDS_M
        height = max(boards) if item.size_m is None else max(height, *boards)
    return (depth, width, height)


def movable(item: Furniture) -> bool:
    """Whether it is a free body that can be pushed around."""
    return KINDS[item.kind].movable if item.movable is None else item.movable


def _top(size: Vector3) -> Surface:
    depth, width, height = size
    return Surface(p=(0.0, 0.0, height), size_m=(depth, width))


def _legs(size: Vector3, height: float, *, thick: float, inset: float, color: str) -> list[Part]:
    x, y = size[0] / 2 - inset - thick / 2, size[1] / 2 - inset - thick / 2
    corners = ((x, y), (x, -y), (-x, y), (-x, -y))
    box = (thick, thick, height)
    return [Part((cx, cy, height / 2), box, color) for cx, cy in corners]


def _table(_item: Furniture, size: Vector3) -> Form:
    depth, width, height = size
    top = Part((0, 0, height - 0.015), (depth, width, 0.03))
    legs = _legs(size, height - 0.03, thick=0.05, inset=0.03, color="")
    return Form((top, *legs), (_top(size),))


def _counter(_item: Furniture, size: Vector3) -> Form:
    """A kitchen counter: worktop, front with drawers, and a recess for the toes."""
    depth, width, height = size
    recess, body = 0.06, height - 0.04 - 0.10
    worktop = Part((0, 0, height - 0.02), (depth, width, 0.04), "worktop")
    front = Part((-0.01, 0, 0.10 + body / 2), (depth - 0.02, width, body))
    toe = Part((-recess / 2, 0, 0.05), (depth - recess, width, 0.10), "charcoal")
    count = max(1, round(width / 0.5))
    pitch = width / count
    middles = [(index + 0.5) * pitch - width / 2 for index in range(count)]
    grip = (0.012, 0.14, 0.014)
    grips = [Part((depth / 2 - 0.014, y, height - 0.12), grip, "steel") for y in middles]
    return Form((worktop, front, toe, *grips), (_top(size),))


def _shelf(item: Furniture, size: Vector3) -> Form:
    """Open at the front: boards between two sides and a back; as a whole, its middle board."""
    depth, width, height = size
    boards = tuple(sorted(item.boards_m or BOARDS_M))
    inner = width - 2 * PANEL_M
    side = (depth, PANEL_M, height)
    y = width / 2 - PANEL_M / 2
    parts = [Part((0, y, height / 2), side), Part((0, -y, height / 2), side)]
    parts.append(Part((PANEL_M / 2 - depth / 2, 0, height / 2), (PANEL_M, inner, height)))
    has_roof = height > boards[-1] + PANEL_M
    shown = (*boards, height) if has_roof else boards
    parts += [Part((0, 0, z - PANEL_M / 2), (depth, inner, PANEL_M)) for z in shown]
    levels = LEVELS.get(len(boards), ORDINALS)
    surfaces = [
        Surface(
            p=(PANEL_M / 2, 0.0, z),
            size_m=(depth - PANEL_M, inner),
            clearance_m=shown[index + 1] - PANEL_M - z if index + 1 < len(shown) else OPEN_M,
            level=levels[index] if len(boards) > 1 else "",
        )
        for index, z in enumerate(boards)
    ]
    if len(boards) > 1:
        middle = surfaces[len(boards) // 2]
        surfaces.append(msgspec.structs.replace(middle, level=""))
    return Form(tuple(parts), tuple(surfaces))


def _cabinet(_item: Furniture, size: Vector3) -> Form:
    depth, _, height = size
    body = Part((0, 0, height / 2), size)
    slit = Part((depth / 2, 0, height / 2), (0.002, 0.006, height - 0.06), "charcoal")
    grips = [
        Part((depth / 2 + 0.006, y, height * 0.7), (0.012, 0.014, 0.12), "steel")
        for y in (0.04, -0.04)
    ]
    return Form((body, slit, *grips), (_top(size),))


def _chair(_item: Furniture, size: Vector3) -> Form:
    depth, width, height = size
    seat = min(0.45, height)
    parts = [Part((0, 0, seat - 0.015), (depth, width, 0.03))]
    parts += _legs(size, seat - 0.03, thick=0.03, inset=0.01, color="")
    x, post = -depth / 2 + 0.015, height - seat
    for y in (width / 2 - 0.025, 0.025 - width / 2):
        parts.append(Part((x, y, seat + post / 2), (0.03, 0.03, post)))
    parts.append(Part((x, 0, height - 0.08), (0.02, width - 0.08, 0.16)))
    return Form(tuple(parts), (Surface(p=(0.02, 0, seat), size_m=(depth - 0.05, width)),))


def _sofa(_item: Furniture, size: Vector3) -> Form:
    depth, width, height = size
    seat, arm, back = min(0.42, height), 0.14, 0.18
    base = Part((0, 0, seat / 2), (depth, width, seat))
    rest = Part((back / 2 - depth / 2, 0, (height + seat) / 2), (back, width, height - seat))
    y = width / 2 - arm / 2
    arms = [Part((back / 2, s * y, seat + 0.08), (depth - back, arm, 0.16)) for s in (1, -1)]
    surface = Surface(p=(back / 2, 0, seat), size_m=(depth - back, width - 2 * arm))
    return Form((base, rest, *arms), (surface,))


def _bed(_item: Furniture, size: Vector3) -> Form:
    depth, width, height = size
    lying = height * 0.55
    frame = Part((0, 0, lying * 0.3), (depth, width, lying * 0.6), "oak")
    mattress = Part((0.02, 0, lying * 0.8), (depth - 0.06, width - 0.04, lying * 0.4))
    head = Part((0.02 - depth / 2, 0, height / 2), (0.04, width, height), "oak")
    pillow = Part((0.30 - depth / 2, 0, lying + 0.04), (0.35, width * 0.7, 0.08), "white")
    surface = Surface(p=(0.25, 0, lying), size_m=(depth - 0.6, width - 0.1))
    return Form((frame, mattress, head, pillow), (surface,))


def _box(_item: Furniture, size: Vector3) -> Form:
    return Form((Part((0, 0, size[2] / 2), size),), (_top(size),))


KINDS: dict[str, Kind] = {
    "table": Kind(build=_table, size_m=(0.60, 1.20, 0.72), color="oak"),
    "counter": Kind(build=_counter, size_m=(0.60, 1.80, 0.88), color="cream"),
    "shelf": Kind(build=_shelf, size_m=(0.30, 0.90, 1.14), color="oak"),
    "cabinet": Kind(build=_cabinet, size_m=(0.45, 0.80, 0.90), color="cream"),
    "chair": Kind(build=_chair, size_m=(0.42, 0.42, 0.85), color="walnut", movable=True),
    "sofa": Kind(build=_sofa, size_m=(0.85, 1.80, 0.80), color="teal"),
    "bed": Kind(build=_bed, size_m=(2.00, 1.40, 0.90), color="white"),
    "box": Kind(build=_box, size_m=(0.40, 0.40, 0.60), color="gray"),
}
