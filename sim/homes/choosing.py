"""Which rooms a home has: as many as usual for its kind, or as many as somebody wants."""

from __future__ import annotations

from dataclasses import dataclass

import msgspec
import numpy as np

from robot.errors import ConfigError, Problem
from sim.homes.catalogue import Form, HomeKind, PieceKind, RoomKind
from sim.homes.draws import one_of, shuffled

MOST_IN_A_ROW = 4
"""Of rooms: a longer row would be no home."""
MOST_ROOMS = 16
"""A hall with seven rooms on either side is 25 m long."""
LARGE: tuple[Form, ...] = ("corridor", "store", "grid")
"""Forms for more rooms than usual: two long rows, and a way to all of them."""
AGAIN = ("guest", "garden", "corner", "annexe", "attic")
"""What the second room of a kind is called, the third, ...: by words that nothing else has, as "the
second bedroom" could as well be the second of several."""


@dataclass(frozen=True)
class Chosen:
    """How rooms lie to one another, and which."""

    form: Form
    rooms: tuple[RoomKind, ...]


def chosen(kind: HomeKind, rng: np.random.Generator, *, count: int | None = None) -> Chosen:
    """The rooms of one home, shuffled; a hall only where rooms lie along it.

    Args:
        kind: of the home.
        rng: of what is drawn.
        count: of rooms, the hall included (see `check`); None: as usual.
    """
    form: Form = one_of(kind.forms if count is None else _forms(kind, count), rng)
    least, most = kind.count
    found = _needed(kind, form)
    rest = [room for room in kind.rooms if room.role != "hall" and not room.always]
    if form == "enfilade":
        most = MOST_IN_A_ROW
    more = (int(rng.integers(least, most + 1)) if count is None else count) - len(found)
    rest = shuffled(rest, rng)
    if count is not None:
        rest += _again(kind, rng)
    found += rest[: max(0, more)]
    return Chosen(form, tuple(shuffled(found, rng)))


def check(kind: HomeKind, name: str, count: int) -> None:
    """Refuse a number of rooms that no home of a kind has. Raises ConfigError."""
    counts = [number for number in range(1, MOST_ROOMS + 1) if _forms(kind, number)]
    if count not in counts:
        cure = f"from {counts[0]} to {counts[-1]}"
        raise ConfigError([Problem(f"a {name} of {count} rooms cannot be made", suggestion=cure)])


def _forms(kind: HomeKind, count: int) -> tuple[Form, ...]:
    """In which so many rooms can lie, each once."""
    is_large = count > kind.count[1]
    found: list[Form] = [
        form
        for form in dict.fromkeys(kind.forms)
        if len(_needed(kind, form)) <= count
        and count <= (MOST_IN_A_ROW if form == "enfilade" else MOST_ROOMS)
        and (form in LARGE or not is_large)
    ]
    return tuple(found)


def _needed(kind: HomeKind, form: Form) -> list[RoomKind]:
    """The rooms that no home of this form is without."""
    halls = [room for room in kind.rooms if room.role == "hall"]
    always = [room for room in kind.rooms if room.role != "hall" and room.always]
    return (halls[:1] if form == "corridor" else []) + always


def _again(kind: HomeKind, rng: np.random.Generator) -> list[RoomKind]:
    """Ordinary rooms a second time, a third, ..., they and all in them by other names."""
    ordinary = [room for room in kind.rooms if room.role not in ("hall", "main")]
    return [_called(room, word) for word in AGAIN for room in shuffled(ordinary, rng)]


def _called(room: RoomKind, word: str) -> RoomKind:
    return msgspec.structs.replace(
        room,
        id=f"{word}_{room.id}",
        name=f"{word} {room.name}" if room.name else "",
        synonyms=(),
        role="room",
        always=False,
        pieces=tuple(_piece(piece, word) for piece in room.pieces),
    )


def _piece(piece: PieceKind, word: str) -> PieceKind:
    return msgspec.structs.replace(
        piece,
        id=f"{word}_{piece.id}" if not piece.names else piece.id,
        name=f"{word} {piece.name}" if piece.name else "",
        synonyms=(),
        names=tuple(f"{word}_{name}" for name in piece.names),
    )
