"""A network says sentences in plain words; the grammar reads those; what may be lost is asked."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intents.context import Context
from intents.doubts import DOUBTED_ALONE, FOUND, SURER
from intents.english.learnt.choice import ALONE, OTHER, OWN, Both, Name, Side, choice, signs
from intents.english.learnt.field import Field
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.network import BEGIN, shipped
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard, Paraphrase, joined
from intents.english.paraphrase.source import units, words_of
from intents.english.paraphrase.wordpieces import pieces
from intents.english.trouble import Doubtful, Offered, Partly, Unclear
from intents.english.words.names import NameIndex, index_of
from intents.goals import Bring, Wait
from intents.outcomes import Goals, Question
from intents.parser import first_look, parse
from intents.second_look import Attempt
from intents.third_look import CAREFUL, CLEAR, TRUSTED, third_look
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


class Stuck:
    """A network that writes the same words for ever, as sure as one can be."""

    def __init__(self, says: list[str], *, likely: float) -> None:
        self._net, self._likely, self._says = shipped(), likely, says
        self.written = 0

    def __getattr__(self, name: str) -> object:
        return getattr(self._net, name)

    def begin(self, _read: object, _heads: object) -> "Stuck":
        return self

    def after(self, _word: int) -> np.ndarray:
        odds = np.full(len(self._net.words), -99.0)
        word = self._says[self.written % len(self._says)]
        odds[self._net.numbers_of[word]] = np.log(self._likely)
        self.written += 1
        return odds


@pytest.mark.parametrize(
    ("says", "likely", "at_most"), [(["bring", "the"], 1.0, 4), (["the"], 0.5, 6)]
)
def test_who_is_lost_for_words_stops_talking(says: list[str], likely: float, at_most: int) -> None:
    stuck = Stuck(says, likely=likely)
    said = Heard("would you whisk the thermos to Ingrid", INDEX, stuck).paraphrase()  # type: ignore[arg-type]
    assert said.text == ASK
    assert stuck.written <= at_most


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

    def __init__(self, plain: str, likely: float = 0.9) -> None:
        self.plain = plain
        self.likely = likely
        self.units = []
        self.is_whole = True

    def __call__(self, text: str, index: NameIndex) -> "Says":
        """Hear a sentence."""
        self.units = units(words_of(text), index)
        return self

    def paraphrase(self) -> Paraphrase:
        """What it always says."""
        return Paraphrase(self.plain, self.likely)


def trusting(own: float, other: float, alone: float) -> dict[str, Field]:
    """What trusts the grammar's reading and the network's so much, whatever they are."""
    odds = [[np.log(p / (1 - p)), 0.0] for p in (own, other, alone)]
    rows = {f"{OWN}:always": 0, f"{OTHER}:always": 1, f"{ALONE}:always": 2}
    return {"choice": Field((RIGHT, WRONG), rows, np.array(odds), np.zeros((2, 2)))}


def looked(
    said: str, network: Says, own: float = 0.5, other: float = 0.99, *, alone: float = 0.1,
    follows: bool = False,
) -> Attempt:  # fmt: skip
    def read(text: str) -> Attempt:
        return first_look(text, OBSERVATORY, Context())

    fields = trusting(own, other, alone)
    return third_look(said, INDEX, read(said), read, follows=follows, hear=network, fields=fields)


STRANGE = "frobnicate the thermos over yonder by way of Ingrid somehow please"
ORDER = Says("bring the thermos to Ingrid")


def test_what_is_likely_is_done_what_may_be_asked_and_what_is_neither_left() -> None:
    done = looked(STRANGE, ORDER, other=0.9)
    assert isinstance(done.outcome, Goals)
    assert f"I take that as “{ORDER.plain}”" in (done.outcome.reason or "")
    asked = looked(STRANGE, ORDER, other=0.5)
    assert isinstance(asked.outcome, Question)
    assert asked.outcome.goals == done.outcome.goals
    left = looked(STRANGE, ORDER, other=0.1)
    assert left.outcome == first_look(STRANGE, OBSERVATORY, Context()).outcome
    for none in (NOTHING, ASK):
        assert looked(STRANGE, Says(none)).outcome == left.outcome


def test_words_that_the_network_itself_is_not_sure_of_are_asked_about() -> None:
    unsure = Says(ORDER.plain, likely=FOUND - 0.01)
    assert isinstance(looked(STRANGE, unsure, other=DOUBTED_ALONE - 0.01).outcome, Question)
    assert isinstance(looked(STRANGE, unsure, other=DOUBTED_ALONE + 0.01).outcome, Goals)


@pytest.mark.parametrize("limit", ["the one that is not cracked", "for ten minutes or so"])
def test_where_a_time_or_a_measure_may_be_guessed_it_has_to_be_surer(limit: str) -> None:
    said = f"{limit}, {STRANGE}"
    assert not isinstance(looked(said, ORDER, other=SURER - 0.01).outcome, Goals)
    assert isinstance(looked(said, ORDER, other=SURER + 0.01).outcome, Goals)


def test_what_the_grammar_names_as_not_kept_is_not_said_away() -> None:
    said = "bring me the thermos with a warm smile, and only if the sky is clear"
    before = first_look(said, OBSERVATORY, Context())
    assert type(before.error) is Partly
    assert looked(said, ORDER).outcome == before.outcome


WHOLE = (
    "be an absolute angel and bring the thermos from the bench to Ingrid in the library, then nod"
)


def test_what_the_grammar_reads_from_every_word_stays_where_it_is_likely() -> None:
    before = first_look(WHOLE, OBSERVATORY, Context())
    assert isinstance(before.outcome, Goals)
    other = Says("bring the thermos at the bench to Ingrid at the library ; bow")
    assert looked(WHOLE, other, own=0.6).outcome == before.outcome
    assert looked(WHOLE, other, own=0.1, other=0.6).goals == before.goals
    taken = looked(WHOLE, other, own=0.1, other=0.8)
    assert isinstance(taken.outcome, Goals)
    assert taken.goals != before.goals
    for silent in (NOTHING, ASK):
        assert isinstance(looked(WHOLE, Says(silent), own=0.1).outcome, Question)
        assert looked(WHOLE, Says(silent), own=0.4).outcome == before.outcome


class Unasked(Says):
    """A network that nobody is to ask."""

    def __call__(self, text: str, index: NameIndex) -> "Says":
        """Hear a sentence."""
        raise AssertionError(f"asked about {text!r}")


def test_what_is_likely_enough_by_itself_costs_no_time() -> None:
    assert looked(WHOLE, Unasked(ORDER.plain), own=0.01, alone=TRUSTED + 0.01).goals


def test_what_refers_to_something_said_before_is_left_to_the_grammar() -> None:
    said = "bring it from the bench to Ingrid in the library, and then nod over there"
    assert looked(said, Unasked(ORDER.plain), follows=True) is not None


@pytest.mark.parametrize(
    ("said", "error"),
    [
        ("yeet the thermos onto the bench", Offered),
        ("put the torch on the bench", Unclear),  # which of two
        ("bring the tremos chart to Ingrid", Doubtful),
    ],
)
def test_what_is_asked_on_purpose_stays_asked(said: str, error: type) -> None:
    before = first_look(said, OBSERVATORY, Context())
    assert isinstance(before.error, error), before
    assert isinstance(before.outcome, Question)
    assert looked(said, Unasked(ORDER.plain)).outcome == before.outcome


@pytest.mark.parametrize(
    "said",
    [
        "please bring the thermos from the bench to Ingrid in the library and then nod",
        "sorry, robot, could you bring the thermos from the bench to Ingrid in the library",
        "do be a darling and tell Ingrid that the thermos is on the bench over there",
        "do be a darling and if the thermos is on the bench bring it over to Ingrid",
        "do be a darling and put the thermos, no, the notebook, on the bench over there",
    ],
)
def test_what_the_grammar_was_made_for_is_left_to_it(said: str) -> None:
    before = first_look(said, OBSERVATORY, Context())
    assert isinstance(before.outcome, Goals), before
    assert looked(said, Unasked(ORDER.plain), alone=CAREFUL + 0.01).outcome == before.outcome


@pytest.mark.parametrize(
    "said",
    ["do be a darling and tell Ingrid that the thermos is on the bench", "bring the thermos"],
)
def test_messages_and_few_plain_words_always_are(said: str) -> None:
    before = first_look(said, OBSERVATORY, Context())
    assert isinstance(before.outcome, Goals), before
    assert looked(said, Unasked(ORDER.plain)).outcome == before.outcome


def test_what_speaks_against_a_plain_order_has_to_be_likelier_and_sure_of_its_words() -> None:
    said = "please bring the thermos from the bench to Ingrid in the library and nod"
    before = first_look(said, OBSERVATORY, Context())
    other = "put the thermos on the bench ; come here ; greet Ingrid at the library"
    taken = looked(said, Says(other), own=0.2, other=0.8)
    assert isinstance(taken.outcome, Goals)
    assert taken.goals != before.goals
    assert isinstance(looked(said, Says(other), own=0.2, other=0.5).outcome, Question)
    assert looked(said, Says(other), own=0.4, other=0.3).outcome == before.outcome
    assert looked(said, Says(other, CLEAR - 0.01), own=0.2).outcome == before.outcome
    same = "bring the thermos at the bench to Ingrid at the library ; nod"
    assert looked(said, Says(same), own=0.2).outcome == before.outcome


def test_an_order_that_was_read_is_never_just_left_out() -> None:
    left = looked(WHOLE, Says("bring the thermos at the bench to Ingrid at the library"), own=0.1)
    assert isinstance(left.outcome, Question)
    assert left.goals == first_look(WHOLE, OBSERVATORY, Context()).goals


def test_what_is_only_told_is_offered_however_sure_the_network_is() -> None:
    told = "the thermos on the bench is what Ingrid has been pining for all evening long"
    assert not isinstance(first_look(told, OBSERVATORY, Context()).outcome, Goals)
    assert isinstance(looked(told, ORDER).outcome, Question)
    asked = f"could you see to it, {told}"
    assert isinstance(looked(asked, ORDER).outcome, Goals)


def test_small_talk_is_not_taken_for_a_question_about_the_robot() -> None:
    said = "how fares the wretched weather report for the dome tonight"
    before = first_look(said, OBSERVATORY, Context())
    assert looked(said, Says("what are you doing")).outcome == before.outcome


def test_talk_read_as_an_order_is_left_out_or_asked_about_where_it_is_not_trusted() -> None:
    said = "Hold on please. Could you bring the thermos to Ingrid? It is getting cold in there."
    read = first_look(said, OBSERVATORY, Context())
    assert [type(goal) for goal in read.goals] == [Wait, Bring]
    left = looked(said, ORDER, own=0.1)
    assert isinstance(left.outcome, Goals)
    assert left.goals == read.goals[1:]
    assert looked(said, ORDER, own=0.6).goals == read.goals
    assert isinstance(looked(said, ORDER, own=0.1, other=0.5).outcome, Question)
    assert isinstance(looked(said, Says(NOTHING), own=0.1).outcome, Question)


def test_what_a_reading_leaves_out_and_how_the_two_differ_tells_for_or_against_it() -> None:
    goals = first_look("bring the thermos to Ingrid", OBSERVATORY, Context()).goals
    names = [Name("object", ("thermos",), True), Name("person", ("Ingrid",), True)]
    side = Side("goals", goals)
    both = Both("bring Ingrid the thermos unless she waves", names, ORDER.plain, 0.9, side, side)
    assert {"own:same", "other:same", "other:has condition: lost"} <= {
        *signs(both, OWN), *signs(both, OTHER)
    }  # fmt: skip
    less = both._replace(other=Side("goals", (Wait(),)))
    assert "other:lost=2" in signs(less, OTHER)
    assert "own:lost=0" in signs(less, OWN)
    assert "own:unlike" in signs(less, OWN)
    assert 0.0 < min(choice(both)) < max(choice(both)) < 1.0
    assert choice(both._replace(own=Side("refusal")))[0] == 0.0


def test_the_network_says_plain_words_again() -> None:
    said = Heard("bring the thermos to Ingrid", INDEX).paraphrase()
    assert said.text == "bring the thermos to Ingrid"
    assert said.likely > 0.9
    assert joined(["turn", "90", "°", "left"]) == "turn 90° left"


def test_what_is_too_long_to_be_read_whole_is_left_to_the_grammar() -> None:
    rambling = f"{'incomprehensibilities ' * 40} {STRANGE}"
    assert not Heard(rambling, INDEX).is_whole
    assert Heard(STRANGE, INDEX).is_whole
    part = Says(ORDER.plain)
    part.is_whole = False
    assert not isinstance(looked(STRANGE, part).outcome, Goals)
    endless = f"{STRANGE}, {'and on it goes ' * 20}"
    assert not isinstance(looked(endless, ORDER).outcome, Goals)


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
