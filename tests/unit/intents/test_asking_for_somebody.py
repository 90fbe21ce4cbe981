"""What somebody is to be asked for whoever speaks, and who is told the answer."""

import pytest

from intents.goals import Ask, Count, Goal, Person, Say, to_builtins
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

CLINIC = Vocabulary.of(
    objects=[Thing(name="coffee tin", category="tin"), Thing(name="mug", category="mug")],
    places=["reception desk"],
    rooms=["hall"],
    people=["Ines", "Dr Haas"],
    categories={"tin": "tins", "mug": "mugs"},
)
INES, VET, ME = Person(name="Ines"), Person(name="Dr Haas"), Person(who="operator")


def goals_of(said: str) -> tuple[Goal, ...]:
    outcome = parse(said, CLINIC)
    assert isinstance(outcome, Goals), outcome
    return outcome.goals


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ("ask Ines if the results have arrived", "if the results have arrived"),
        ("Please ask Ines whether she needs anything.", "whether she needs anything"),
        ("could you ask Ines what she wants for lunch?", "what she wants for lunch"),
        ("ask Ines when the shop opens", "when the shop opens"),
        ("ask Ines if she wants tea or coffee", "if she wants tea or coffee"),
        ("ask Ines how many mugs she needs", "how many mugs she needs"),
    ],
)
def test_the_words_of_the_question_stay(said, what):
    assert goals_of(said) == (Ask(person=INES, what=what),)


@pytest.mark.parametrize(
    ("said", "to"),
    [
        ("ask Ines if the results are there and tell Dr Haas what she says", VET),
        ("ask Ines if the results are there, then tell Dr Haas the answer", VET),
        ("ask Ines if the results are there. Tell Dr Haas what she said.", VET),
        ("ask Ines if the results are there and let Dr Haas know what she says", VET),
        ("ask Ines if the results are there and tell me what she says", ME),
        ("ask Ines if the results are there, come back and tell me her answer", ME),
    ],
)
def test_who_is_told_the_answer_is_asked_for_once(said, to):
    assert goals_of(said) == (Ask(person=INES, what="if the results are there", to=to),)


def test_what_comes_after_the_question_is_done_after_it():
    asked, then = goals_of("ask Ines if she is well and then count the mugs")
    assert asked == Ask(person=INES, what="if she is well")
    assert isinstance(then, Count)


@pytest.mark.parametrize(
    "said", ["ask Ines", "ask me if I am well", "ask Ines why", "ask if the results are there"]
)
def test_without_somebody_and_a_question_nobody_is_asked(said):
    outcome = parse(said, CLINIC)
    asked = isinstance(outcome, Goals) and any(isinstance(one, Ask) for one in outcome.goals)
    assert not asked


def test_an_answer_is_not_told_where_nobody_was_asked():
    outcome = parse("tell Dr Haas what she says", CLINIC)
    assert not isinstance(outcome, Goals) or isinstance(outcome.goals[0], Say)


def test_it_is_read_back_with_the_question_and_who_is_told():
    words = in_words(goals_of("ask Ines if she is well and tell Dr Haas the answer"))
    assert words == "ask Ines “if she is well” and tell Dr Haas the answer"


def test_it_is_plain_data():
    (goal,) = to_builtins(goals_of("ask Ines if she is well and tell Dr Haas the answer"))
    assert goal == {
        "goal": "ask", "person": {"name": "Ines"}, "what": "if she is well",
        "to": {"name": "Dr Haas"},
    }  # fmt: skip


def test_a_message_may_name_a_thing_by_a_part_of_its_name():
    """It was asked back: “coffee” is the tin, and no goal carried the tin."""
    assert goals_of("tell Ines that Dr Haas wants coffee") == (
        Say(what="Dr Haas wants coffee", to=INES),
    )
