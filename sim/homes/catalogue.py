"""What homes of a kind are made of: the files of `kinds/`, and `goods.yaml` for all of them."""

from __future__ import annotations

from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Literal

import msgspec

from robot.errors import ConfigError, Problem
from robot.files import config
from robot.se3 import Vector3

Form = Literal["corridor", "grid", "enfilade", "open", "store"]
"""How the rooms lie to one another (`sim.homes.layout`)."""


class Record(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An entry of these files."""


class PieceKind(Record, frozen=True, kw_only=True):
    """A piece of furniture that a room may have; its size is nominal.

    Attributes:
        stands: with its back to a wall, free on the floor, or in a block of several, two and two
            back to back, each called by one of `names`.
        boards_m: heights of a shelf's boards; empty: as many as `boards` are drawn within reach.
        chance: how likely the room has it.
    """

    id: str
    kind: str
    size_m: Vector3
    name: str = ""
    synonyms: tuple[str, ...] = ()
    boards: int = 0
    boards_m: tuple[float, ...] = ()
    color: str = ""
    movable: bool | None = None
    stands: Literal["wall", "free", "block"] = "wall"
    chance: float = 1.0
    names: tuple[str, ...] = ()


class RoomKind(Record, frozen=True, kw_only=True):
    """A room that a home may have.

    Attributes:
        role: the hall that others lie along, the main room that the others are small to, the room
            beside it that no wall divides from it, or any other.
        always: whether no home is without it.
    """

    id: str
    size_m: tuple[float, float]
    floor: str
    name: str = ""
    synonyms: tuple[str, ...] = ()
    role: Literal["hall", "main", "beside", "room"] = "room"
    always: bool = False
    pieces: tuple[PieceKind, ...]


class SpotKind(Record, frozen=True, kw_only=True):
    """A point of the floor that has a name."""

    id: str
    synonyms: tuple[str, ...] = ()


class HomeKind(Record, frozen=True, kw_only=True):
    """A kind of home: of how many rooms, which, and where its goods are mostly kept (rooms)."""

    forms: tuple[Form, ...]
    count: tuple[int, int]
    rooms: tuple[RoomKind, ...]
    spots: tuple[SpotKind, ...]
    goods: dict[str, tuple[str, ...]]


class Good(Record, frozen=True, kw_only=True):
    """A kind of thing; what is `named` is called by that, the rest by its colour."""

    category: str
    plural: str
    shape: Literal["box", "cylinder"]
    size_m: Vector3
    mass_kg: float
    synonyms: tuple[str, ...] = ()
    named: dict[str, str] = {}
    colors: tuple[str, ...] = ()

    @property
    def variants(self) -> list[tuple[str, str]]:
        """Each thing there can be: its first word, and its colour."""
        return [*self.named.items(), *((color, color) for color in self.colors)]


class Someone(Record, frozen=True, kw_only=True):
    """Who may be at home."""

    id: str
    pronoun: Literal["her", "him"]
    height_m: float
    color: str


class Stock(Record, frozen=True, kw_only=True):
    """`goods.yaml`."""

    goods: tuple[Good, ...]
    people: tuple[Someone, ...]


def names() -> list[str]:
    """The kinds of homes there are."""
    return sorted(path.stem for path in (_folder() / "kinds").glob("*.yaml"))


@lru_cache
def home_kind(name: str) -> HomeKind:
    """A kind of home by name. Raises ConfigError with the nearest name."""
    if name not in names():
        hint = config.nearest(name, names())
        raise ConfigError([Problem(f"unknown kind of home {name!r}", suggestion=hint)])
    return config.load(_folder() / "kinds" / f"{name}.yaml", HomeKind)


@lru_cache
def stock() -> Stock:
    """All goods and people."""
    return config.load(_folder() / "goods.yaml", Stock)


def _folder() -> Path:
    return Path(str(resources.files("sim"))) / "homes"
