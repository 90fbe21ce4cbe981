"""Likely places come first: said ones, surfaces for things, where such things are; seats last."""

import msgspec
import pytest

from executive.skills.motions.habits import usual_places
from executive.skills.motions.likelihood import LIKELY, SAID, UNLIKELY, prospects
from executive.skills.motions.survey import Prospect
from robot.messages import ObjectInfo, Place, Shape, Track, WorldMap
from robot.se3 import SE3

SHAPE = Shape(kind="box", size_m=(0.06, 0.06, 0.1))


def thing(name: str, category: str) -> ObjectInfo:
    return ObjectInfo(id=name, name=name, category=category, color="", shape=SHAPE, mass_kg=0.2)


def surface(name: str, kind: str, x_m: float, z_m: float, size: float = 0.6) -> Place:
    X_WP = SE3((x_m, 0.0, z_m))
    return Place(id=name, name=name, X_WP=X_WP, size_m=(size, size), of=name, kind=kind)


PLACES = (
    surface("table", "table", 0.0, 0.74),
    surface("chair", "chair", 2.0, 0.45),
    surface("machine", "box", 4.0, 1.4, size=1.5),
    surface("nightstand", "box", 6.0, 0.62),
    surface("sofa", "sofa", 8.0, 0.42),
    surface("book rack", "shelf", 10.0, 0.9),
    surface("cabinet", "cabinet", 12.0, 0.85),
)
BOOK, OTHER, CAN = thing("novel", "book"), thing("atlas", "book"), thing("cola", "can")
MAP = WorldMap(
    stamp_s=0.0,
    name="home",
    obstacles=(),
    places=PLACES,
    objects=(BOOK, OTHER, CAN),
    people=(),
    categories={},
    bounds_m=(-1, -1, 14, 1),
)


def on(info: ObjectInfo, place: Place) -> Track:
    x_m, y_m, z_m = place.X_WP.p
    return Track(id=info.id, X_WO=SE3((x_m, y_m, z_m + 0.05)), seen_s=1.0)


def of(info: ObjectInfo, *tracks: Track, said: tuple[str, ...] = ()) -> dict[str, Prospect]:
    return {found.place.id: found for found in prospects(info, MAP, tracks, said=said)}


def test_seats_and_machines_wait_until_nothing_else_is_left() -> None:
    ranks = {name: found.rank for name, found in of(CAN).items()}
    assert ranks == {place.id: LIKELY for place in PLACES} | {
        "chair": UNLIKELY,
        "machine": UNLIKELY,
    }


def test_a_seat_that_things_are_on_is_a_surface() -> None:
    assert of(BOOK, on(CAN, PLACES[1]))["chair"].rank == LIKELY


def test_what_was_said_comes_before_everything() -> None:
    found = of(CAN, said=("chair",))
    assert found["chair"].rank == SAID
    assert all(other.rank > SAID for name, other in found.items() if name != "chair")


def test_tables_are_more_likely_than_sofas() -> None:
    found = of(CAN)
    assert found["table"].worth > found["nightstand"].worth > found["sofa"].worth


def test_where_others_of_its_sort_are_is_likely() -> None:
    found = of(BOOK, on(OTHER, PLACES[6]), on(CAN, PLACES[0]))
    assert found["cabinet"].worth > found["table"].worth
    gone = msgspec.structs.replace(on(OTHER, PLACES[6]), missing=True)
    assert of(BOOK, gone)["cabinet"].worth == of(BOOK)["cabinet"].worth


def test_a_place_that_is_called_after_such_things_is_likely() -> None:
    assert of(BOOK)["book rack"].worth > of(CAN)["book rack"].worth


def test_a_place_called_after_just_such_things_is_more_likely_than_one_after_others() -> None:
    """Picture books were looked for on a book cart and a book repair table first."""
    shelf = surface("picture book shelf", "shelf", 0.0, 0.9)
    cart = surface("book cart", "shelf", 2.0, 0.9)
    home = msgspec.structs.replace(MAP, places=(shelf, cart))
    found = {one.place.id: one.worth for one in prospects(thing("red", "picture book"), home, ())}
    assert found["picture book shelf"] > found["book cart"]
    others = {one.place.id: one.worth for one in prospects(BOOK, home, ())}
    assert others["picture book shelf"] == others["book cart"]


def test_a_low_chest_that_is_called_after_such_things_is_looked_at_with_the_likely_places() -> None:
    """A toy car was looked for on every table and shelf of a library before the toy chest."""
    chest, crate = (
        surface(name, "box", x_m, 0.45) for name, x_m in (("toy chest", 0), ("crate", 2))
    )
    home = msgspec.structs.replace(MAP, places=(chest, crate))
    ranks = {one.place.id: one.rank for one in prospects(thing("car", "toy"), home, ())}
    assert ranks == {"toy chest": LIKELY, "crate": UNLIKELY}
    box = msgspec.structs.replace(crate, id="toy box", name="toy box")
    home = msgspec.structs.replace(MAP, places=(chest, box))
    found = {one.place.id: one.worth for one in prospects(thing("photo box", "box"), home, ())}
    assert found["toy box"] == found["toy chest"]  # what it is made as says nothing


@pytest.mark.parametrize("name", ["flea spray", "dog biscuits", "cat food can"])
def test_what_is_for_a_pet_is_looked_for_where_pets_are(name) -> None:
    """A flea spray was looked for in the kitchen and on two medicine shelves first (97 s)."""
    stand, other = (
        surface(called, "cabinet", x_m, 0.9) for called, x_m in (("pet stand", 0), ("locker", 2))
    )
    home = msgspec.structs.replace(MAP, places=(stand, other))
    found = {one.place.id: one.worth for one in prospects(thing("it", name), home, ())}
    assert found["pet stand"] > found["locker"]


def room(name: str, *synonyms: str) -> Place:
    return Place(
        id=name, name=name, X_WP=SE3(), size_m=(4, 4), room=name, floor=True, synonyms=synonyms
    )


def test_things_are_kept_where_people_keep_such_things() -> None:
    desk, worktop = surface("desk", "table", 0.0, 0.74), surface("worktop", "counter", 9.0, 0.9)
    home = msgspec.structs.replace(
        MAP,
        places=(
            room("tea_corner", "kitchenette"),
            room("bureau"),
            msgspec.structs.replace(desk, room="bureau"),
            msgspec.structs.replace(worktop, room="tea_corner"),
        ),
    )

    def best(info: ObjectInfo) -> str:
        return max(prospects(info, home, ()), key=lambda found: found.worth).place.id

    assert best(thing("blue mug", "mug")) == "worktop"
    assert best(thing("red stapler", "stapler")) == "desk"
    assert usual_places(thing("gizmo", "gizmo"), home) == frozenset()


def test_furniture_says_what_it_is_for_wherever_it_stands() -> None:
    bench = surface("workbench", "table", 0.0, 0.92)
    home = msgspec.structs.replace(
        MAP, places=(room("bedroom"), msgspec.structs.replace(bench, room="bedroom"))
    )
    assert usual_places(thing("wood glue", "bottle"), home) == {"workbench"}


def test_what_is_in_a_can_says_more_than_the_can() -> None:
    """A can of varnish was looked for in the whole galley first."""
    home = msgspec.structs.replace(MAP, places=(room("kitchen"), room("workshop")))
    assert usual_places(thing("varnish can", "can"), home) == {"workshop"}
    assert usual_places(thing("cola can", "can"), home) == {"kitchen"}
    assert usual_places(thing("green can", "can"), home) == {"kitchen"}


@pytest.mark.parametrize(
    ("name", "category", "kept"),
    [
        ("painkiller box", "box", "treatment room"),
        ("vitamin jar", "jar", "treatment room"),
        ("floor polish", "bottle", "utility room"),
        ("sewing kit", "kit", "parlour"),
    ],
)
def test_what_people_heal_clean_and_sew_with_has_its_rooms_too(name, category, kept) -> None:
    """Painkillers were looked for in every room but the one with the medicine cabinet first."""
    rooms = ("kitchen", "treatment room", "utility room", "parlour")
    home = msgspec.structs.replace(MAP, places=tuple(room(called) for called in rooms))
    assert usual_places(thing(name, category), home) == {kept}


def test_a_plural_is_kept_where_one_is() -> None:
    home = msgspec.structs.replace(MAP, places=(room("office"),))
    assert usual_places(thing("staplers", "thing"), home) == {"office"}


def test_a_herb_is_looked_for_where_herbs_are() -> None:
    """A basil pot was looked for in the whole galley before the herb rack on the deck."""
    rack = surface("herb rack", "shelf", 9.0, 0.8)
    home = msgspec.structs.replace(MAP, places=(room("deck"), room("bath"), rack))
    assert usual_places(thing("basil pot", "pot"), home) == {"herb rack"}
