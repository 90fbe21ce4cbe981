"""Rooms of a home: which, how they lie to one another, and the doors that lead to all of them.

Every plan is rows of rooms, one row north of the other, all in whole centimetres. Between two rooms
is one wall, which one of them owns: in a row the western one, between rows the wider row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product

import numpy as np

from sim.homes.catalogue import Form, RoomKind
from sim.homes.choosing import Chosen
from sim.homes.draws import one_of
from sim.world_schema import Door, Room, Side

WALL_CM = 8
DOORS_CM = (80, 85, 90, 95, 100)
JAMB_CM = 16
"""Of wall at least beside a door: a corner of a room hides no door."""
STRETCH = (0.88, 1.18)
"""Of a room, to what is usual for it."""
HALL_LENGTH_CM = 420
MOST_ON_ONE_SIDE = 3
"""Of rooms: more lie on both sides of a hall."""
SECOND_DOOR = 0.15
"""How likely two rooms have a door that no way needs."""
OPPOSITE: dict[Side, Side] = {"north": "east", "east": "north", "south": "west", "west": "south"}
"""Where a side is when x and y change places."""


@dataclass
class _Cell:
    """A room that is being laid out: its rectangle [cm], its walls and its doors."""

    kind: RoomKind
    low: list[int]
    high: list[int]
    walls: list[Side] = field(default_factory=list[Side])
    doors: list[tuple[Side, int, int]] = field(default_factory=list[tuple[Side, int, int]])


@dataclass(frozen=True)
class _Border:
    """Where two rooms meet: on that side of the first, which owns the wall (none: it is open)."""

    owner: _Cell
    other: _Cell
    side: Side
    low: int
    high: int
    is_open: bool = False


def rooms(chosen: Chosen, rng: np.random.Generator) -> tuple[Room, ...]:
    """Rooms with their walls and doors; from each of them a way leads to each other."""
    rows = _rows(chosen.form, list(chosen.rooms), rng)
    cells = _laid_out(rows, rng)
    borders = [*_within_rows(cells), *_between_rows(cells)]
    _walls_around(cells)
    _doors(borders, rng)
    flat = [cell for row in cells for cell in row]
    turned = bool(rng.random() < 0.5)
    return tuple(_room(cell, _middle(flat), turned=turned) for cell in flat)


def _rows(
    form: Form, chosen: list[RoomKind], rng: np.random.Generator
) -> list[list[tuple[RoomKind, bool]]]:
    """Rows of rooms from the south, each with whether it is open to the next one in its row."""
    role = "hall" if form == "corridor" else "main"
    first = [room for room in chosen if room.role == role]
    rest = [room for room in chosen if room not in first]
    rest.sort(key=lambda room: room.role != "beside")
    half = (len(rest) + 1) // 2
    if form in ("corridor", "store"):
        cut = int(rng.choice((0, len(rest)))) if len(rest) <= MOST_ON_ONE_SIDE else half
        rows = [rest[:cut], first, rest[cut:]]
    elif form == "open":
        rows = [[*first, *rest[:1]], rest[1:]]
    elif form == "grid":
        half = (len(chosen) + 1) // 2
        rows = [chosen[:half], chosen[half:]]
    else:
        rows = [chosen]
    return [[(room, form == "open" and room.role == "main") for room in row] for row in rows if row]


def _laid_out(
    rows: list[list[tuple[RoomKind, bool]]], rng: np.random.Generator
) -> list[list[_Cell]]:
    """Rectangles: rows as wide as one another where that stretches no room too far."""
    sizes = [[_even(100 * side * rng.uniform(*STRETCH)) for room, _ in row for side in room.size_m]
             for row in rows]  # fmt: skip
    widths = [size[0::2] for size in sizes]
    depths = [max(size[1::2]) for size in sizes]
    for row, width in zip(rows, widths, strict=True):
        if len(row) == 1 and row[0][0].role in ("hall", "main"):
            others = [_total(w, r) for w, r in zip(widths, rows, strict=True) if r is not row]
            own = HALL_LENGTH_CM if row[0][0].role == "hall" else width[0]
            width[:] = [max(own, *others, 0)]
    widest = max(_total(w, r) for w, r in zip(widths, rows, strict=True))
    placed: list[list[_Cell]] = []
    y = 0
    for row, width, depth in zip(rows, widths, depths, strict=True):
        missing = widest - _total(width, row)
        if missing <= 0.35 * widest and rng.random() < 0.8:
            share = _even(missing / len(width))
            width[:-1] = [w + share for w in width[:-1]]
            width[-1] += missing - share * (len(width) - 1)
        x = 0 if rng.random() < 0.5 else widest - _total(width, row)
        cells: list[_Cell] = []
        for (room, is_open), w in zip(row, width, strict=True):
            cells.append(_Cell(room, [x, y], [x + w, y + depth]))
            x += w + (0 if is_open and len(row) > 1 else WALL_CM)
        placed.append(cells)
        y += depth + WALL_CM
    return placed


def _total(widths: list[int], row: list[tuple[RoomKind, bool]]) -> int:
    """Width of a row with its walls."""
    return sum(widths) + WALL_CM * sum(not is_open for _, is_open in row[:-1])


def _even(length: float) -> int:
    """Whole decimetres: then middles are whole centimetres, and people can read them."""
    return 10 * max(1, round(length / 10))


def _within_rows(rows: list[list[_Cell]]) -> list[_Border]:
    """Borders between neighbours of a row; the western one gets the wall."""
    found: list[_Border] = []
    for west, east in (pair for row in rows for pair in pairwise(row)):
        is_open = west.high[0] == east.low[0]
        if not is_open:
            west.walls.append("east")
        found.append(_Border(west, east, "east", west.low[1], west.high[1], is_open=is_open))
    return found


def _between_rows(rows: list[list[_Cell]]) -> list[_Border]:
    """Borders between a row and the next; all rooms of the wider row get the wall."""
    found: list[_Border] = []
    for south, north in pairwise(rows):
        owned = _span(south) >= _span(north)
        for cell in south if owned else north:
            cell.walls.append("north" if owned else "south")
        for one, other in product(south, north):
            low, high = max(one.low[0], other.low[0]), min(one.high[0], other.high[0])
            if low < high:
                found.append(
                    _Border(one, other, "north", low, high)
                    if owned
                    else _Border(other, one, "south", low, high)
                )
    return found


def _span(row: list[_Cell]) -> int:
    return row[-1].high[0] - row[0].low[0]


def _walls_around(rows: list[list[_Cell]]) -> None:
    """Walls to the outside."""
    for row in rows:
        row[0].walls.append("west")
        row[-1].walls.append("east")
    for cell in rows[0]:
        cell.walls.append("south")
    for cell in rows[-1]:
        cell.walls.append("north")


def _doors(borders: Sequence[_Border], rng: np.random.Generator) -> None:
    """Doors that join all rooms, those to a hall or the main room first, and a few more.

    The tree of least weight [Kruskal1956], its weights drawn at random.
    """
    group: dict[str, str] = {}

    def top(name: str) -> str:
        while group.get(name, name) != name:
            name = group[name]
        return name

    def weight(border: _Border) -> float:
        roles = {border.owner.kind.role, border.other.kind.role}
        ranked = 0.0 if border.is_open else 1.0 if roles & {"hall", "main"} else 2.0
        return ranked + float(rng.random())

    for border in sorted(borders, key=weight):
        one, other = top(border.owner.kind.id), top(border.other.kind.id)
        if border.is_open:
            group[one] = other
        elif border.high - border.low >= DOORS_CM[-1] + 2 * JAMB_CM:
            if one != other or rng.random() < SECOND_DOOR:
                border.owner.doors.append(_door(border, rng))
            group[one] = other


def _door(border: _Border, rng: np.random.Generator) -> tuple[Side, int, int]:
    """A door of a wall: side, middle along it from the owner's [cm], width [cm]."""
    width = one_of(DOORS_CM, rng)
    along = 0 if border.side in ("north", "south") else 1
    middle = (border.owner.low[along] + border.owner.high[along]) // 2
    edge = JAMB_CM + (width + 1) // 2
    low, high = border.low + edge - middle, border.high - edge - middle
    return border.side, int(5 * rng.integers(-(-low // 5), high // 5 + 1)), width


def _middle(cells: list[_Cell]) -> tuple[int, int]:
    """Of the whole home: worlds have their origin there."""
    low = [min(cell.low[axis] for cell in cells) for axis in (0, 1)]
    high = [max(cell.high[axis] for cell in cells) for axis in (0, 1)]
    return (low[0] + high[0]) // 2, (low[1] + high[1]) // 2


def _room(cell: _Cell, origin: tuple[int, int], *, turned: bool) -> Room:
    """A room of a world, with x and y in each other's place if the home is turned."""
    order = (1, 0) if turned else (0, 1)
    middle = [(cell.low[axis] + cell.high[axis]) / 2 - origin[axis] for axis in order]
    size = [cell.high[axis] - cell.low[axis] for axis in order]
    sides: tuple[Side, ...] = ("north", "east", "south", "west")
    walls = {OPPOSITE[side] if turned else side for side in cell.walls}
    doors = tuple(
        Door(wall=OPPOSITE[side] if turned else side, at_m=at / 100, width_m=width / 100)
        for side, at, width in cell.doors
    )
    return Room(
        id=cell.kind.id,
        name=cell.kind.name,
        synonyms=cell.kind.synonyms,
        at_m=(round(middle[0] / 100, 3), round(middle[1] / 100, 3)),
        size_m=(size[0] / 100, size[1] / 100),
        walls=tuple(side for side in sides if side in walls),
        doors=doors,
        floor=cell.kind.floor,
    )
