"""No word that carries something is left out in silence."""

import pytest

from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.vocabulary import Vocabulary

HOME = Vocabulary.of(
    objects=["cup", "bottle", "box", "plate", "book"],
    places=["table", "upper shelf", "lower shelf", "sink"],
    rooms=["kitchen", "hall"],
    people=["Ada"],
)


@pytest.mark.parametrize(
    ("said", "left_out"),
    [
        ("walk backwards to the table", "backwards"),
        ("bring me the second largest plate", "second"),
        ("put the bottle upside down on the table", "upside"),
        ("go to the table and kneel down", "kneel"),
        ("take the box to the hall tomorrow", "tomorrow"),
        ("put the cup on the table overnight", "overnight"),
        ("put the box on the table with the label facing me", "facing"),
        ("bring me several bottles", "several"),
    ],
)
def test_what_no_goal_carries_is_asked_about(said: str, left_out: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Question), outcome
    assert left_out in outcome.question


@pytest.mark.parametrize("material", ["wooden", "ceramic", "chipped", "clean"])
def test_what_only_describes_a_thing_known_by_name_is_remarked(material: str) -> None:
    outcome = parse(f"bring me the {material} plate", HOME)
    assert isinstance(outcome, Goals), outcome
    assert outcome.reason is not None and material in outcome.reason


@pytest.mark.parametrize(
    "said",
    [
        "bring me the two largest plates",
        "put all the books on the lower shelf",
        "wait a minute and a half",
        "walk 20 cm backwards",
        "take the cup from the table in the kitchen to Ada",
        "turn a quarter to the right, then wave with your left hand",
    ],
)
def test_what_comes_back_is_not_remarked_on(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Goals), outcome
    assert outcome.reason is None
