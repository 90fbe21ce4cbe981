"""Conversations: open questions, confirmations, answers from state."""

import doctest

import pytest
from msgspec.structs import replace

from intents import dialogue as dialogue_module
from intents.dialogue import Dialogue
from intents.goals import (
    Cancel,
    Find,
    Gesture,
    GoTo,
    LookAt,
    ObjectQuery,
    Place,
    Report,
    Stop,
)
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal, Reply, Turn
from intents.state import RobotState
from intents.vocabulary import Thing, Vocabulary

WORDS = Vocabulary.of(
    objects=[Thing(name="jar", color="green"), Thing(name="jar", color="white"), "torch", "knife"],
    places=["bench", "rubbish bin", "stove", "upper shelf", "lower shelf"],
    rooms=["cellar"],
    people=["Ada"],
)
GREEN = Entity(id="j1", name="jar", color="green", at="bench", room="cellar")
WHITE = Entity(id="j2", name="jar", color="white", held=True)
TORCH = Entity(id="t1", name="torch", mass_kg=0.3, size_m=(0.03, 0.04, 0.2))
KNIFE = Entity(id="k1", name="knife")
STATE = RobotState(
    entities=(GREEN, WHITE, TORCH, KNIFE),
    seen=("j1",),
    place="bench",
    room="cellar",
    last="I stopped because you said so.",
)


def talk(*said: str, state: RobotState = STATE) -> list[Turn]:
    conversation = Dialogue(WORDS)
    return [conversation.hear(text, state) for text in said]


def test_the_example_of_the_docstring_holds() -> None:
    assert doctest.testmod(dialogue_module).failed == 0


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("what are you holding?", "white jar"),
        ("what do you see?", "green jar"),
        ("where are you?", "bench in the cellar"),
        ("why did you stop?", "because you said so"),
        ("what are you doing?", "doing nothing"),
        ("how are you?", "well"),
        ("what can you do?", "pick things up"),
        ("where is the green jar?", "at the bench in the cellar"),
        ("where is the white jar?", "in my hand"),
        ("where are the jars?", "in my hand"),
        ("do you see the green jar?", "at the bench"),
        ("what is on the bench?", "The green jar."),
        ("what is on the stove?", "I have seen nothing at the stove."),
        ("which jars are on the stove?", "I have seen no jar at the stove."),
        ("which things are white?", "The white jar."),
        ("what colour is the green jar?", "The green jar is green."),
        ("how heavy is the torch?", "The torch weighs 300 g."),
        ("how big is the torch?", "The torch is 3 by 4 by 20 cm."),
        ("is the green jar on the stove?", "No: the green jar is at the bench in the cellar."),
        ("thank you!", "You are welcome."),
        ("good night, robot", "Goodbye."),
    ],
)
def test_questions_are_answered_from_state(asked: str, told: str) -> None:
    (reply,) = talk(asked)
    assert isinstance(reply, Reply), reply
    assert told in reply.text


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("where are you and what do you hold?", ("bench in the cellar", "white jar")),
        ("what are you holding and where are you?", ("white jar", "bench in the cellar")),
        ("what can you do, and what are you carrying?", ("pick things up", "white jar")),
        ("how are you and then what are you doing", ("well", "doing nothing")),
        ("where are you? where is the green jar?", ("cellar", "The green jar is at the bench")),
        ("where is the green jar and what do you see", ("The green jar is at", "I see")),
        ("what colour is the green jar and where are you", ("jar is green", "cellar")),
        ("tell me where you are and what you hold", ("cellar", "white jar")),
    ],
)
def test_two_questions_in_one_line_are_both_answered(asked: str, told: tuple[str, str]) -> None:
    (reply,) = talk(asked)
    assert isinstance(reply, Reply), reply
    first, second = (reply.text.index(part) for part in told)
    assert first < second


def test_of_two_questions_the_one_that_can_be_answered_is_and_the_other_is_asked_about() -> None:
    asked, going = talk("what do you hold and where is the torch?", "yes")
    assert isinstance(asked, Question)
    assert "white jar" in asked.question
    assert "I do not know where the torch is. Shall I look for it?" in asked.question
    assert isinstance(going, Goals)
    assert going.goals == (Find(object=ObjectQuery(name="torch")),)


def test_a_question_beside_a_wish_is_a_step_of_it() -> None:
    (turn,) = talk("what are you holding and go to the stove")
    assert isinstance(turn, Goals)
    assert turn.goals == (Report(topic="holding"), GoTo(place="stove"))


def test_to_find_something_is_a_wish_also_beside_a_question() -> None:
    (turn,) = talk("find the green jar and tell me where you are")
    assert isinstance(turn, Goals)
    assert [type(goal) for goal in turn.goals] == [Find, Report]


@pytest.mark.parametrize("asked", ["what can you see and do", "where are you and blorb"])
def test_half_a_question_is_not_passed_over(asked: str) -> None:
    (turn,) = talk(asked)
    assert isinstance(turn, Question)
    assert "I do not understand" in turn.question


def test_the_state_decides_the_answer() -> None:
    busy = RobotState(doing="bring the jar", step="walk", problems=("the left knee is hot",),
                      battery=0.4, waiting=("wave",))  # fmt: skip
    doing, health, holding = talk("what are you doing?", "how are you?", "what do you hold?",
                                  state=busy)  # fmt: skip
    assert isinstance(doing, Reply)
    assert "bring the jar" in doing.text
    assert "walk" in doing.text
    assert isinstance(health, Reply)
    assert "left knee" in health.text
    assert "40%" in health.text
    assert isinstance(holding, Reply)
    assert "not holding anything" in holding.text


def test_skills_that_are_not_there_are_not_offered() -> None:
    (reply,) = talk("what can you do?", state=RobotState(skills=frozenset({"gesture"})))
    assert isinstance(reply, Reply)
    assert "gestures" in reply.text
    assert "pick" not in reply.text


def test_it_is_offered_to_look_for_what_is_not_known() -> None:
    asked, agreed = talk("where is the torch?", "yes please")
    assert isinstance(asked, Question)
    assert asked.kind == "confirmation"
    assert "Shall I look for it?" in asked.question
    assert isinstance(agreed, Goals)
    assert agreed.goals == (Find(object=ObjectQuery(name="torch")),)


@pytest.mark.parametrize("yes", ["yes", "Yes, do it", "go ahead", "ok", "sure", "yes please"])
def test_what_cannot_be_undone_is_read_back_and_done_after_a_yes(yes: str) -> None:
    asked, done = talk("put the torch in the rubbish bin", yes)
    assert isinstance(asked, Question)
    assert "put the torch into the rubbish bin" in asked.question
    assert [c.label for c in asked.choices] == ["yes", "no"]
    assert isinstance(done, Goals)
    assert done.goals == (Place(object=ObjectQuery(name="torch"), in_="rubbish bin"),)


@pytest.mark.parametrize("no", ["no", "no, don't", "never mind", "better not", "No!"])
def test_after_a_no_nothing_is_done(no: str) -> None:
    _, reply = talk("switch on the stove", no)
    assert isinstance(reply, Reply)


@pytest.mark.parametrize(
    "risky",
    ["switch on the stove", "throw the torch away", "give Ada the knife", "walk 8 metres forward",
     "wave twenty times", "put everything in the rubbish bin", "open the front door"],
)  # fmt: skip
def test_risky_goals_are_confirmed_and_can_be_let_through(risky: str) -> None:
    (asked,) = talk(risky)
    assert isinstance(asked, Question), asked
    assert asked.kind == "confirmation"
    assert isinstance(Dialogue(WORDS, confirm=False).hear(risky, STATE), Goals)


@pytest.mark.parametrize("plain", ["look at the torch", "wave", "walk two metres forward"])
def test_what_is_not_risky_is_not_confirmed(plain: str) -> None:
    (done,) = talk(plain)
    assert isinstance(done, Goals)


def test_a_yes_without_a_question_is_no_command() -> None:
    (turn,) = talk("yes")
    assert isinstance(turn, Refusal)


def test_stop_is_heard_whatever_is_open_and_closes_the_question() -> None:
    asked, stopped, yes = talk("switch on the stove", "no stop!", "yes")
    assert isinstance(asked, Question)
    assert isinstance(stopped, Goals)
    assert stopped.goals == (Stop(),)
    assert isinstance(yes, Refusal)


def test_an_answer_that_is_none_is_asked_again_but_not_for_ever() -> None:
    asked, again, third, last = talk("look at the jar", "mumble", "grumble", "rumble")
    assert isinstance(asked, Question)
    assert isinstance(again, Question)
    assert again.question.startswith("I did not get that. Which jar")
    assert isinstance(third, Question)
    assert third.question == again.question
    assert isinstance(last, Refusal)


def test_the_answer_may_come_after_asking_again() -> None:
    turn = talk("look at the jar", "mumble", "the white one")[-1]
    assert isinstance(turn, Goals)
    assert isinstance(turn.goals[0], LookAt)
    assert turn.goals[0].object is not None
    assert turn.goals[0].object.color == "white"


def test_a_new_command_replaces_the_question() -> None:
    conversation = Dialogue(WORDS)
    conversation.hear("look at the jar", STATE)
    waved = conversation.hear("wave", STATE)
    assert isinstance(waved, Goals)
    assert isinstance(waved.goals[0], Gesture)
    assert conversation.question is None


def test_it_and_there_carry_over_turns_and_over_confirmations() -> None:
    turns = talk("where is the green jar?", "look at it", "throw it away", "no", "look at it")
    for turn in (turns[1], turns[4]):
        assert isinstance(turn, Goals)
        assert isinstance(turn.goals[0], LookAt)
        assert turn.goals[0].object is not None
        assert turn.goals[0].object.color == "green"


def test_cancel_as_an_answer_cancels_what_is_being_done() -> None:
    busy = RobotState(entities=STATE.entities, doing="bring the jar")
    _, cancelled = talk("look at the jar", "cancel", state=busy)
    assert isinstance(cancelled, Goals)
    assert cancelled.goals == (Cancel(),)


@pytest.mark.parametrize("said", ["what is on the bench?", "how heavy is the knife?"])
def test_what_is_not_known_is_for_the_robot_to_find_out(said: str) -> None:
    (outcome,) = talk(said, state=RobotState(entities=(KNIFE,)))
    assert isinstance(outcome, Goals)


@pytest.mark.parametrize("doing", ["", "bring the green jar to the stove"])
@pytest.mark.parametrize(
    "caution",
    [
        "and dont drop it",
        "and don't drop it",
        "and don’t spill it",
        "never break it",
        "without spilling",
    ],
)
def test_a_caution_is_never_taken_for_a_wish_to_give_up(doing, caution) -> None:
    state = replace(STATE, doing=doing)
    (turn,) = talk(f"the green one, please, {caution}", state=state)
    offered = turn.goals if isinstance(turn, Goals | Question) else ()
    assert not any(isinstance(goal, Cancel | Stop) for goal in offered), turn


@pytest.mark.parametrize("said", ["cancel that, and dont drop it", "stop, and dont drop it"])
def test_who_ends_it_with_a_caution_ends_it(said) -> None:
    state = replace(STATE, doing="bring the green jar to the stove")
    (turn,) = talk(said, state=state)
    assert isinstance(turn, Goals) and turn.goals in ((Cancel(),), (Stop(),)), turn
