"""A network says sentences in plain words; the grammar reads those; what may be lost is asked."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intents.context import Context
from intents.english.paraphrase.network import BEGIN, shipped
from intents.english.paraphrase.paraphrasing import NOTHING, Heard, Paraphrase, joined
from intents.english.paraphrase.pointing import pointing
from intents.english.paraphrase.source import units, words_of
from intents.english.paraphrase.wordpieces import pieces
from intents.english.words.names import NameIndex, index_of
from intents.goals import Bring, Wait, to_builtins
from intents.outcomes import Goals, Question
from intents.parser import first_look, parse
from intents.plain_words import plainly
from intents.second_look import Attempt
from intents.third_look import third_look
from intents.vocabulary import Vocabulary

OBSERVATORY = Vocabulary.of(
    objects=["star chart", "eyepiece", "thermos", "red torch", "green torch", "notebook"],
    places=["telescope", "map chest", "bench", "heater"],
    rooms=["dome", "darkroom", "library"],
    people=["Ingrid", "Professor Adeyemi"],
)
INDEX = index_of(OBSERVATORY)


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("my hands are frozen solid up here so would somebody kindly whisk the thermos to Ingrid",
         "bring the thermos to Ingrid"),
        ("that star chart, it really ought to be lying on the bench by now, wouldn't you say",
         "put the star chart on the bench"),
        ("Ingrid has been asking and asking, she could do with the eyepiece, the poor thing",
         "bring the eyepiece to Ingrid"),
    ],
)  # fmt: skip
def test_what_strangers_say_is_read_as_what_is_said_plainly(said: str, plain: str) -> None:
    outcome, wanted = parse(said, OBSERVATORY), parse(plain, OBSERVATORY)
    assert isinstance(outcome, Goals), outcome
    assert isinstance(wanted, Goals)
    assert outcome.goals == wanted.goals


@pytest.mark.parametrize(
    "said",
    [
        "if the sky is clear, bring the thermos to the dome",
        "I carried the thermos up to the dome myself this evening, don't you worry",
        "bring me the torch, the tripod, as quick as you like",
    ],
)
def test_what_cannot_be_kept_or_was_only_told_is_not_acted_on(said: str) -> None:
    assert not isinstance(parse(said, OBSERVATORY), Goals)


class Says(Heard):
    """What says the same of every sentence."""

    def __init__(self, plain: str, likely: float, own: float = 1.0) -> None:
        self.plain, self.sure, self.own = plain, likely, own
        self.units = []
        self.is_whole = True

    def __call__(self, text: str, index: NameIndex) -> "Says":
        """Hear a sentence."""
        self.units = units(words_of(text), index)
        return self

    def paraphrase(self) -> Paraphrase:
        """What it always says; it points at every name."""
        named = [n for n, unit in enumerate(self.units) if unit.names]
        return Paraphrase(self.plain, self.sure, named)

    def likely(self, plain: str) -> float:
        """How likely it would have said anything else."""
        del plain
        return self.own


def looked(said: str, network: Says) -> Attempt:
    def read(text: str) -> Attempt:
        return first_look(text, OBSERVATORY, Context())

    return third_look(said, INDEX, read(said), read, hear=network)


STRANGE = "frobnicate the thermos over yonder by way of Ingrid somehow please"


def test_what_is_sure_is_done_what_is_likely_asked_and_what_is_neither_left() -> None:
    order = "bring the thermos to Ingrid"
    done = looked(STRANGE, Says(order, 0.9))
    assert isinstance(done.outcome, Goals)
    assert f"I take that as “{order}”" in (done.outcome.reason or "")
    asked = looked(STRANGE, Says(order, 0.5))
    assert isinstance(asked.outcome, Question)
    assert asked.outcome.goals == done.outcome.goals
    left = looked(STRANGE, Says(order, 0.2))
    assert left.outcome == first_look(STRANGE, OBSERVATORY, Context()).outcome


def test_where_there_may_be_nothing_to_do_it_is_only_asked() -> None:
    said = "the thermos wants frobnicating over yonder by way of Ingrid somehow"
    asked = looked(said, Says("bring the thermos to Ingrid", 1.0))
    assert isinstance(asked.outcome, Question)


@pytest.mark.parametrize("said", [f"if he waves, {STRANGE}", f"not the torch, {STRANGE}"])
def test_a_condition_or_a_denial_is_never_passed_over(said: str) -> None:
    before = first_look(said, OBSERVATORY, Context())
    assert not isinstance(before.outcome, Goals)
    assert looked(said, Says("bring the thermos to Ingrid", 1.0)).outcome == before.outcome


def test_a_name_that_is_lost_is_asked_about() -> None:
    class Forgets(Says):
        def paraphrase(self) -> Paraphrase:
            return super().paraphrase()._replace(pointed=[])

    assert not isinstance(
        looked(STRANGE, Forgets("bring the thermos to Ingrid", 1.0)).outcome, Goals
    )


def test_what_the_grammar_reads_from_every_word_stays() -> None:
    said = "bring the thermos from the bench to Ingrid in the library, and then nod"
    assert isinstance(first_look(said, OBSERVATORY, Context()).outcome, Goals)
    kept = looked(said, Says("put the notebook on the bench", 1.0, own=0.0))
    assert kept.outcome == first_look(said, OBSERVATORY, Context()).outcome
    assert looked(said, Says(NOTHING, 1.0, own=0.0)).outcome == kept.outcome


def test_talk_that_was_read_as_an_order_is_left_out_where_nobody_would_say_so() -> None:
    said = "Hold on please. Could you bring the thermos to Ingrid? It is getting cold in there."
    read = first_look(said, OBSERVATORY, Context())
    assert [type(goal) for goal in read.goals] == [Wait, Bring]
    left = looked(said, Says("bring the thermos to Ingrid", 0.9, own=0.0))
    assert isinstance(left.outcome, Goals)
    assert left.goals == read.goals[1:]
    assert looked(said, Says("bring the thermos to Ingrid", 0.9, own=0.1)).goals == read.goals
    assert looked(said, Says("put the thermos on the bench", 0.9, own=0.0)).goals == read.goals


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


def test_the_network_says_plain_words_again_and_knows_how_likely_it_would() -> None:
    heard = Heard("bring the thermos to Ingrid", INDEX)
    said = heard.paraphrase()
    assert said.text == "bring the thermos to Ingrid"
    assert heard.likely(said.text) == pytest.approx(said.likely, rel=1e-3)
    assert heard.likely("put the thermos on the bench") == 0.0  # no bench was spoken of


def test_what_is_too_long_to_be_read_whole_is_left_to_the_grammar() -> None:
    rambling = f"{'incomprehensibilities ' * 40} {STRANGE}"
    assert not Heard(rambling, INDEX).is_whole
    assert Heard(STRANGE, INDEX).is_whole
    part = Says("bring the thermos to Ingrid", 1.0)
    part.is_whole = False
    assert not isinstance(looked(STRANGE, part).outcome, Goals)
    endless = f"{STRANGE}, {'and on it goes ' * 20}"
    assert not isinstance(looked(endless, Says("bring the thermos to Ingrid", 1.0)).outcome, Goals)


def test_what_comes_next_is_a_distribution() -> None:
    network = shipped()
    read = network.read([1, 2, 3], [0, 0, 0])
    odds = network.begin(read, [1, 0]).after(BEGIN)
    assert odds.shape == (len(network.words) + 2,)
    assert np.exp(odds).sum() == pytest.approx(1.0, abs=1e-4)
    assert np.exp(odds[-1]) < 1e-6  # what was not read is not pointed at


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=200))
def test_any_text_is_cut_into_units_that_cover_it(text: str) -> None:
    words = words_of(text)
    said = units(words, INDEX)
    assert [n for unit in said for n in range(unit.start, unit.end)] == list(range(len(words)))


def test_pieces_are_the_longest_that_are_known() -> None:
    known = {"[UNK]": 0, "tel": 1, "telesc": 2, "##ope": 3, "##o": 4}
    assert pieces("Telescope", known) == [2, 3]
    assert pieces("xylophone", known) == [0]
    assert pieces("telesc" + "o" * 95, known) == [0]  # no word has so many letters


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
    assert joined(["turn", "90", "°", "left"]) == "turn 90° left"
