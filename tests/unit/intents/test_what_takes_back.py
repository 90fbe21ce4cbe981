"""What is said between what was said and what was meant, in any number and order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.context import Context
from intents.english.words.lexer import tokenize
from intents.english.words.names import index_of
from intents.english.words.taking_back import behind_what_takes_back, interruptions
from intents.goals import Bring, GoTo, Place, Say
from intents.outcomes import Goals
from intents.parser import first_look, parse
from intents.vocabulary import Vocabulary

FORGE = Vocabulary.of(
    objects=["tongs", "bellows", "horseshoe", "rasp", "apron"],
    places=["anvil", "quench tank", "shelf"],
    rooms=["smithy", "paddock"],
    people=["Elspeth", "Tam"],
)
INDEX = index_of(FORGE)

CRIES = ("och", "oh", "ach", "drat", "aiya", "sorry", "excuse me", "damn")
TAKING = ("wrong", "no man", "what am I saying", "I tell a lie", "my bad", "scratch that", "typo")
ADDRESS = ("love", "pal", "my dear", "mate")


def said_in(text: str) -> list[str]:
    return [token.text for token in interruptions(tokenize(text), INDEX)]


@given(
    st.lists(st.sampled_from(CRIES), max_size=2),
    st.sampled_from(TAKING),
    st.lists(st.sampled_from(ADDRESS), max_size=1),
    st.sampled_from([", ", ". ", "... ", " - "]),
)
def test_any_run_of_cries_regrets_and_address_takes_back_what_was_said(
    cries: list[str], taking: str, address: list[str], sign: str
) -> None:
    run = ", ".join([*cries, taking, *address])
    outcome = first_look(f"put the rasp on the anvil{sign}{run}, on the shelf", FORGE, Context())
    assert outcome.goals == first_look("put the rasp on the shelf", FORGE, Context()).goals


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Bring the rasp to Tam. Och no, he's had his turn. Elspeth.", "bring the rasp to Elspeth"),
        ("Bring me the tongs, hang about, wrong, the rasp'll do.", "bring me the rasp"),
        ("Bring me five horseshoes, or wait, it is Sunday, three are enough.",
         "bring me three horseshoes"),
        ("Go to the smithy, sorry pal, my mistake, the paddock, I'm all at sea today.",
         "go to the paddock"),
        ("Fetch the rasp, nah the tongs, nah tell you what, the rasp.", "fetch the rasp"),
    ],
)  # fmt: skip
def test_reasons_and_what_will_do_stand_beside_what_is_meant(said: str, plain: str) -> None:
    outcome = parse(said, FORGE)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == first_look(plain, FORGE, Context()).goals


@pytest.mark.parametrize(
    "said",
    [
        "bring me the rasp, please",
        "bring me the rasp, no rush",
        "go to the smithy, then to the paddock",
        "bring the rasp, sorry to trouble you",
        "oh no, the rasp fell",
        "say to Tam: no, my mistake, the paddock",
        "go to the smithy, wait, then come back",
    ],
)
def test_what_takes_nothing_back_is_left_as_it_was_said(said: str) -> None:
    assert said_in(said) == [token.text for token in tokenize(said)]


@pytest.mark.parametrize(
    ("said", "behind"),
    [
        ("the rasp, no, the tongs", ", the tongs"),
        ("the rasp, what am I saying, the tongs", ", the tongs"),
        ("the rasp, no rush", None),
        ("put the rasp on the anvil", None),
    ],
)
def test_what_stands_behind_the_last_words_that_take_back(said: str, behind: str | None) -> None:
    assert behind_what_takes_back(said) == behind


def test_kinds_of_goals_stay() -> None:
    kinds = {type(goal) for text in ("go to the smithy, wrong, the paddock",
                                     "put the rasp on the anvil, typo, on the shelf",
                                     "bring Tam the rasp, aiya, wrong, Elspeth")
             for goal in first_look(text, FORGE, Context()).goals}  # fmt: skip
    assert kinds <= {GoTo, Place, Bring}
    assert Say not in kinds
