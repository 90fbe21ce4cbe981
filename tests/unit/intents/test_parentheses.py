"""What is set off from a sentence and cannot change what is asked is passed over, and said so."""

import pytest

from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary

FARM = Vocabulary.of(
    objects=["kettle", "ladle", "jar", "jam", "lantern", "hammer", "basket"],
    places=["stove", "dresser", "hook", "gate", "bench", "trough"],
    rooms=["barn", "pantry", "parlour"],
    people=["Ines", "Odd", "Tove"],
)


def goals_of(said: str) -> object:
    outcome = parse(said, FARM)
    assert isinstance(outcome, Goals), outcome
    return outcome.goals


@pytest.mark.parametrize(
    ("said", "passed", "plainly"),
    [
        (
            "Tove has been up since dawn, the poor soul, so bring her the jam",
            "the poor soul",
            "bring Tove the jam",
        ),
        (
            "Odd is hungry, the silly old goat, take him the jam",
            "the silly old goat",
            "bring Odd the jam",
        ),
        ("Ines, heaven help her, wants the ladle", "heaven help her", "bring Ines the ladle"),
        ("Odd needs the jam, bless his heart", "bless his heart", "bring Odd the jam"),
        (
            "Good gracious, hang the lantern on the hook",
            "Good gracious",
            "hang the lantern on the hook",
        ),
        ("Brrr, what a wind! Close the gate", "what a wind", "close the gate"),
        ("How many jars are on the bench? Be frank.", "Be frank", "how many jars are on the bench"),
        (
            "My feet, they are like two blocks of ice. Bring me the kettle",
            "My feet",
            "bring me the kettle",
        ),
        (
            "put the kettle, the battered old thing, on the stove",
            "the battered old thing",
            "put the kettle on the stove",
        ),
        ("bring me the jam, hand on heart", "hand on heart", "bring me the jam"),
        (
            "take the hammer to Tove, quick as lightning",
            "quick as lightning",
            "take Tove the hammer",
        ),
        ("bring me the basket, for pity's sake", "for pity's sake", "bring me the basket"),
        ("bring me the jam, you rusty old chap", "you rusty old chap", "bring me the jam"),
    ],
)
def test_it_is_passed_over_and_that_is_said(said: str, passed: str, plainly: str) -> None:
    outcome = parse(said, FARM)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == goals_of(plainly)
    assert outcome.reason is not None
    assert f"“{passed}”" in outcome.reason


@pytest.mark.parametrize(
    "said",
    [
        "bring me the jam, juggle",  # orders, with verbs that no robot here knows
        "bring me the jam, fold the sheets",
        "bring me the jam and, whittle a spoon",
        "hang the lantern on the hook, dust it",
        "bring me the jam, the saucer",  # names of things that are not known
        "bring me the jam, a saucer",
        "bring me the jam, saucer",
        "Odd is here, bring me the jam, saucers",
        "put the kettle, the cosy, on the stove",
        "bring me the jam, not the sour kind",  # negations, counts, times, manners, places
        "bring me the jam, stealthily",
        "bring me the jam, three slices",
        "bring me the jam, unless it rains",
        "bring me the jam, tomorrow at dawn",
        "take the jam to Tove, under the arches",
    ],
)
def test_what_may_change_the_request_is_never_passed_over(said: str) -> None:
    assert not isinstance(parse(said, FARM), Goals)


@pytest.mark.parametrize("said", ["the poor soul", "good gracious", "bless his heart", "be frank"])
def test_alone_it_asks_for_nothing(said: str) -> None:
    assert not isinstance(parse(said, FARM), Goals)


@pytest.mark.parametrize(
    ("said", "plainly", "who"),
    [
        (
            "hang the lantern on the hook. Odd, leave the goat alone! ",
            "hang the lantern on the hook",
            "Odd",
        ),
        (
            "take the jam — Ines, boots off! — and bring it here",
            "take the jam and bring it here",
            "Ines",
        ),
        (
            "put it in the — darling, let go of my apron — in the basket",
            "put it in the basket",
            "darling",
        ),
        ("Tove, supper! And you, robot, bring me the ladle", "bring me the ladle", "Tove"),
        ("two jars on the bench, please. Odd, put that down.", "put two jars on the bench", "Odd"),
    ],
)
def test_what_is_said_to_others_in_passing_is_theirs(said: str, plainly: str, who: str) -> None:
    outcome = parse(said, FARM)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == goals_of(plainly)
    assert outcome.reason is not None
    assert f"said to {who}" in outcome.reason


def test_a_list_of_people_is_no_call() -> None:
    assert goals_of("find Tove, Odd and Ines") == goals_of("find Tove, find Odd, find Ines")


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("bring me the, how is it called, the ladle", "bring me the ladle"),
        (
            "is there a jar in the, och what's it called, on the bench I mean",
            "is there a jar on the bench",
        ),
        ("set the jar, yes, the jar, on the bench", "set the jar on the bench"),
        ("hang up the lantern, the lantern I say, on the hook", "hang up the lantern on the hook"),
        ("gimme gimme the jam", "give me the jam"),
        ("bring me bring me the jam", "bring me the jam"),
        (
            "so like the jam is on the dresser right, take it to Odd",
            "take the jam on the dresser to Odd",
        ),
        ("bring me the jam, pretty please with honey on top and nuts", "bring me the jam"),
        ("bring me the really very biggest jar", "bring me the biggest jar"),
    ],
)
def test_disfluencies_are_undone(said: str, plainly: str) -> None:
    assert goals_of(said) == goals_of(plainly)


def test_what_is_repeated_to_be_done_again_is_done_again() -> None:
    assert len(goals_of("turn left, turn left, and go to the barn")) == 3  # pyright: ignore[reportArgumentType]


def test_a_compound_is_no_echo() -> None:
    assert not isinstance(parse("bring me the jar, the jar opener", FARM), Goals)
