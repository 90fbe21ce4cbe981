"""Small things that people say by the way, and that change nothing of what is meant."""

import pytest

from intents.context import Context
from intents.goals import to_builtins
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal
from intents.parser import hear, parse
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="cup", color="blue"), Thing(name="bottle")],
    places=["table", "shelf"], people=["Anna"],
)  # fmt: skip
THERE = Context(
    entities=(
        Entity(id="c1", name="cup", color="red"),
        Entity(id="c2", name="cup", color="blue"),
        Entity(id="b", name="bottle"),
    )
)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("move the bottle over to the shelf for me", "move the bottle to the shelf"),
        ("put the bottle on the shelf for us", "put the bottle on the shelf"),
        ("take the bottle to the table for me please", "take the bottle to the table"),
        ("wave, if it is not too much to ask", "wave"),
        ("grab me that red cup", "grab me the red cup"),
        ("is the bottle still on the table?", "is the bottle on the table?"),
        ("tidy up by putting the bottle on the shelf", "put the bottle on the shelf"),
        ("make sure that the bottle is on the shelf", "put the bottle on the shelf"),
        (
            "clear everything off the table onto the shelf",
            "put everything from the table on the shelf",
        ),
        ("empty the table onto the shelf", "put everything from the table on the shelf"),
        (
            "go back and forth between the table and the shelf twice",
            "patrol between the table and the shelf two times",
        ),
        ("turn a quarter to the right", "turn 90 degrees to the right"),
        ("come closer", "come here"),
        ("is the shelf empty?", "is anything on the shelf?"),
        ("which things are red?", "what is red?"),
        ("bring the bottle over to where Anna is", "bring the bottle to Anna"),
        ("take three big steps forward", "take three steps forward"),
        ("face the other way", "turn around"),
        ("pick up the cup. the blue one", "pick up the blue cup"),
        ("do a 180", "turn around"),
        ("can you see Anna?", "do you see Anna?"),
        ("could you see Anna to the table?", "guide Anna to the table"),
        ("quit following me", "cancel that"),
        ("meet me at the table", "go to the table"),
        ("come and join us", "come here"),
        ("wait for me at the table", "go to the table and wait"),
        ("find the bottle it is somewhere on the shelf", "find the bottle. It is on the shelf"),
        ("put the bottle on the table in front of the shelf", "put the bottle on the table"),
        (
            "Anna is waiting at the table, bring her the bottle",
            "bring Anna at the table the bottle",
        ),
        ("stay close to Anna", "follow Anna"),
        ("follow close behind Anna", "follow Anna"),
        ("pop over to the table", "go to the table"),
        ("go to the table and come straight back", "go to the table and come back"),
        ("visit the table and the shelf", "visit the table, then visit the shelf"),
        ("look at the table and the shelf", "look at the table, then look at the shelf"),
        ("how many cups stand on the table?", "how many cups are on the table?"),
        ("have you seen the bottle?", "do you see the bottle?"),
        ("do you know where the bottle went?", "where is the bottle?"),
        ("wave & nod", "wave and nod"),
        ("right 90 degrees", "turn right 90 degrees"),
        ("backward 20 cm", "walk backward 20 cm"),
        ("show me a bow", "bow"),
        ("give us a bow", "bow"),
        ("give Anna a high five", "high five Anna"),
        ("put the bottle on the table, wait, no, on the shelf", "put the bottle on the shelf"),
        ("put the bottle on the table and leave it there", "put the bottle on the table"),
        ("get closer to the table", "go to the table"),
        ("go too the table", "go to the table"),
        ("what is lying on the table?", "what is on the table?"),
        ("can you see a bottle on the table?", "is there a bottle on the table?"),
        ("I need the number of cups on the table", "tell me the number of cups on the table"),
        ("do you happen to know where Anna is?", "where is Anna?"),
        ("walk along with Anna", "follow Anna"),
        ("what is the colour of the bottle? Tell Anna", "tell Anna the colour of the bottle"),
        ("take the bottle, no the cup", "take the cup"),
        ("go to the table... oh no, the shelf", "go to the shelf"),
        ("never mind, forget that", "never mind"),
        ("is Anna sitting or lying down?", "what is Anna's posture?"),
        ("tell me if Anna is sitting", "tell me the posture of Anna"),
        (
            "is the person at the table a man or a woman?",
            "what is the gender of the person at the table?",
        ),
        ("what is the man at the table called?", "what is the name of the man at the table?"),
        ("tell me what Anna is doing", "tell me the posture of Anna"),
        ("bring me whatever bottle is on the table", "bring me any bottle on the table"),
        ("is Anna here?", "find Anna"),
        ("is the bottle around?", "find the bottle"),
        ("answer whatever question Anna has", "answer the question of Anna"),
        ("can you do three bows for us?", "do three bows"),
        ("check the table for the bottle", "look for the bottle on the table"),
        ("have a look for the bottle on the shelf", "look for the bottle on the shelf"),
        ("supply Anna with the bottle", "bring Anna the bottle"),
        ("see that Anna gets the bottle", "bring Anna the bottle"),
        ("make sure the bottle ends up on the shelf", "put the bottle on the shelf"),
        ("stash the bottle on the shelf", "put the bottle on the shelf"),
        ("give me the total number of cups on the table", "count the cups on the table"),
        ("what number of cups are on the table?", "how many cups are on the table?"),
        ("give Anna a warm welcome", "greet Anna"),
        ("talk to Anna, tell her a joke", "find Anna and tell her a joke"),
        ("close the shelf door", "close the shelf"),
        ("stand by the table", "go to the table"),
        ("pick up a cup, the red one", "pick up the red cup"),
        ("red cup to table", "put the red cup on the table"),
        ("pik up teh redd cup", "pick up the red cup"),
        ("pickup the bottle and putit on teh shelf", "pick up the bottle and put it on the shelf"),
    ],
)
def test_they_change_nothing(said: str, plainly: str) -> None:
    one, other = parse(said, HOME), parse(plainly, HOME)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert one.goals == other.goals


@pytest.mark.parametrize(
    "said",
    [
        "pick up the bottle with your left hand",
        "use your left hand to pick up the bottle",
        "with your right hand take the bottle",
        "take the bottle with both hands",
        "use both hands to pick up the bottle",
    ],
)
def test_a_hand_that_is_named_is_asked_about_and_not_passed_over(said: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Question), outcome
    assert "I choose the hand myself" in outcome.question
    assert [goal["goal"] for goal in to_builtins(outcome.goals)] == ["pick"]
    assert isinstance(parse("bring me the bottle and raise your left hand", HOME), Goals)


@pytest.mark.parametrize(
    ("said", "answer", "goals"),
    [
        ("clear the table", "on the shelf", ["for_each"]),
        ("patrol between the table and the shelf", "three times", ["repeat"]),
    ],
)
def test_what_is_missing_is_asked_for(said: str, answer: str, goals: list[str]) -> None:
    outcome, context = hear(said, HOME)
    assert isinstance(outcome, Question), outcome
    outcome, _ = hear(answer, HOME, context=context)
    assert isinstance(outcome, Goals), outcome
    assert [goal["goal"] for goal in to_builtins(outcome.goals)] == goals


@pytest.mark.parametrize("said", ["move the table to the left"])
def test_what_cannot_be_done_is_not_done_by_half(said: str) -> None:
    assert not isinstance(parse(said, HOME), Goals)


def test_between_two_places_is_no_place() -> None:
    assert isinstance(parse("go between the table and the shelf", HOME), Refusal)


@pytest.mark.parametrize(("said", "still"), [("get the bottle for me", "bring")])
def test_for_me_without_a_destination_is_one(said: str, still: str) -> None:
    outcome = parse(said, HOME)
    assert isinstance(outcome, Goals)
    assert [goal["goal"] for goal in to_builtins(outcome.goals)] == [still]


def test_several_are_meant_by_a_plural_where_there_are_several() -> None:
    outcome, _ = hear("put the cups on the shelf", HOME, context=THERE)
    assert isinstance(outcome, Goals)
    goal = to_builtins(outcome.goals)[0]
    assert (goal["goal"], goal["object"]) == ("for_each", {"name": "cup"})


@pytest.mark.parametrize("said", ["put the cup on the shelf", "bring me the cup"])
def test_and_one_by_a_singular(said: str) -> None:
    outcome, _ = hear(said, HOME, context=THERE)
    assert isinstance(outcome, Question)


@pytest.mark.parametrize(
    ("said", "choices", "answer"),
    [
        ("bring me the mug", ["red cup", "blue cup"], "the red one"),
        ("bring me the blue coffee mug", ["cup"], "yes"),
    ],
)
def test_what_is_akin_is_asked_about(said: str, choices: list[str], answer: str) -> None:
    outcome, context = hear(said, HOME)
    assert isinstance(outcome, Question)
    assert [choice.label for choice in outcome.choices] == choices
    agreed, _ = hear(answer, HOME, context=context)
    assert isinstance(agreed, Goals)


@pytest.mark.parametrize(
    "words", ["I'll be late", "we don't know", "it's Emil's birthday", "I'm at the table"]
)
def test_words_to_be_said_stay_as_they_were_said(words: str) -> None:
    outcome = parse(f"tell Anna {words}", HOME)
    assert isinstance(outcome, Goals), outcome
    assert to_builtins(outcome.goals)[0]["what"] == words


def test_two_listeners_are_told_the_same() -> None:
    home = Vocabulary.of(people=["Anna", "Emil"])
    outcome = parse("tell Anna and Emil that lunch is ready", home)
    assert isinstance(outcome, Goals), outcome
    told = to_builtins(outcome.goals)
    assert [goal["to"] for goal in told] == [{"name": "Anna"}, {"name": "Emil"}]
    assert {goal["what"] for goal in told} == {"lunch is ready"}
