"""Background is passed over and said so, unheard wordings are said again in plain words; what may
change what is asked is asked about, and nothing is dropped in silence."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intents.english.learnt.looks import looks
from intents.english.learnt.looks import said as looks_said
from intents.english.learnt.passing import remainders
from intents.english.learnt.rewording import reworded
from intents.english.learnt.sight import Sight, sight
from intents.english.words.names import index_of
from intents.goals import to_builtins
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.vocabulary import Vocabulary

LIGHTHOUSE = Vocabulary.of(
    objects=["oil can", "logbook", "lantern", "rope", "tin mug"],
    places=["map table", "spiral stairs", "locker", "stove"],
    rooms=["lamp room", "cellar", "watch room"],
    people=["Marit", "Old Sven"],
)
INDEX = index_of(LIGHTHOUSE)


def goals_of(said: str) -> object:
    outcome = parse(said, LIGHTHOUSE)
    assert isinstance(outcome, Goals), outcome
    return to_builtins(outcome.goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("close the locker, it has been rattling all night", "close the locker"),
        ("bring me the rope would you my knees are killing me today", "bring me the rope"),
        ("take the oil can to Marit because she is up to her elbows in grease",
         "take the oil can to Marit"),
        ("The storm is getting worse and I have not slept. Put the logbook on the map table",
         "put the logbook on the map table"),
        ("bring the lantern to the cellar before somebody breaks their neck down there",
         "bring the lantern to the cellar"),
    ],
)  # fmt: skip
def test_background_changes_nothing(said: str, plainly: str) -> None:
    assert goals_of(said) == goals_of(plainly)


def test_what_is_passed_over_is_told() -> None:
    said = "bring me the rope would you my knees are killing me today"
    outcome = parse(said, LIGHTHOUSE)
    assert isinstance(outcome, Goals)
    assert "“would you my knees are killing me today”" in (outcome.reason or "")


def test_what_was_taken_in_other_words_is_told() -> None:
    outcome = parse("to Marit with the logbook", LIGHTHOUSE)
    assert isinstance(outcome, Goals)
    assert "“bring the logbook to Marit”" in (outcome.reason or "")


@pytest.mark.parametrize(
    "said",
    [
        "bring me the rope if the wind drops",
        "bring me the rope unless Marit needs it",
        "put the logbook on the map table but not before noon",
        "bring me the rope Marit is holding",
        "bring me the lantern, gingerly",
    ],
)
def test_what_may_change_what_is_asked_is_never_passed_over_in_silence(said: str) -> None:
    outcome = parse(said, LIGHTHOUSE)
    assert not isinstance(outcome, Goals) or "if" in to_builtins(outcome.goals)[0]["goal"], outcome


@pytest.mark.parametrize(
    "said",
    [
        "five lanterns if you can find them onto the map table",
        "rid the stove of every tin mug but one",
        "no rope for Marit",
    ],
)
def test_plain_words_that_leave_something_out_are_no_more_than_a_question(said: str) -> None:
    plain = reworded(said, INDEX)
    assert plain is None or plain.least > 1


@pytest.mark.parametrize(
    "said",
    [
        "my cousin will bring the rope by himself, thanks all the same",
        "the oil can was taken to the cellar",
        "I put the logbook on the map table",
        "bless this tin mug, old friend, my hands are full",
        "wait are you filming this again",
        "I already hung the lantern on the locker",
        "Marit never said to bring the rope",
        "the captain didn't say close the locker",
        "every time the horn sounds, close the locker",
        "bring the oil can to Marit as soon as she comes down",
        "Sven, I was only practising: “bring me the rope”, was that right?",
    ],
)
def test_what_is_told_quoted_or_for_later_is_not_acted_on(said: str) -> None:
    assert not isinstance(parse(said, LIGHTHOUSE), Goals)


@pytest.mark.parametrize(
    ("said", "harm"),
    [
        ("bring me the rope, gingerly", "manner"),
        ("bring me the rope, a bucket", "thing"),
        ("bring me the rope, juggle", "order"),
        ("bring me the rope as soon as she calls for it", "event"),
        ("bring me the ropes, three of them", "grave"),
        ("bring me the rope that Marit left at the foot of the stairs", "which"),
    ],
)
def test_what_may_say_which_how_or_when_is_known_by_its_form(said: str, harm: str) -> None:
    words = looks_said(said)
    idle = np.array([0.0 if n < 4 else 0.99 for n in range(len(words))])
    seen = Sight(words, idle, {}, [], [])
    told = [rest.harms for rest in remainders(said, seen, INDEX)]
    assert told
    assert all(harm in harms for harms in told)


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=120))
def test_every_text_has_looks_and_none_raises(text: str) -> None:
    words = looks_said(text)
    assert len(looks(words, INDEX)) == len(words)
    seen = sight(text, INDEX)
    if seen:
        remainders(text, seen, INDEX)
        reworded(text, INDEX, [float(p) for p in seen.idle])


def test_what_is_in_doubt_is_asked_with_all_that_would_be_done() -> None:
    said = "a rope, the long one, and off to Marit with it"
    outcome = parse(said, LIGHTHOUSE)
    assert isinstance(outcome, Question), outcome
    assert outcome.kind == "confirmation"
    assert to_builtins(outcome.goals) == goals_of("bring a rope to Marit")
