"""What is said beside a command neither keeps it from being read nor is acted on."""

import pytest

from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Vocabulary

HOME = Vocabulary.of(
    objects=["cup", "bottle", "box", "blanket", "phone", "keys"],
    places=["table", "shelf", "sink", "stove"],
    rooms=["kitchen", "cellar"],
    people=["Leo", "Ada"],
)
BEHIND = [
    "my back is killing me",
    "it is fragile",
    "because it's late",
    "his battery is nearly dead",
    "he's in the shower",
    "I can't find anything",
    "the guests are coming soon",
    "mind the step",
    "and don't spill anything",
    "would you, love?",
    "if you'd be so kind",
    "thanks a million",
    "there's a good chap",
    "quick as you can",
]
BEFORE = [
    "My back is killing me,",
    "We're having guests tonight so",
    "Since the light is broken,",
    "Careful, the floor is wet.",
    "When you've got a sec,",
    "If it's not too much bother,",
    "I was wondering whether you might possibly be able to",
    "Be a good lad and",
    "Might I trouble you to",
    "What I'd like you to do is",
    "Sweetheart,",
    "don't just stand there,",
]


@pytest.mark.parametrize("aside", BEHIND)
def test_what_is_said_behind_a_command_changes_nothing(aside: str) -> None:
    assert _goals(f"bring me the bottle, {aside}") == _goals("bring me the bottle")


@pytest.mark.parametrize("aside", BEFORE)
def test_what_is_said_before_a_command_changes_nothing(aside: str) -> None:
    assert _goals(f"{aside} bring me the bottle") == _goals("bring me the bottle")


@pytest.mark.parametrize(
    "said",
    [
        "he said put it down",
        "Leo said: put the cup on the table",
        "my mother always says shut the door",
        "Ada asked me to take the bottle to the cellar",
        "I took the cup to the kitchen, put it in the sink and went home",
        "we moved the box to the cellar yesterday",
        "nobody told me to bring the blanket",
        "the cup was moved to the shelf",
    ],
)
def test_what_is_only_told_is_not_acted_on(said: str) -> None:
    assert isinstance(parse(said, HOME), Refusal)


@pytest.mark.parametrize(
    "said",
    ["Leo, bring me the cup", "hey Ada, could you close the box?", "bring me the cup, Leo"],
)
def test_what_is_said_to_somebody_else_is_theirs_to_do(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Refusal)
    assert "said to" in outcome.reason


def test_what_is_not_to_be_touched_is_heard() -> None:
    outcome = parse("don't touch my phone, just bring me the keys", HOME)
    assert isinstance(outcome, Goals)
    assert outcome.goals == _goals("bring me the keys")
    assert outcome.reason is not None and "phone" in outcome.reason


@pytest.mark.parametrize(
    "said",
    [
        "stay out of the cellar and bring me the keys",
        "keep away from the stove and bring me the bottle",
        "don't touch the cup and, bring me the cup",
    ],
)
def test_what_cannot_be_promised_is_asked_about(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Question), outcome
    assert "promise" in outcome.question


def _goals(said: str) -> object:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Goals), outcome
    return outcome.goals


@pytest.mark.parametrize(
    ("said", "offered"),
    [
        ("I'm cold", "blanket"),
        ("Leo is thirsty", "bottle"),
        ("we are out of bottles", "bottle"),
        ("it's dark in here", "switch on"),
    ],
)
def test_what_would_help_is_offered(said: str, offered: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Question), outcome
    assert outcome.kind == "confirmation"
    assert offered in outcome.question


@pytest.mark.parametrize("words", ["thank you", "no, thanks", "that is all", "okay, love"])
def test_what_is_to_be_said_is_said_whole(words: str) -> None:
    outcome = parse(f"say {words}", HOME)
    assert isinstance(outcome, Goals), outcome
    assert words.split(",", maxsplit=1)[0].rsplit(maxsplit=1)[-1] in str(outcome.goals)


@pytest.mark.parametrize(
    "how",
    [
        "but not with your left hand",
        "but don't use your right arm",
        "but do not go near Ada",
        "but don't walk past the stove",
        "without turning round",
        "but not on the lower one",
    ],
)
def test_how_it_is_not_to_be_done_is_asked_about(how: str) -> None:
    outcome = parse(f"put the bottle on the shelf {how}", HOME)
    assert isinstance(outcome, Question), outcome
    assert "promise" in outcome.question


@pytest.mark.parametrize("contrast", ["not on the table", "and don't spill it", "don't wake Ada"])
def test_what_is_not_done_anyway_is_no_question(contrast: str) -> None:
    assert _goals(f"put the bottle on the shelf, {contrast}") == _goals(
        "put the bottle on the shelf"
    )
