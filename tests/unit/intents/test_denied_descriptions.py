"""What a thing is not tells it apart: "the mug that is not green", "a mug other than the green"."""

import pytest

from intents.goals import ObjectQuery, each
from intents.grounding import Entity, Grounded, Unknown, describe, ground
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=[Thing(name="mug", color="green"), Thing(name="mug", color="white"), "flask", "tin"],
    places=["bench", "rack"],
    people=["Ida"],
)
GREEN, ON_BENCH = ObjectQuery(color="green"), ObjectQuery(at="bench")
MUGS = (
    Entity(id="g", name="mug", color="green", at="bench", p_WO=(0, 0, 1), size_m=(0.1, 0.1, 0.1)),
    Entity(id="w", name="mug", color="white", at="rack", p_WO=(3, 0, 1), size_m=(0.2, 0.2, 0.2)),
)


def described(text: str) -> list[ObjectQuery]:
    outcome = parse(text, HOME)
    assert isinstance(outcome, Goals), outcome
    found = [getattr(goal, "object", None) for goal in each(outcome.goals)]
    return [query for query in found if isinstance(query, ObjectQuery) and not query.held]


@pytest.mark.parametrize(
    ("text", "other"),
    [
        ("bring me the mug that is not green", GREEN),
        ("bring me the mug that's not green", GREEN),
        ("pick up a mug which isn't green", GREEN),
        ("bring me a mug other than the green one", GREEN),
        ("bring me a mug different from the green one", GREEN),
        ("bring me any mug but the green one", GREEN),
        ("bring me whichever mug is not green", GREEN),
        ("bring me the non-green mug", GREEN),
        ("look at the not green mug", GREEN),
        ("bring the mug that is not the green one to Ida", GREEN),
        ("put the mugs that aren't green on the rack", GREEN),
        ("how many mugs are not green?", GREEN),
        ("is there a mug that is not green?", GREEN),
        ("bring me the mug which isn't on the bench", ON_BENCH),
        ("bring me the mug not on the bench", ON_BENCH),
        ("put all the mugs that are not on the bench on the rack", ON_BENCH),
        ("pick up something that is not a mug", ObjectQuery(name="mug")),
        ("look at the mug that is not big", ObjectQuery(size="big")),
    ],
)
def test_what_it_is_not_is_excepted(text: str, other: ObjectQuery):
    (query,) = described(text)
    assert query.except_ == other


@pytest.mark.parametrize(
    "text",
    [
        "bring me one of the mugs, not the green one",
        "bring me a mug, but not the green one",
        "bring me a mug, anything but the green one",
        "bring me a mug, any but the green one",
    ],
)
def test_of_two_the_other_is_meant_and_nothing_asked(text: str):
    (query,) = described(text)
    assert query.color == "white"


@pytest.mark.parametrize(
    "text",
    [
        "bring me the mug that is neither green nor white",
        "bring me the mug that is not green or white",
        "bring me the flask that is not empty",
    ],
)
def test_what_no_goal_can_say_is_not_half_done(text: str):
    assert not isinstance(parse(text, HOME), Goals)


def test_where_it_is_to_be_put_is_no_description():
    outcome = parse("put the flask on the bench, not on the rack", HOME)
    assert isinstance(outcome, Goals)
    assert in_words(outcome.goals) == "put the flask on the bench"


@pytest.mark.parametrize(
    ("other", "meant"),
    [
        (GREEN, "w"),
        (ON_BENCH, "w"),
        (ObjectQuery(at="rack"), "g"),
        (ObjectQuery(name="mug", size="big"), "g"),
        (ObjectQuery(name="mug", superlative="smallest"), "w"),
    ],
)
def test_what_is_excepted_is_not_meant(other: ObjectQuery, meant: str):
    found = ground(ObjectQuery(name="mug", except_=other), MUGS)
    assert found == Grounded(meant, (meant,))


def test_what_nobody_has_seen_may_not_be_there():
    unseen = tuple(Entity(id=one.id, name="mug", color=one.color) for one in MUGS)
    found = ground(ObjectQuery(name="mug", count="all", except_=ON_BENCH), unseen)
    assert isinstance(found, Grounded)
    assert set(found.ids) == {"g", "w"}
    held = (Entity(id="g", name="mug", held=True),)
    assert isinstance(ground(ObjectQuery(name="mug", except_=ON_BENCH), held), Grounded)


def test_it_is_said_what_there_is_none_of():
    query = ObjectQuery(name="mug", color="green", except_=ON_BENCH)
    assert isinstance(ground(query, MUGS), Unknown)
    assert describe(query) == "green mug that is not at the bench"
    assert describe(ObjectQuery(name="mug", except_=GREEN)) == "mug that is not the green object"
