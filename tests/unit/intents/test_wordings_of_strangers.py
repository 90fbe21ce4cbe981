"""Dialects, learners, deadlines, things told of: the command is read, and nothing else is done."""

import pytest

from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=["cup", "bottle", "box", "spoon", "towel"],
    places=["table", "shelf", "sink", "door"],
    rooms=["kitchen", "cellar"],
    people=["Leo", "Ada"],
)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("gonnae gie us the towel oot the sink", "bring me the towel from the sink"),
        ("chuck us the towel", "bring me the towel"),
        ("where my towel at", "where is my towel"),
        ("might I trouble you for the towel", "bring me the towel"),
        ("you know what, bring me the towel after all", "bring me the towel"),
        ("can't talk, bring me the towel", "bring me the towel"),
        ("I spilled it so bring me the towel", "bring me the towel"),
        ("as quick as you can: towel to the sink", "put the towel on the sink"),
        ("make turn to left side", "turn left"),
        ("bring to me the cup what is on the table", "bring me the cup on the table"),
        ("bring me the cup Ada left on the table", "bring me the cup on the table"),
        ("hand Ada the, um, what's it called, the, er, spoon", "hand Ada the spoon"),
        ("give Ada the thingy, the spoon", "give Ada the spoon"),
        ("Ada wants a cup, give her 1", "bring Ada the cup"),
        ("put the cup in the sink before Leo wakes up", "put the cup in the sink"),
        ("before Leo wakes up, put the cup in the sink", "put the cup in the sink"),
        ("follow Ada until she reaches the cellar", "follow Ada to the cellar"),
        ("pop down the cellar and see if Leo's about", "go to the cellar and find Leo"),
        ("try the cellar for the box", "find the box in the cellar"),
        ("say hi to Ada from me", "say hi to Ada"),
        ("take a cup, no wait, two cups, from the shelf", "take two cups from the shelf"),
        (
            "Leo rang about the cup that's on the shelf, so run it to him",
            "bring Leo the cup on the shelf",
        ),
        (
            "first the cup in the sink, then the spoon",
            "put the cup in the sink, the spoon in the sink",
        ),
        ("while Ada is here, wave", "if Ada is here, wave"),
        ("\"Mum says yes!\" - that was Leo, bring him the cup", "bring Leo the cup"),
    ],
)  # fmt: skip
def test_it_is_read_as_what_is_said_plainly(said: str, plainly: str) -> None:
    assert _done(parse(said, HOME)) == _done(parse(plainly, HOME))


@pytest.mark.parametrize(
    "said",
    [
        "put the cup on the shelf until I say stop",
        "wave until Ada comes",
        "after Ada leaves, close the door",
        "if Ada is thirsty, bring her the cup",
        "put the cup on the shelf without letting go of it",
        "exit",
    ],
)
def test_what_cannot_be_told_or_kept_is_asked_about(said: str) -> None:
    assert isinstance(parse(said, HOME), Question)


@pytest.mark.parametrize(
    "said",
    [
        "put the cup on the cup",
        "bring the box to the box",
        "put the box on the bottle",
        "put the cup in the spoon",
        "somebody left a hammer on the table, bring it to Ada",
        "there's a kite in the kitchen, could you take it to Leo?",
    ],
)
def test_what_cannot_be_is_refused(said: str) -> None:
    assert isinstance(parse(said, HOME), Refusal)


def _done(outcome: Outcome) -> str:
    assert isinstance(outcome, Goals), outcome
    return in_words(outcome.goals)
