"""Several sentences, one after the other."""

import pytest
from msgspec.structs import replace

from intents.dialogue import Context, Dialogue
from intents.goals import Bring, Find, Give, Goal, GoTo, ObjectQuery, Pick, Place, to_json
from intents.grounding import Entity
from intents.outcomes import Goals, Outcome, Question, Refusal, Reply
from intents.parser import hear
from intents.state import RobotState
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="jar", color="green"), Thing(name="jar", color="white"), "torch"],
    places=["bench", "upper shelf", "lower shelf"],
    people=["Ada"],
)
WORLD = (
    Entity(id="j1", name="jar", color="green", at="bench"),
    Entity(id="j2", name="jar", color="white", at="bench"),
    Entity(id="t1", name="torch", at="bench"),
)


def converse(*texts: str, entities: tuple[Entity, ...] = WORLD) -> list[Outcome]:
    context = Context(entities=entities)
    outcomes: list[Outcome] = []
    for text in texts:
        outcome, context = hear(text, HOME, context=context)
        outcomes.append(outcome)
    return outcomes


def test_two_that_fit_are_asked_about_and_an_adjective_answers() -> None:
    asked, answered = converse("pick up the jar", "white")
    assert isinstance(asked, Question)
    assert asked.question == "Which jar, the green one or the white one?"
    assert isinstance(answered, Goals)
    assert isinstance(answered.goals[0], Pick)
    assert answered.goals[0].object.color == "white"


def test_an_ordinal_answers() -> None:
    answered = converse("take the jar and put it on the lower shelf", "the first one")[1]
    assert isinstance(answered, Goals)
    assert [type(g) for g in answered.goals] == [Pick, Place]
    assert all(g.object.color == "green" for g in answered.goals)  # type: ignore[union-attr]


def test_which_place_can_be_answered_with_the_word_that_differs() -> None:
    asked, answered = converse("put the torch on the shelf", "the upper one")
    assert isinstance(asked, Question)
    assert [c.label for c in asked.choices] == ["upper shelf", "lower shelf"]
    assert isinstance(answered, Goals)
    assert answered.goals == (Place(object=ObjectQuery(name="torch"), on="upper shelf"),)


def test_a_missing_place_can_be_supplied() -> None:
    asked, answered = converse("put the torch", "on the bench")
    assert isinstance(asked, Question)
    assert isinstance(answered, Goals)
    assert to_json(answered.goals) == ('[{"goal":"place","object":{"name":"torch"},"on":"bench"}]')


def test_a_new_command_instead_of_an_answer_is_a_new_command() -> None:
    answered = converse("pick up the jar", "pick up the torch")[1]
    assert isinstance(answered, Goals)
    assert answered.goals == (Pick(object=ObjectQuery(name="torch")),)


def test_it_is_what_was_spoken_of_before() -> None:
    last = converse("pick up the torch", "put it on the bench")[1]
    assert isinstance(last, Goals)
    assert last.goals == (Place(object=ObjectQuery(name="torch"), on="bench"),)


def test_there_is_the_last_place_and_nothing_else() -> None:
    reached = converse("go to the bench", "wave", "go there")[2]
    assert isinstance(reached, Goals)
    assert reached.goals == (GoTo(place="bench"),)
    asked = converse("switch on the lamp", "go there")[1]
    assert isinstance(asked, Question)


def test_do_it_again_repeats_the_last_goals() -> None:
    first, again = converse("wave to Ada", "do that again")
    assert isinstance(first, Goals)
    assert isinstance(again, Goals)
    assert again.goals == first.goals


def test_what_is_not_there_is_refused_with_what_is() -> None:
    refused = converse("pick up the red jar")[0]
    assert isinstance(refused, Refusal)
    assert "no red jar" in refused.reason
    assert "green jar" in refused.reason


def test_who_asks_for_any_one_is_not_asked_which() -> None:
    for said in ("pick up a jar", "pick up any jar", "take one of the jars"):
        assert isinstance(converse(said)[0], Goals)


def test_without_a_world_nothing_is_ambiguous() -> None:
    outcome = converse("pick up the jar", entities=())[0]
    assert isinstance(outcome, Goals)


@pytest.mark.parametrize("between", ["where are you", "what are you holding?", "how are you?"])
@pytest.mark.parametrize("doing", ["bring me the green jar", ""])
def test_a_question_in_between_is_not_what_is_corrected(between: str, doing: str) -> None:
    talk = Dialogue(HOME)
    talk.hear("bring me the green jar", RobotState(entities=WORLD))
    talk.hear(between, RobotState(entities=WORLD, doing=doing))
    state = RobotState(entities=WORLD, doing=doing)
    assert talk.besides("no, the white one", state) == "no, the white one"
    turn = talk.hear("no, the white one", state)
    assert isinstance(turn, Goals)
    assert turn.instead
    assert [goal.object.color for goal in turn.goals if isinstance(goal, Bring)] == ["white"]


@pytest.mark.parametrize(("doing", "kind"), [("bring me the green jar", Bring), ("", Find)])
def test_a_question_of_things_is_corrected_only_while_nothing_is_done(
    doing: str, kind: type[Goal]
) -> None:
    talk = Dialogue(HOME)
    talk.hear("bring me the green jar", RobotState(entities=WORLD))
    talk.hear("where is the green jar", RobotState(entities=WORLD, doing=doing))
    turn = talk.hear("no, the white one", RobotState(entities=WORLD, doing=doing))
    assert isinstance(turn, Goals)
    assert [type(goal) for goal in turn.goals] == [kind]


@pytest.mark.parametrize(
    "asked", ["why did you stop", "why have you stopped?", "how come you stopped"]
)
def test_why_it_stands_is_told_before_how_an_older_job_ended(asked: str) -> None:
    state = RobotState(
        doing="go to the bench", holds="I halted at it.", last="I have done “nod”.", mode="paused"
    )
    turn = Dialogue(HOME).hear(asked, state)
    assert isinstance(turn, Reply)
    assert turn.text == "I halted at it."


FULL = (
    Entity(id="j1", name="jar", color="green", held=True),
    Entity(id="j2", name="jar", color="white", held=True),
    Entity(id="t1", name="torch", at="bench"),
)


@pytest.mark.parametrize("order", ["put it on the lower shelf", "drop it", "give it to Ada"])
@pytest.mark.parametrize("answer", ["the white one", "white", "the white jar"])
def test_it_is_not_what_full_hands_cannot_take(order: str, answer: str) -> None:
    talk, state = Dialogue(HOME), RobotState(entities=FULL)
    talk.hear("pick up the torch", state)
    talk.not_to_be_had()
    asked = talk.hear(order, state)
    assert isinstance(asked, Question)
    assert asked.question == "Which one, the green jar or the white jar?"
    turn = talk.hear(answer, state)
    assert isinstance(turn, Goals)
    [goal] = turn.goals
    assert isinstance(goal, Give | Place)
    assert goal.object.color == "white"


def test_it_is_what_was_named_since() -> None:
    talk, state = Dialogue(HOME), RobotState(entities=FULL)
    talk.hear("pick up the torch", state)
    talk.not_to_be_had()
    talk.hear("look at the green jar", state)
    turn = talk.hear("drop it", state)
    assert isinstance(turn, Goals)


def test_things_are_put_back_also_after_something_else_was_done() -> None:
    talk, moved = Dialogue(HOME), replace(WORLD[2], at="lower shelf")
    talk.hear("put the torch on the lower shelf", RobotState(entities=WORLD))
    state = RobotState(entities=(*WORLD[:2], moved))
    talk.hear("nod", state)
    turn = talk.hear("put it back", state)
    assert isinstance(turn, Goals)
    assert turn.goals == (Place(object=ObjectQuery(name="torch"), on="bench"),)
