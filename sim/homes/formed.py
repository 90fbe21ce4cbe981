"""Homes whose things have their real forms (`sim.things`): cups with handles, and fruit besides."""

from __future__ import annotations

import msgspec

from sim.homes.catalogue import Good, HomeKind, stock
from sim.things import catalogue
from sim.things.making import made
from sim.world_schema import Object

FORMS = {
    "mug": "mug", "cup": "tea_cup", "glass": "tumbler", "can": "drink_can",
    "bottle": "oil_bottle", "box": "tea_box", "carton": "milk_carton", "jar": "jam_jar",
    "tin": "coffee_tin", "vase": "vase", "thermos": "thermos", "paint can": "paint_can",
    "spray can": "spray_can", "pill bottle": "pill_bottle", "dispenser": "soap_dispenser",
}  # fmt: skip
"""What goods of a home are, in the catalogue of things."""
MORE = (
    "apple", "orange", "tomato", "pear", "lemon", "banana", "dip_bowl", "sugar_bowl", "wine_glass",
    "paper_cup", "travel_mug", "pasta_box", "juice_carton", "ketchup_bottle", "book",
)  # fmt: skip
"""What lies about besides, in any room: what the hand can take."""
VARIANTS = 1000


def of_kind(kind: HomeKind) -> HomeKind:
    """The same kind of home with more goods in it."""
    everywhere = tuple(room.id for room in kind.rooms)
    more = dict.fromkeys(map(catalogue.category, MORE), everywhere)
    return msgspec.structs.replace(kind, goods=more | kind.goods)


def goods() -> tuple[Good, ...]:
    """All goods, those of the catalogue too."""
    known = {good.category for good in stock().goods}
    more = (_good(name) for name in MORE if catalogue.category(name) not in known)
    return (*stock().goods, *more)


def _good(name: str) -> Good:
    thing = made(name)
    return Good(
        category=thing.category, plural=catalogue.plural(name), shape=thing.shape,
        size_m=thing.size_m, mass_kg=thing.mass_kg, colors=catalogue.kind(name).colors,
    )  # fmt: skip


def shaped(item: Object, variant: int) -> Object:
    """The same with a form of its own, where its category has one; its colour stays."""
    names = FORMS | {catalogue.category(name): name for name in MORE}
    if item.category not in names:
        return item
    name = names[item.category]
    thing = made(name, variant, item.color)
    return msgspec.structs.replace(
        item, kind=name, variant=variant, shape=thing.shape, size_m=thing.size_m,
        mass_kg=round(thing.mass_kg, 4),
    )  # fmt: skip
