"""Several sentences, one after the other."""

from intents.dialogue import Context
from intents.goals import GoTo, ObjectQuery, Pick, Place, to_json
from intents.grounding import Entity
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.parser import hear
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
