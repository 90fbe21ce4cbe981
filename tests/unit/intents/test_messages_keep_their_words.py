"""What is to be told is told with every word: how, when and whether it is certain."""

import pytest

from intents.goals import Bring, Greet, Person, Say
from intents.outcomes import Goals
from tests.unit.intents.hotel_words import heard

PASSED_ON = [
    ("tell Olga that the lift is working now", "the lift is working now", "Olga"),
    ("let Ravi know that we landed safely", "we landed safely", "Ravi"),
    ("tell Hans to breathe slowly, please", "breathe slowly", "Hans"),
    ("inform Lucia that the chef is out at the moment", "the chef is out at the moment", "Lucia"),
    ("tell Olga that I think it is hers", "I think it is hers", "Olga"),
    ("say to Ravi that the taxi is perhaps late", "the taxi is perhaps late", "Ravi"),
]


@pytest.mark.parametrize(("said", "message", "to"), PASSED_ON, ids=[row[0] for row in PASSED_ON])
def test_a_message_keeps_how_and_when(said: str, message: str, to: str):
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Say(what=message, to=Person(name=to)),)


def test_how_the_robot_is_to_do_it_is_no_part_of_the_message():
    outcome = heard("say hello to Olga now")
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Greet(person=Person(name="Olga")),)
    outcome = heard("tell Hans that tea is ready and then quickly bring me a scarf")
    assert isinstance(outcome, Goals)
    told, brought = outcome.goals
    assert told == Say(what="tea is ready", to=Person(name="Hans"))
    assert isinstance(brought, Bring)
