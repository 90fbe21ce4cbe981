"""Things of one colour are told apart by how large and of what form they are, or not at all."""

from __future__ import annotations

from robot.messages import ObjectInfo, Place, Shape
from robot.perception.sight.likeness import Knowledge, kinds_of
from robot.perception.sight.measuring import Measured
from robot.perception.sight.recognising import Recogniser
from robot.perception.sight.tracking import Tracks
from robot.perception.things.naming import Classes
from robot.se3 import SE3
from robot.usual_things import usual
from tests.fakes.things_in_view import CLASSES, SURE, measured

HERE, THERE = (1.0, 0.0, 0.76), (1.4, 0.3, 0.76)
TALL, SHORT = (0.065, 0.065, 0.22), (0.066, 0.066, 0.115)


def told(id: str, category: str, color: str = "yellow") -> ObjectInfo:
    shape = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
    return ObjectInfo(id=id, name=id, category=category, color=color, shape=shape, mass_kg=0.2)


def plain(at=HERE, *, colour: str = "yellow", size_m=SHORT, roundness: float = 0.0) -> Measured:
    """A form that is of no kind that the namer knows."""
    one = measured(at, kind="", certain=0.9, colours=(colour,), size_m=size_m)
    return one._replace(roundness=roundness)


def names(things: list[Measured], *infos: ObjectInfo, looks: int = 4) -> dict[str, tuple]:
    recogniser, tracks, found = Recogniser(Knowledge(CLASSES, SURE, SURE)), Tracks(), {}
    recogniser.tell(infos, {})
    for k in range(looks):
        tracks.add(things, 0.2 * k)
        found = recogniser.named(tracks.things)
    return {id: tuple(track.p_W.round(2).tolist()) for id, track in found.items()}


CAN, BOTTLE = told("lemonade", "can"), told("oil", "bottle")


def test_a_tall_one_is_the_bottle_and_no_can():
    """The oil was taken for the lemonade can, which nobody had seen yet."""
    assert names([plain(size_m=TALL)], CAN, BOTTLE) == {"oil": HERE}
    assert names([plain(size_m=SHORT)], CAN, BOTTLE) == {"lemonade": HERE}


def test_a_round_one_is_the_mug_and_no_box():
    mug, box = told("mug", "mug", "green"), told("tea", "box", "green")
    size_m = (0.07, 0.07, 0.09)
    round_one = plain(colour="green", size_m=size_m, roundness=2.0)
    square = plain(colour="green", size_m=size_m, roundness=-1.7)
    assert names([round_one], mug, box) == {"mug": HERE}
    assert names([square], mug, box) == {"tea": HERE}


def test_what_two_told_things_fit_as_well_gets_no_name():
    jar, tin = told("honey", "jar"), told("tea_tin", "tin")
    assert names([plain()], jar, tin, looks=8) == {}


def test_of_two_kinds_that_fit_the_one_of_nearly_one_size_is_the_likelier() -> None:
    """The coffee cup on the workbench had no name, as an air filter may have any size."""
    cup, any_size = told("coffee", "cup", "white"), told("filter", "filter", "white")
    usual_cup = plain(colour="white", size_m=(0.073, 0.073, 0.095))
    assert names([usual_cup], cup, any_size) == {"coffee": HERE}
    assert "coffee" not in names([plain(colour="white", size_m=(0.1, 0.1, 0.15))], cup, any_size)


def test_two_that_were_told_alike_may_change_places():
    one, other = told("one", "can"), told("other", "can")
    found = names([plain(), plain(THERE)], one, other)
    assert set(found) == {"one", "other"} and set(found.values()) == {HERE, THERE}


def test_a_thing_that_is_told_by_nobody_takes_no_name_from_one_that_fits():
    """With room for one more name the right one was moved on to a chair's leg."""
    leg = plain(THERE, colour="brown", size_m=(0.05, 0.3, 0.115))
    other = told("pot", "plant pot", "green")
    assert names([plain(), leg], CAN, other) == {"lemonade": HERE}


def test_a_name_given_too_early_goes_to_the_one_that_fits_much_better():
    recogniser, tracks = Recogniser(Knowledge(CLASSES, SURE, SURE)), Tracks()
    recogniser.tell((CAN,), {})
    piece = plain(THERE, colour="orange", size_m=(0.066, 0.066, 0.1))
    for k in range(3):
        tracks.add([piece], 0.2 * k)
        before = recogniser.named(tracks.things)
    assert set(before) == {"lemonade"}
    for k in range(3, 9):
        tracks.add([plain()], 0.2 * k)
        found = recogniser.named(tracks.things)
    assert tuple(found["lemonade"].p_W.round(2).tolist()) == HERE


def test_cream_and_white_are_told_apart_by_how_warm_they_look():
    rice, sugar = told("rice", "box", "cream"), told("sugar", "box", "white")

    def seen(warmth: float) -> Measured:
        one = plain(colour="white", size_m=(0.065, 0.075, 0.1))
        return one._replace(seen=one.seen._replace(warmth=warmth))

    assert names([seen(0.10)], rice, sugar) == {"rice": HERE}
    assert names([seen(0.00)], rice, sugar) == {"sugar": HERE}
    assert names([seen(0.05)], rice, sugar, looks=8) == {}


def test_of_two_that_it_may_be_it_is_the_one_that_belongs_where_it_stands():
    paint, cup = told("red paint can", "paint can", "red"), told("red cup", "cup", "red")
    seen = plain(colour="red", size_m=(0.083, 0.083, 0.108))

    def name_on(place: str) -> set[str]:
        at = Place(id="p", name=place, X_WP=SE3((1.0, 0.0, seen.foot_m)), size_m=(0.4, 1.0))
        recogniser, tracks, found = Recogniser(Knowledge(CLASSES, SURE, SURE)), Tracks(), {}
        recogniser.tell((paint, cup), {}, (at,))
        for k in range(4):
            tracks.add([seen], 0.2 * k)
            found = recogniser.named(tracks.things)
        return set(found)

    assert name_on("sideboard") == set()
    assert name_on("paint rack") == {"red paint can"}


def may_be(things: list[Measured], *infos: ObjectInfo, looks: int = 4) -> list[tuple[str, ...]]:
    recogniser, tracks = Recogniser(Knowledge(CLASSES, SURE, SURE)), Tracks()
    recogniser.tell(infos, {})
    for k in range(looks):
        tracks.add(things, 0.2 * k)
        recogniser.named(tracks.things)
    return [recogniser.may_be[number] for number in sorted(recogniser.may_be)]


def test_what_has_no_name_may_be_each_told_thing_that_fits_and_is_not_elsewhere() -> None:
    jar, tin, mug = told("honey", "jar"), told("tea_tin", "tin"), told("mug", "mug", "blue")
    (either,) = may_be([plain()], jar, tin, mug)
    assert set(either) == {"honey", "tea_tin"}
    tall = plain(THERE, size_m=TALL)
    assert may_be([tall, plain(colour="blue")], BOTTLE, CAN) == [()]
    wide = plain(size_m=(0.09, 0.09, 0.14))
    assert may_be([tall, wide], BOTTLE, CAN) == [("lemonade",)]


def test_a_book_may_stand_on_its_edge_and_a_box_on_its_side() -> None:
    book = told("book", "book", "red")
    on_a_shelf = plain(colour="red", size_m=(0.08, 0.15, 0.19), roundness=-2.0)
    assert names([on_a_shelf], book) == {"book": HERE}
    assert names([plain(colour="red", size_m=(0.05, 0.05, 0.30), roundness=2.0)], book) == {}


def test_what_is_told_by_what_is_in_it_is_what_that_is_sold_in() -> None:
    """The honey and the jam had no names, as no kind that the namer knows is called so."""
    classes = Classes(
        ("jam_jar", "milk_carton", "juice_carton", "tea_cup", "", "nothing"),
        ("cans", "boxes", "boxes", "cups", "", "nothing"),
    )
    kinds = {
        word: kinds_of(word, f"{word}s", classes) for word in ("jam", "honey", "carton", "key")
    }
    assert kinds == {"jam": {0}, "honey": {0}, "carton": {1, 2}, "key": set()}
    assert usual("honey") == usual("jar") and usual("orange juice") == usual("carton")


def test_no_kind_is_surely_another_than_a_word_that_eyes_have_no_idea_of() -> None:
    sure = [measured(HERE, kind="mug", certain=0.99, colours=("blue",))]
    assert names(sure, told("thing", "gizmo", "blue")) == {"thing": HERE}
    assert names(sure, told("tin", "tin", "blue")) == {}
