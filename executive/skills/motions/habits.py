"""Where people keep things: mugs in kitchens, shampoo in bathrooms; the table is `habits.yaml`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import msgspec

from robot.files.config import load
from robot.messages import ObjectInfo, Place, WorldMap

_WORD = re.compile(r"[^\W\d_]+")


class Habit(msgspec.Struct, frozen=True, kw_only=True):
    """Words for things, and words for the rooms and furniture that they are kept in.

    What is `vague` (cans, bottles) says where only if no other word of a name does.
    """

    things: tuple[str, ...]
    rooms: tuple[str, ...]
    vague: bool = False


def usual_places(info: ObjectInfo, world_map: WorldMap) -> frozenset[str]:
    """Ids of the rooms and surfaces of a map in which, or on which, people would keep an object."""
    named = words((info.plain_name, info.category, *info.synonyms))
    telling = [habit for habit in _habits() if not named.isdisjoint(habit.things)]
    telling = [habit for habit in telling if not habit.vague] or telling
    kept = {room for habit in telling for room in habit.rooms}
    return frozenset(place.id for place in world_map.places if not kept.isdisjoint(_called(place)))


def words(names: Iterable[str]) -> frozenset[str]:
    """The words of some names, lower case; a plural in -s counts as its singular too."""
    found = {word.casefold() for name in names for word in _WORD.findall(name.replace("_", " "))}
    return frozenset(found | {word.removesuffix("s") for word in found})


def _called(place: Place) -> frozenset[str]:
    return words((place.id, place.name, *place.synonyms))


@cache
def _habits() -> tuple[Habit, ...]:
    return tuple(load(Path(__file__).with_name("habits.yaml"), list[Habit]))
