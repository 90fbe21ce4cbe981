"""No word that carries something is left out in silence."""

import pytest

from intents.goals import ObjectQuery, Pick, to_builtins
from intents.grounding import Entity, Grounded, ground
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


@pytest.mark.parametrize(
    ("said", "left"),
    [
        ("put all books except the red one in the sink", {"color": "red"}),
        ("bring me every book but the small one", {"size": "small"}),
        ("bring me all books, but not the one on the table", {"at": "table"}),
        ("bring me anything apart from the plate", {"name": "plate"}),
    ],
)
def test_an_exception_comes_back(said: str, left: dict[str, str]) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Goals), outcome
    goal = to_builtins(outcome.goals)[0]
    assert goal["object"]["except"] == left


def test_an_exception_is_kept_when_things_are_known() -> None:
    cups = tuple(Entity(id=f"{c}-cup", name="cup", color=c) for c in ("red", "blue", "green"))
    query = ObjectQuery(name="cup", count="all", except_=ObjectQuery(color="blue"))
    found = ground(query, cups)
    assert isinstance(found, Grounded)
    assert found.ids == ("red-cup", "green-cup")


@pytest.mark.parametrize("said", ["bring me the cup or the book", "take the bottle or the box"])
def test_of_two_things_to_choose_from_not_both_are_taken(said: str) -> None:
    assert isinstance(parse(said, HOME), Question)


@pytest.mark.parametrize(
    "said", ["put the plates in the sink", "take the plates and put them in the sink"]
)
def test_a_plural_is_of_all(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Goals), outcome
    assert "all" in str(outcome.goals) or "ForEach" in str(outcome.goals)


def test_more_things_than_hands_are_fetched_one_by_one() -> None:
    outcome = parse("take the cup, the box and the book, and put them on the table", HOME)
    assert isinstance(outcome, Goals), outcome
    assert [goal["goal"] for goal in to_builtins(outcome.goals)] == ["place"] * 3


@pytest.mark.parametrize(
    "said", ["leave it", "leave the book alone", "leave the cup where it is", "leave Ada alone"]
)
def test_what_is_to_be_left_is_left(said: str) -> None:
    assert not isinstance(parse(said, HOME), Goals)


def test_what_is_taken_back_is_not_done() -> None:
    outcome = parse("take the cup, no, leave it. Get the box instead.", HOME)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Pick(object=ObjectQuery(name="box")),)
