"""People are found by their names and by whatever else they are called."""

import pytest
from msgspec.structs import replace

from executive.meaning.knowledge import Knowledge
from robot.messages import PersonInfo
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
