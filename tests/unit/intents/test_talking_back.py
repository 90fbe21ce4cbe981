"""What is said about the conversation: what was done, undoing it, the rest of it, a bit more."""

import pytest
from msgspec.structs import replace

from intents.dialogue import Dialogue
from intents.goals import Bring, GoTo, ObjectQuery, Person, Place, Pose2
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal, Reply, Turn
from intents.relations import Viewpoint
from intents.state import RobotState
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=[Thing(name="jar", color=color) for color in ("green", "white", "brown")] + ["torch"],
    places=["bench", "upper shelf", "lower shelf"],
    rooms=["hall"],
    people=["Ada"],
)


def entity(number: int, name: str, color: str, at: str) -> Entity:
    return Entity(id=f"e{number}", name=name, color=color, at=at, p_WO=(number, 0.0, 0.8))


THINGS = (
    entity(1, "jar", "green", "bench"),
    entity(2, "jar", "white", "bench"),
    entity(3, "jar", "brown", "lower shelf"),
    entity(4, "torch", "", "bench"),
)
STILL = RobotState(entities=THINGS, view=Viewpoint(x_m=1.0, y_m=2.0, yaw_rad=0.5))
BUSY = replace(STILL, doing="fetch the torch", step="walk", waiting=("wave", "go to the hall"))


def moved(number: int, at: str, *, held: bool = False) -> RobotState:
    things = tuple(
        replace(e, at=at, held=held) if e.id == f"e{number}" else e for e in STILL.entities
    )
    return RobotState(entities=things, last="I have done “it”.", did="it")


def turns(*said: str | tuple[str, RobotState]) -> list[Turn]:
    dialogue, state, heard = Dialogue(HOME), STILL, list[Turn]()
    for one in said:
        text, state = one if isinstance(one, tuple) else (one, state)
        heard.append(dialogue.hear(text, state))
    return heard


def words(turn: Turn) -> str:
    if isinstance(turn, Reply):
        return turn.text
    if isinstance(turn, Question):
        return turn.question
    return in_words(turn.goals) if isinstance(turn, Goals) else turn.reason


@pytest.mark.parametrize(
    "text",
    ["what did you just do?", "What have you done so far", "what was the last thing you did"],
)
def test_it_says_what_it_did(text: str) -> None:
    after = RobotState(last="I could not do “wave”: it is tired.", did="wave")
    assert "I could not do “wave”" in words(turns((text, after))[0])
    assert "not done anything" in words(turns(text)[0])


@pytest.mark.parametrize("text", ["which one first?", "what do you do first", "in which order?"])
def test_it_says_what_comes_first(text: str) -> None:
    said = words(turns((text, BUSY))[0])
    assert said == "First “fetch the torch” (walk), then “wave”, then “go to the hall”."


def test_it_says_what_comes_next() -> None:
    said = words(turns(("what comes next?", BUSY))[0])
    assert said == "After “fetch the torch” comes “wave”, then “go to the hall”."


@pytest.mark.parametrize("text", ["why did you do that?", "why are you going there?"])
def test_it_says_why(text: str) -> None:
    assert words(turns((text, BUSY))[0]) == "Because you said “fetch the torch”."
    over = replace(STILL, last="I have done “wave”.", did="wave")
    assert words(turns((text, over))[0]) == "Because you said “wave”."


def test_a_thing_is_put_back_where_it_stood() -> None:
    back = turns("put the green jar on the upper shelf", ("undo that", moved(1, "upper shelf")))[1]
    assert isinstance(back, Goals)
    assert back.goals == (Place(object=ObjectQuery(name="jar", color="green"), on="bench"),)
    assert back.elliptic
    back = turns("pick up the torch", ("put it back where it was", moved(4, "", held=True)))[1]
    assert isinstance(back, Goals)
    assert back.goals == (Place(object=ObjectQuery(name="torch"), on="bench"),)


@pytest.mark.parametrize("text", ["undo that", "go back to where you were"])
def test_it_walks_back(text: str) -> None:
    back = turns("go to the hall", (text, moved(1, "bench")))[1]
    assert isinstance(back, Goals)
    assert back.goals == (GoTo(pose=Pose2(x_m=1.0, y_m=2.0, yaw_rad=0.5)),)


@pytest.mark.parametrize(
    ("done", "after", "why"),
    [
        ("say hello", STILL, "cannot be undone"),
        ("bring me the torch", moved(4, ""), "gave the torch away"),
        ("put the torch on the bench", STILL, "Nothing of that is left"),
    ],
)
def test_what_cannot_be_undone_is_told(done: str, after: RobotState, why: str) -> None:
    back = turns(done, ("undo it", after))[1]
    assert isinstance(back, Reply)
    assert why in back.text


def test_nothing_is_undone_twice_or_before_anything() -> None:
    assert "nothing that I could undo" in words(turns("undo that")[0])


def test_the_rest_is_the_others_of_its_kind_that_are_not_there_yet() -> None:
    rest = turns("put the green jar on the lower shelf", "and the rest?")[1]
    assert isinstance(rest, Goals)
    assert [goal.object.color for goal in rest.goals if isinstance(goal, Place)] == ["white"]
    rest = turns("bring me the green jar", "now the others too")[1]
    assert isinstance(rest, Goals)
    assert all(isinstance(g, Bring) and g.to == Person(who="operator") for g in rest.goals)
    assert len(rest.goals) == 2
    assert "no other torch" in words(turns("bring me the torch", "and the rest?")[1])


@pytest.mark.parametrize(
    ("said", "more", "part"),
    [
        ("walk forward 2 metres", "a bit more", "walk 0.5 m forward"),
        ("walk back 20 cm", "a little further", "walk 0.1 m back"),
        ("turn left 40 degrees", "a bit more", "turn 10° left"),
        ("wait 20 seconds", "a bit longer", "wait 5 s"),
        ("walk forward 2 metres", "further", "walk 2 m forward"),
    ],
)
def test_a_bit_more_is_a_part_of_the_last_amount(said: str, more: str, part: str) -> None:
    assert words(turns(said, more)[1]) == part


@pytest.mark.parametrize("answers", [("the upper one", "white"), ("upper", "the white one")])
def test_two_things_that_are_open_are_asked_one_after_the_other(answers: tuple[str, str]) -> None:
    first, second, done = turns("put the jar on the shelf", *answers)
    assert isinstance(first, Question)
    assert isinstance(second, Question)
    assert first.question != second.question
    assert words(done) == "put the white jar at the bench on the upper shelf"


def test_a_question_about_another_is_answered_while_one_is_open() -> None:
    said = turns("pick up the jar", "where is the green one?", "and the brown one?", "brown")
    assert [words(one) for one in said[1:3]] == [
        "The green jar is at the bench.",
        "The brown jar is at the lower shelf.",
    ]
    assert words(said[3]).startswith("pick up the brown jar")


def test_that_is_what_was_spoken_of_last() -> None:
    said = turns("where is the green jar?", "and the white one?", "bring me that")
    assert words(said[2]) == "bring the white jar to you"


@pytest.mark.parametrize(
    "text",
    ["no, the white one", "actually the white one", "the white one instead",
     "I meant the white one", "make it the white one", "no the white jar",
     "bring me the white jar instead"],
)  # fmt: skip
def test_a_correction_takes_the_place_of_what_was_asked(text: str) -> None:
    said = turns("bring me the green jar", text)[1]
    assert isinstance(said, Goals)
    assert words(said).startswith("bring the white jar")
    assert said.instead


def test_the_place_is_corrected_too() -> None:
    said = turns("put the torch on the upper shelf", "no, the lower one")[1]
    assert words(said) == "put the torch on the lower shelf"


@pytest.mark.parametrize(
    "text", ["bring me the torch", "wait 5 seconds", "and the white one", "wave"]
)
def test_what_is_asked_besides_is_no_correction(text: str) -> None:
    said = turns("bring me the green jar", text)[1]
    assert isinstance(said, Goals)
    assert not said.instead
    assert not isinstance(said, Refusal)
