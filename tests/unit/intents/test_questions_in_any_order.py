"""Questions told by their words, in any order, and amounts behind what they count."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.context import Context
from intents.english.words.amounts_behind import counted_first
from intents.english.words.lexer import tokenize
from intents.english.words.names import index_of
from intents.english.words.question_frames import plainly_put
from intents.parser import first_look
from intents.vocabulary import Vocabulary

DAIRY = Vocabulary.of(
    objects=["butter churn", "milk pail", "cheese cloth", "ladle", "skimmer"],
    places=["stone slab", "cheese press", "cold shelf"],
    rooms=["creamery", "byre"],
    people=["Nesta", "Huw"],
)
INDEX = index_of(DAIRY)


def goals_of(said: str) -> tuple[object, ...]:
    return first_look(said, DAIRY, Context()).goals


@given(
    st.sampled_from(["ladle", "milk pail", "skimmer"]),
    st.sampled_from([
        "Whaur's ma {} got tae?", "Where in heaven's name did they put my {}?",
        "Where has the {} gone?", "Which shelf have {}?", "{} in where we are keeping?",
        "Where on earth is our {}?", "Where'd you hide the {}?",
    ]),
)  # fmt: skip
def test_where_something_is_is_asked_in_any_words(thing: str, asked: str) -> None:
    assert goals_of(asked.format(thing)) == goals_of(f"where is the {thing}?")


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Whit's that ye've got in yer haun?", "what are you holding?"),
        ("What have you there?", "what are you holding?"),
        ("In the byre there is somebody?", "is there anybody in the byre?"),
        ("Is there a soul at all out in the byre?", "is there anybody in the byre?"),
        ("How many have I got waiting at that cheese press?",
         "how many people are at the cheese press?"),
        ("What all is knocking about on the stone slab?", "what is on the stone slab?"),
        ("Anything left on the cold shelf?", "what is on the cold shelf?"),
        ("Give me ladle three piece.", "give me three ladles"),
        ("Five ladle put on the stone slab.", "put five ladles on the stone slab"),
        ("The skimmers, the lot, from the cold shelf to the stone slab.",
         "all the skimmers from the cold shelf to the stone slab"),
        ("Put five ladles on the cold shelf, skimmer also five.",
         "put five ladles on the cold shelf and five skimmers too"),
    ],
)  # fmt: skip
def test_what_is_put_otherwise_means_the_same(said: str, plain: str) -> None:
    assert goals_of(said) == goals_of(plain) != ()


@pytest.mark.parametrize(
    "said",
    [
        "Where shall I put the ladle?",
        "Could you find where Nesta left the ladle and bring it?",
        "What is the ladle made of?",
        "Can you put the ladle in my hand?",
        "How many on the cold shelf?",
        "Is Nesta in the byre?",
        "Bring three ladles",
        "Put the ladle on the cold shelf, and the skimmer too",
    ],
)
def test_with_a_word_more_it_is_left_as_it_was_said(said: str) -> None:
    tokens = tokenize(said)
    assert plainly_put(tokens, INDEX) == tokens
    assert counted_first(tokens, INDEX) == tokens
