"""People are found by their names and by whatever else they are called."""

import pytest
from msgspec.structs import replace

from executive.meaning.knowledge import Knowledge
from robot.messages import PersonInfo, Place
from robot.se3 import SE3
from tests.fakes.worlds import world_map


def somebody(person_id: str, *synonyms: str) -> PersonInfo:
    return PersonInfo(id=person_id, name=person_id.title(), X_WO=SE3(), synonyms=synonyms)


@pytest.fixture
def knowledge() -> Knowledge:
    ann, bob = somebody("ann", "the vet", "vet"), somebody("bob", "skipper", "Ann")
    return Knowledge(replace(world_map(), people=(bob, ann)))


@pytest.mark.parametrize(
    ("said", "meant"), [("Vet", "ann"), ("the vet", "ann"), ("skipper", "bob"), ("Ann", "ann")]
)
def test_a_person_goes_by_a_name_before_what_else_somebody_is_called(
    knowledge: Knowledge, said: str, meant: str
):
    found = knowledge.person(said)
    assert found is not None
    assert found.id == meant


def test_the_parser_knows_all_that_people_are_called(knowledge: Knowledge):
    told = {person.name: person.synonyms for person in knowledge.vocabulary().people}
    assert told == {"Ann": ("the vet", "vet"), "Bob": ("skipper", "Ann")}


def room(name: str, x_m: float, y_m: float, width_m: float, depth_m: float) -> Place:
    return Place(
        id=name, name=name, X_WP=SE3((x_m, y_m, 0.0)), size_m=(width_m, depth_m), room=name,
        floor=True,
    )  # fmt: skip


def test_rooms_beside_one_another_have_a_side_in_common_that_a_door_fits_in():
    hall, bath = room("hall", 0.0, 0.0, 1.5, 6.0), room("bath", 2.3, 2.0, 3.0, 2.0)
    study, cellar = room("study", 2.3, -4.0, 3.0, 2.4), room("cellar", 6.0, 0.0, 3.0, 6.0)
    spot = replace(room("mat", 0.0, 0.0, 0.6, 0.6), room="hall")
    home = Knowledge(replace(world_map(), places=(hall, spot, bath, study, cellar)))
    assert home.rooms_beside("hall") == (bath,)  # the study's corner alone is beside it
    assert home.rooms_beside("bath") == (hall,)  # two metres lie between it and the cellar
    assert home.rooms_beside("mat") == home.rooms_beside("") == ()
