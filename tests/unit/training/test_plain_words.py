"""Goals are said in plain words that are read back; what they name is pointed at in a sentence."""

import pytest

from intents.context import Context
from intents.english.paraphrase.pointing import pointing
from intents.english.paraphrase.source import units, words_of
from intents.english.words.names import index_of
from intents.goals import to_builtins
from intents.outcomes import Goals
from intents.parser import first_look
from intents.plain_words import plainly
from intents.vocabulary import Vocabulary

OBSERVATORY = Vocabulary.of(
    objects=["star chart", "eyepiece", "thermos", "red torch", "green torch", "notebook"],
    places=["telescope", "map chest", "bench", "heater"],
    rooms=["dome", "darkroom", "library"],
    people=["Ingrid", "Professor Adeyemi"],
)
INDEX = index_of(OBSERVATORY)


@pytest.mark.parametrize(
    "said",
    [
        "bring the thermos to me", "put the red torch on the bench", "look for Ingrid at the dome",
        "3 times : nod", "for every thermos : put it into the map chest", "come here",
        "walk 2 m forward ; turn 90° left", "say “the sky is clear” to Ingrid",
        "switch on the heater",
        "if the thermos at the bench is there, bring the thermos to me", "what are you holding",
    ],
)  # fmt: skip
def test_plain_words_are_read_as_the_goals_that_they_were_said_for(said: str) -> None:
    read = first_look(said, OBSERVATORY, Context()).outcome
    assert isinstance(read, Goals), read
    again = first_look(plainly(read.goals), OBSERVATORY, Context()).outcome
    assert isinstance(again, Goals)
    assert to_builtins(again.goals) == to_builtins(read.goals)


def test_what_comes_from_nowhere_cannot_be_pointed_at() -> None:
    said = units(words_of("Ingrid, the thermos"), INDEX)
    words = {"bring", "the", "to"}
    assert pointing("bring the thermos to Ingrid", said, INDEX, words) == [
        "bring",
        "the",
        3,
        "to",
        0,
    ]
    assert pointing("bring the notebook to Ingrid", said, INDEX, words) is None
