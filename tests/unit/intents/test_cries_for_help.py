"""What is asked or refused, where a few words alone would have been acted on."""

import pytest

from intents.context import Context
from intents.goals import GoTo, Report
from intents.outcomes import Goals, Question, Refusal
from intents.parser import first_look
from intents.vocabulary import Vocabulary

HOUSE = Vocabulary.of(
    objects=["coat", "beer", "cactus", "phone"], places=["recliner", "table"], people=["Dev"]
)


def outcome(said: str):
    return first_look(said, HOUSE, Context()).outcome


@pytest.mark.parametrize("said", ["Help! I've fallen and I can't get up!", "help, I am hurt"])
def test_who_is_not_well_off_is_asked_whether_to_come(said):
    asked = outcome(said)
    assert isinstance(asked, Question)
    assert asked.goals == (GoTo(place="operator"),)


def test_help_alone_asks_what_it_can_do():
    found = outcome("help")
    assert isinstance(found, Goals)
    assert found.goals == (Report(topic="capabilities"),)


@pytest.mark.parametrize("said", ["Whose coat is on the recliner?", "whose beer is this"])
def test_nobody_told_it_whose_things_are(said):
    assert isinstance(outcome(said), Refusal)


@pytest.mark.parametrize("said", ["why is that cactus so pointy", "why is this beer too warm"])
def test_it_tells_only_why_it_did_something_itself(said):
    assert isinstance(outcome(said), Refusal)


@pytest.mark.parametrize("said", ["why did that fail", "why is that so slow", "why"])
def test_and_that_it_tells(said):
    found = outcome(said)
    assert isinstance(found, Goals)
    assert found.goals == (Report(topic="why"),)


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Half a metre back please, I need room", "walk half a metre back"),
        ("get us a beer, good man yourself", "get us a beer"),
        ("how many cacti are on the table", "count the cactus on the table"),
        ("loop five times: nod, wait one second", "repeat five times: nod, wait one second"),
    ],
)
def test_what_says_nothing_and_what_is_said_otherwise(said, plain):
    found, meant = outcome(said), outcome(plain)
    assert isinstance(found, Goals)
    assert isinstance(meant, Goals)
    assert found.goals == meant.goals
