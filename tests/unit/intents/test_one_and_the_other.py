"""Which of two, which side, which place: settled by what was said, or asked with the choices."""

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals, Question, Refusal
from intents.parser import hear, parse
from intents.vocabulary import Thing, Vocabulary

WORDS = Vocabulary.of(
    objects=[
        Thing(name="jar", color="green", category="jar"),
        Thing(name="jar", color="white", category="jar"),
        Thing(name="parcel", size="big"),
        Thing(name="parcel", size="small"),
        Thing(name="hammer"),
    ],
    places=["bench", "ledge", "crate"],
    people=["Emil"],
    categories={"jar": "jars"},
)


def goals(said: str) -> list[dict[str, object]]:
    outcome = parse(said, WORDS)
    assert isinstance(outcome, Goals), outcome
    return to_builtins(outcome.goals)


def asked(said: str) -> Question:
    outcome = parse(said, WORDS)
    assert isinstance(outcome, Question), outcome
    return outcome


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "put the green jar on the bench and the other one on the ledge",
            "put the green jar on the bench and the white jar on the ledge",
        ),
        (
            "put the white jar on the bench and the other on the ledge",
            "put the white jar on the bench and the green jar on the ledge",
        ),
        (
            "pick up the big parcel, then pick up the other parcel",
            "pick up the big parcel, then pick up the small parcel",
        ),
    ],
)
def test_the_other_is_the_one_of_two_that_was_not_spoken_of(said: str, plainly: str) -> None:
    assert goals(said) == goals(plainly)


def test_one_and_the_other_are_two() -> None:
    one, other = goals("put one jar on the bench and the other on the ledge")
    assert one["object"] != other["object"]
    assert (one["on"], other["on"]) == ("bench", "ledge")


@pytest.mark.parametrize("said", ["take the other jar", "take the shiny jar"])
def test_which_of_them_is_asked_with_every_choice(said: str) -> None:
    question = asked(said)
    assert [choice.label for choice in question.choices] == ["green jar", "white jar"]
    assert all(choice.label in question.question for choice in question.choices)
    _, context = hear(said, WORDS)
    chosen, _ = hear("the white one", WORDS, context=context)
    assert isinstance(chosen, Goals)
    assert to_builtins(chosen.goals)[0]["object"] == {"name": "jar", "color": "white"}


@pytest.mark.parametrize(
    ("said", "answer", "plainly"),
    [
        ("put the hammer where the green jar is", "the ledge", "put the hammer on the ledge"),
        ("put it back where it was", "on the bench", "put it back on the bench"),
        ("bring the hammer to where you found it", "the bench", "bring the hammer to the bench"),
        ("step aside", "left", "step to the left"),
        ("get out of my way, please", "the right", "sidestep right"),
    ],
)
def test_what_has_no_name_is_asked_and_the_answer_fits(
    said: str, answer: str, plainly: str
) -> None:
    outcome, context = hear(said, WORDS)
    assert isinstance(outcome, Question), outcome
    answered, _ = hear(answer, WORDS, context=context)
    assert isinstance(answered, Goals), answered
    assert to_builtins(answered.goals) == goals(plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("go to where the green jar is", "find the green jar"),
        ("go where Emil is", "go to Emil"),
        ("look over your shoulder", "look back"),
        ("wait until I call you", "wait"),
        ("wait by the bench until further notice", "go to the bench and wait"),
        ("stay there till we are back, then come here", "wait, then come here"),
        ("when you are at the bench, take the hammer", "go to the bench and take the hammer"),
        (
            "go to the bench and put the hammer there",
            "go to the bench, put the hammer on the bench",
        ),
        ("I would like the hammer to be on the bench", "put the hammer on the bench"),
        ("if you cannot see the hammer, wave", "if there is no hammer, wave"),
        ("where has the hammer gone?", "where is the hammer?"),
        (
            "put the hammer on the bench and the green jar too",
            "put the hammer on the bench and the green jar on the bench",
        ),
        (
            "grab the hammer, then the green jar, and put both on the ledge",
            "grab the hammer and the green jar, and put them on the ledge",
        ),
        (
            "the hammer goes on the bench and the green jar in the crate",
            "put the hammer on the bench and the green jar in the crate",
        ),
        ("take the whiet jar", "take the white jar"),
        ("puth the hammer onn the bench", "put the hammer on the bench"),
    ],
)
def test_these_say_what_is_said_plainly(said: str, plainly: str) -> None:
    assert goals(said) == goals(plainly)


@pytest.mark.parametrize(
    ("before", "said", "plainly"),
    [
        ("take the green jar", "no, the white one", "take the white jar"),
        ("take the green jar", "not that one, the other one", "take the white jar"),
        ("go to the bench", "I mean the ledge", "go to the ledge"),
        ("put the hammer on the bench", "no, on the ledge", "put the hammer on the ledge"),
        ("put the hammer on the ledge", "the green jar too", "put the green jar on the ledge"),
        ("take the green jar", "take a different jar", "take the white jar"),
    ],
)
def test_what_is_said_next_changes_what_was_said_last(before: str, said: str, plainly: str) -> None:
    _, context = hear(before, WORDS)
    outcome, _ = hear(said, WORDS, context=context)
    assert isinstance(outcome, Goals), outcome
    found = to_builtins(outcome.goals)[0]
    if isinstance(found.get("object"), dict):
        found["object"] = {k: v for k, v in found["object"].items() if k != "count"}
    assert [found] == goals(plainly)


@pytest.mark.parametrize("said", ["no hammer there?", "no", "no, thanks"])
def test_a_no_alone_changes_nothing(said: str) -> None:
    _, context = hear("take the green jar", WORDS)
    assert not isinstance(hear(said, WORDS, context=context)[0], Goals)


@pytest.mark.parametrize("said", ["put the jars on different ledges", "go to the other bench"])
def test_a_place_told_apart_by_nothing_is_asked_for(said: str) -> None:
    asked(said)


def test_to_tidy_is_refused_with_what_can_be_done_instead() -> None:
    outcome = parse("tidy the bench", WORDS)
    assert isinstance(outcome, Refusal)
    assert "what is to go where" in outcome.reason


@pytest.mark.parametrize("said", ["swap the two jars", "exchange the hammer and the green jar"])
def test_to_swap_is_refused_with_what_can_be_done_instead(said: str) -> None:
    outcome = parse(said, WORDS)
    assert isinstance(outcome, Refusal)
    assert "where to put each" in outcome.reason
