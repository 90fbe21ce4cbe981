"""The network checks what the grammar reads: what it doubts is asked about, and nothing is made."""

from collections.abc import Sequence

import numpy as np
import pytest

from intents.context import Context
from intents.english.learnt.check import Said, check, is_unfamiliar, signs
from intents.english.learnt.field import LEARNT, Field
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.paraphrasing import ASK, Heard, Paraphrase
from intents.english.words.names import NameIndex, index_of
from intents.outcomes import Goals, Question
from intents.parser import first_look
from intents.second_look import Attempt
from intents.vocabulary import Vocabulary
from intents.witness import Hears, checked, to_check

FERRY = Vocabulary.of(
    objects=["life jacket", "logbook", "green mug", "blue mug", "torch"],
    places=["galley bench", "chart table", "locker", "wheel"],
    rooms=["bridge", "galley", "engine room"],
    people=["Magnus", "Oona"],
)
INDEX = index_of(FERRY)
KIND = "Oona's stuck in the engine room, poor soul, so take the torch to her"
LONG = "oh and might you bring the torch over to Oona before it gets too murky for her out there"


class Thinks:
    """A network that says something, and how likely it finds what others say."""

    is_whole = True

    def __init__(self, says: str, finds: Sequence[tuple[float, float]] | None) -> None:
        self._says, self._finds = says, finds

    def __call__(self, text: str, index: NameIndex) -> "Thinks":
        return self

    def paraphrase(self) -> Paraphrase:
        return Paraphrase(self._says, 0.95)

    def finds(self, plain: str, index: NameIndex) -> list[tuple[float, float]] | None:
        count = len(Heard(plain, index).units) + 1
        return None if self._finds is None else [*self._finds, *[(0.0, 0.0)] * count][:count]


class Nobody:
    """A network that nobody is to ask."""

    def __call__(self, text: str, index: NameIndex) -> Heard:
        raise AssertionError(text)


def read(said: str) -> Attempt:
    return first_look(said, FERRY, Context())


DOUBTS = Field(
    (RIGHT, WRONG), {"always": 0, "ask": 1}, np.array([[2.0, -2.0], [-4.0, 4.0]]), np.zeros((2, 2))
)
"""What doubts all of which the network says that it has to be asked about."""


def test_what_is_doubted_is_asked_about_and_not_changed() -> None:
    before = read(KIND)
    assert isinstance(before.outcome, Goals), before
    fields = {"choice": LEARNT["choice"], "check": DOUBTS}
    asked = checked(KIND, INDEX, before, read, hear=Thinks(ASK, []), fields=fields)
    assert isinstance(asked.outcome, Question)
    assert asked.outcome.goals == before.goals
    likely = Thinks("bring the torch to Oona at the engine room", [])
    assert checked(KIND, INDEX, before, read, hear=likely, fields=fields) is before


def test_the_less_likely_the_network_finds_its_words_the_less_likely_a_reading_is() -> None:
    before = read(KIND)
    said = to_check(KIND, INDEX, before, read, certain=1.1)
    assert said is not None
    likely = said._replace(witness="agree", likely=0.95, found=[(-0.01, -0.01)] * 4)
    assert check(likely) > check(likely._replace(found=[(-0.01, -0.01), (-9.0, -0.01)] * 2))
    assert check(likely) > check(likely._replace(witness="differ"))
    assert check(likely) > 0.85


@pytest.mark.parametrize(
    "said",
    [
        "bring the torch",  # few words
        'say "the torch is on the wheel and the locker is shut" to Oona please',  # word for word
        "bring the green mug, no, the blue mug, to Oona on the bridge please",  # taken back
        "stop",
    ],
)
def test_of_these_the_network_knows_nothing(said: str) -> None:
    before = read(said)
    assert checked(said, INDEX, before, read, hear=Nobody()) is before


def test_what_refers_to_what_was_said_before_is_not_checked() -> None:
    said = "would you mind awfully bringing it over here to Oona on the bridge"
    before = read(said)
    assert isinstance(before.outcome, Goals), before
    assert to_check(said, INDEX, before, read, follows=True, certain=1.1, hear=Nobody()) is None


def test_a_question_or_refusal_is_not_checked() -> None:
    before = read("fold the laundry, then sing to Magnus and Oona in the engine room")
    assert not isinstance(before.outcome, Goals)
    assert checked(LONG, INDEX, before, read, hear=Nobody()) is before


def test_each_sentence_is_heard_once() -> None:
    hear = Hears()
    assert hear(LONG, INDEX) is hear(LONG, INDEX)
    assert hear("nod", INDEX) is not hear(LONG, INDEX)


def test_other_words_are_weighed_as_those_that_are_written() -> None:
    heard = Heard(LONG, INDEX)
    said = heard.paraphrase()
    found = heard.finds(said.text, INDEX)
    assert found is not None
    assert np.exp(sum(own for own, _ in found)) == pytest.approx(said.likely, rel=1e-3)
    assert all(own == most for own, most in found)
    other = heard.finds("put the torch on the torch", INDEX)
    assert other is None or sum(own for own, _ in other) < sum(own for own, _ in found)
    assert heard.finds("bring the logbook to Magnus", INDEX) is None  # nobody said these


def test_of_whom_one_tells_by_their_clothes_its_surprise_says_nothing() -> None:
    goals = read("follow the person in red in the galley").goals
    assert is_unfamiliar(goals)
    assert not is_unfamiliar(read("follow Oona").goals)
    said = Said(LONG, [], goals, "", 0.5, [(-20.0, 0.0)], "ask", 0.9)
    assert "unfamiliar" in signs(said)
    assert "ask" not in signs(said)
