"""Which seen thing is which told one: by what is seen of it, and by nothing else."""

import pytest

from robot.messages import ObjectInfo, Shape
from robot.perception.sight.likeness import Knowledge
from robot.perception.sight.recognising import Recogniser
from robot.perception.sight.tracking import Tracks
from robot.perception.things.naming import Sure
from tests.fakes.things_in_view import CLASSES, SURE, measured


def told(id: str, category: str = "cup", color: str = "red") -> ObjectInfo:
    shape = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
    return ObjectInfo(id=id, name=id, category=category, color=color, shape=shape, mass_kg=0.2)


VOTED = Sure(0.9995, 0.9995)
NAMER = Knowledge(CLASSES, SURE, VOTED)
RED, BLUE = told("red_cup"), told("blue_cup", color="blue")
HERE, THERE = (1.0, 0.0, 0.76), (1.4, 0.3, 0.76)


def names(things: list, infos: tuple[ObjectInfo, ...], *, looks: int = 3) -> dict[str, tuple]:
    """Where what has a name is, after some looks at things that stay where they are."""
    recogniser, tracks = Recogniser(NAMER), Tracks()
    recogniser.tell(infos, {"cup": "cups", "box": "boxes"})
    found = {}
    for k in range(looks):
        tracks.add(things, 0.2 * k)
        found = recogniser.named(tracks.things)
    return {id: tuple(track.p_W.round(2).tolist()) for id, track in found.items()}


def test_by_its_colour():
    things = [measured(HERE, colours=("blue",)), measured(THERE, colours=("red", "brown"))]
    assert names(things, (RED, BLUE)) == {"blue_cup": HERE, "red_cup": THERE}


@pytest.mark.parametrize(
    "thing",
    [
        measured(HERE, colours=("green",)),
        measured(HERE, size_m=(0.4, 0.4, 0.42)),
        measured(HERE, kind="banana", certain=0.99, size_m=(0.04, 0.18, 0.04)),
        measured(HERE, kind="apple", certain=0.99),
    ],
    ids=["another colour", "far too large", "a banana", "surely an apple"],
)
def test_what_fits_no_name_gets_none(thing):
    assert names([thing], (RED, BLUE), looks=6) == {}


def test_a_plain_form_that_has_no_kind_may_be_any_of_its_size_and_colour():
    assert names([measured(HERE, kind="", certain=0.9)], (RED,)) == {"red_cup": HERE}


def test_a_thing_that_is_taken_for_another_kind_without_certainty_keeps_its_name():
    assert names([measured(HERE, kind="apple", certain=0.5)], (RED,)) == {"red_cup": HERE}


@pytest.mark.parametrize(("certain", "found"), [(0.98, True), (0.9999, False)])
def test_a_thing_of_a_kind_that_was_never_learnt_may_be_taken_for_another(certain, found):
    """A coffee tin was taken for a tea box in eight looks of eight: it was told all the same."""
    tin = told("coffee_tin", "coffee tin")
    assert SURE.kind < 0.98 < VOTED.kind
    assert bool(names([measured(HERE, kind="apple", certain=certain)], (tin,))) is found
    cup = names([measured(HERE, kind="apple", certain=certain)], (RED,), looks=6)
    assert cup == {}  # a kind that it knows well


def test_of_two_that_fit_as_well_neither_is_it():
    assert names([measured(HERE), measured(THERE)], (RED,), looks=6) == {}


def test_two_alike_that_were_both_told_are_one_each():
    other = told("other_red_cup")
    found = names([measured(HERE), measured(THERE)], (RED, other))
    assert set(found) == {"red_cup", "other_red_cup"}
    assert set(found.values()) == {HERE, THERE}


def test_one_look_is_enough_only_for_what_is_plain_to_see():
    plain = measured(HERE, kind="mug", certain=0.8)
    assert names([plain], (RED,), looks=1) == {"red_cup": HERE}
    dim = measured(HERE, kind="", certain=0.4, colours=("orange",))
    assert names([dim], (RED,), looks=1) == {}


def test_without_a_colour_the_kind_has_to_say_it():
    anything, mug = told("mug", "mug", ""), measured(HERE, kind="mug", certain=0.95)
    assert names([mug], (anything,)) == {"mug": HERE}
    assert names([measured(HERE, kind="cereal_box", certain=0.8)], (anything,)) == {}


def test_a_name_stays_with_what_is_carried_elsewhere_when_another_like_it_comes():
    recogniser, tracks = Recogniser(NAMER), Tracks()
    recogniser.tell((RED,), {})
    for k in range(3):
        tracks.add([measured(HERE)], 0.2 * k)
        first = recogniser.named(tracks.things)["red_cup"].number
    for k in range(3, 6):
        tracks.add([measured(HERE), measured(THERE)], 0.2 * k)
        assert recogniser.named(tracks.things)["red_cup"].number == first


def test_sizes_and_masses_that_were_told_change_nothing():
    heavy = ObjectInfo(
        id="red_cup", name="red cup", category="cup", color="red",
        shape=Shape(kind="box", size_m=(0.9, 0.9, 0.9)), mass_kg=40.0,
    )  # fmt: skip
    things = [measured(HERE), measured(THERE, colours=("blue",))]
    assert names(things, (heavy, BLUE)) == names(things, (RED, BLUE))


def test_a_name_that_loses_its_thing_to_another_was_a_mistake():
    recogniser, tracks = Recogniser(NAMER), Tracks()
    recogniser.tell((RED, BLUE), {"cup": "cups"})
    said = []
    for k in range(16):
        colour = "red" if k < 2 else "blue"  # the light has changed
        tracks.add([measured(HERE, colours=(colour,))], 0.2 * k)
        said.append((set(recogniser.named(tracks.things)), set(recogniser.mistaken)))
    assert said[1] == ({"red_cup"}, set())
    assert [mistaken for _, mistaken in said].count({"red_cup"}) == 1
    assert said[-1] == ({"blue_cup"}, set())


def test_a_name_that_nobody_else_has_is_no_mistake():
    recogniser, tracks = Recogniser(NAMER), Tracks()
    recogniser.tell((RED, BLUE), {"cup": "cups"})
    for k in range(3):
        tracks.add([measured(HERE)], 0.2 * k)
        recogniser.named(tracks.things)
    for k in range(3, 12):
        tracks.add([measured(HERE, kind="banana", certain=0.99, colours=("green",))], 0.2 * k)
        recogniser.named(tracks.things)
        assert not recogniser.mistaken


def test_a_name_is_taken_from_what_plainly_has_another_colour() -> None:
    recogniser, tracks = Recogniser(NAMER), Tracks()
    recogniser.tell((RED,), {"cup": "cups"})
    said = []
    for k in range(40):
        colour = "red" if k < 2 else "white"  # a glance from afar
        tracks.add([measured(HERE, kind="mug", certain=0.95, colours=(colour,))], 0.2 * k)
        said.append((set(recogniser.named(tracks.things)), dict(recogniser.mistaken)))
    assert said[1] == ({"red_cup"}, {})
    assert [mistaken for _, mistaken in said if mistaken] == [{"red_cup": "white"}]
    assert said[-1] == (set(), {})
