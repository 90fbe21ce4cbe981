"""What is refused, what is asked, and that stopping comes first."""

import pytest
from workshop_words import WORKSHOP

from intents.goals import Stop, to_json
from intents.outcomes import Goals, Question, Refusal, to_record
from intents.parser import MAX_CHARACTERS, hear, is_stop, parse

REFUSED = {
    "": "heard nothing",
    "   \t\n": "heard nothing",
    "?!...": "heard nothing",
    "flurbl gnax wibble": "flurbl",
    "put it on the moon": "moon",
    "pick up the unicorn": "unicorn",
    "go to the swimming pool": "swimming pool",
    "bring the thermos to Zebedee": "zebedee",
    "put the orange under the sofa": "under",
    "what's the weather in Paris tomorrow": "",
    "play some jazz": "play",
    "book a flight to Rome": "book",
}
ASKED = {
    "go": "Where shall I go?",
    "pick up": "What shall I pick up?",
    "put the orange": "Where shall I put it?",
    "put the orange on the rack": "Which rack, the upper rack or the lower rack?",
    "follow him": "Who is meant?",
}


@pytest.mark.parametrize(("said", "named"), REFUSED.items())
def test_refusals_say_what_was_not_understood(said: str, named: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Refusal), outcome
    assert named in outcome.reason.lower()


def test_an_unknown_name_is_refused_with_the_nearest_one() -> None:
    outcome = parse("pick up the hovercraft", WORKSHOP)
    assert isinstance(outcome, Refusal)
    assert "nearest" in outcome.reason


@pytest.mark.parametrize(
    ("said", "names"),
    [
        ("put the mug on the bench", ["workbench"]),
        ("pick up the measuring tape", ["tape measure"]),
    ],
)
def test_an_unknown_name_like_a_known_one_is_asked_about(said: str, names: list[str]) -> None:
    outcome, context = hear(said, WORKSHOP)
    assert isinstance(outcome, Question), outcome
    assert "Do you mean" in outcome.question
    assert [choice.label for choice in outcome.choices] == names
    for answer in (names[0], "yes"):
        answered, _ = hear(answer, WORKSHOP, context=context)
        assert isinstance(answered, Goals)
        assert names[0] in to_json(answered.goals)


@pytest.mark.parametrize(
    ("said", "left_over", "rest"),
    [
        ("pick up the thermos and fold the laundry", "fold the laundry", "pick up the thermos"),
        ("pick up the thermos and juggle it", "juggle", "pick up the thermos"),
        ("bring me the thermos if it rains", "it rains", "bring the thermos to you"),
    ],
)
def test_the_part_that_is_understood_is_offered_and_done_after_a_yes(
    said: str, left_over: str, rest: str
) -> None:
    outcome, context = hear(said, WORKSHOP)
    assert isinstance(outcome, Question)
    assert outcome.kind == "confirmation"
    assert left_over in outcome.question
    assert f"Shall I just {rest}?" in outcome.question
    answered, _ = hear("yes", WORKSHOP, context=context)
    assert isinstance(answered, Goals)
    assert answered.goals == outcome.goals
    assert not isinstance(hear("no", WORKSHOP, context=context)[0], Goals)


@pytest.mark.parametrize(("said", "question"), ASKED.items())
def test_one_missing_thing_is_asked_for(said: str, question: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Question), outcome
    assert outcome.question == question


@pytest.mark.parametrize(
    "cry",
    ["stop", "STOP!", "Stop stop stop", "robot, stop now", "no no stop", "please stop", "halt",
     "freeze!", "emergency stop", "e-stop", "stop that at once, you will hit the sofa",
     "just stop", "hey robot stop"],
)  # fmt: skip
def test_stop_is_heard_before_anything_else(cry: str) -> None:
    assert is_stop(cry)
    outcome = parse(cry, WORKSHOP)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Stop(),)
    assert outcome.parser == "stop"


@pytest.mark.parametrize("said", ["pick up the stopper", "go to the bus stop", "freezer", ""])
def test_words_that_only_look_like_stop_do_not_stop(said: str) -> None:
    assert not is_stop(said)


def test_too_long_a_text_is_refused_without_being_read() -> None:
    outcome = parse("go to the sofa and " * (MAX_CHARACTERS // 10), WORKSHOP)
    assert isinstance(outcome, Refusal)
    assert "too long" in outcome.reason


def test_a_correction_is_remarked() -> None:
    outcome = parse("pick up the scewdriver", WORKSHOP)
    assert isinstance(outcome, Goals)
    assert outcome.reason == "I took “scewdriver” for “screwdriver”."


@pytest.mark.parametrize(
    ("said", "kind"), [("go to the sofa", "goals"), ("go", "question"), ("xyzzy", "refusal")]
)
def test_the_record_has_every_field_of_the_contract(said: str, kind: str) -> None:
    record = to_record(said, parse(said, WORKSHOP))
    assert list(record) == ["text", "outcome", "goals", "question", "reason", "parser", "ms"]
    assert record["outcome"] == kind
    assert bool(record["goals"]) == (kind == "goals")
