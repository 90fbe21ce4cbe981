"""The JSON form of goals."""

import msgspec
import pytest

from intents.goals import (
    Balance,
    Bring,
    Displacement,
    ForEach,
    GoTo,
    If,
    ObjectQuery,
    Person,
    Pick,
    Place,
    Present,
    Relation,
    Repeat,
    Stop,
    Tell,
    Wait,
    from_json,
    to_json,
)

CUP = ObjectQuery(name="cup", color="red")
EVERY_SHAPE = (
    Pick(object=CUP),
    Place(object=ObjectQuery(held=True), in_="box"),
    Bring(object=CUP, to="desk"),
    Bring(object=ObjectQuery(category="drink", at="bar"), to=Person(who="operator")),
    GoTo(by=Displacement(forward_m=2.0)),
    Tell(person=Person(gender="male"), property="posture", to=Person(name="Ada")),
    Tell(object=ObjectQuery(superlative="largest", at="desk")),
    Tell(person=Person(at="desk"), to=Person(who="operator")),
    Tell(person=Person(name="Ada")),
    Pick(object=ObjectQuery(relation=Relation(how="behind", of=CUP))),
    Balance(mode="one_leg", side="left", duration_s=3.0),
    Repeat(times=2, goals=(Tell(object=CUP), Stop())),
    If(
        condition=Present(object=CUP, negated=True),
        then=(Wait(duration_s=1.0),),
        else_=(ForEach(object=CUP, goals=(Pick(object=ObjectQuery(held=True)),)),),
    ),
)


@pytest.mark.parametrize("goal", EVERY_SHAPE, ids=lambda g: type(g).__name__)
def test_reading_what_was_written_gives_the_same_goal(goal: object) -> None:
    assert from_json(to_json((goal,))) == (goal,)  # type: ignore[arg-type]


def test_unsaid_slots_are_absent() -> None:
    assert to_json((Pick(object=CUP),)) == (
        '[{"goal":"pick","object":{"name":"cup","color":"red"}}]'
    )


def test_reserved_words_are_spelled_plainly() -> None:
    assert to_json((Place(object=CUP, in_="box"),)).endswith('"in":"box"}]')
    assert '"else":[{"goal":"stop"}]' in to_json((If(condition=Present(), else_=(Stop(),)),))


@pytest.mark.parametrize("kind", ["object", "person"])
def test_what_is_told_of_stands_in_one_slot(kind: str) -> None:
    goal = Tell(object=CUP) if kind == "object" else Tell(person=Person(gender="male"))
    text = to_json((Repeat(times=2, goals=(goal,)),))
    assert '"of":{' in text
    assert f'"{kind}"' not in text


@pytest.mark.parametrize(
    "bad",
    [
        '[{"goal":"pick","obj":{}}]',
        '[{"goal":"fly"}]',
        '[{"goal":"pick"}]',
        '[{"goal":"pick","object":{"name":"cup","weight":3}}]',
        '[{"goal":"repeat","times":"often","goals":[]}]',
        '{"goal":"stop"}',
        '[{"goal":"if","condition":{"is":"tuesday"}}]',
    ],
)
def test_anything_outside_the_closed_set_is_refused(bad: str) -> None:
    with pytest.raises(msgspec.ValidationError):
        from_json(bad)
