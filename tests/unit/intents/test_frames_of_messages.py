"""How somebody is said to be told something; the message stays as it was said."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.context import Context
from intents.english.words.lexer import tokenize
from intents.english.words.message_frames import with_plain_frames
from intents.english.words.names import index_of
from intents.goals import Person, Say
from intents.outcomes import Goals
from intents.parser import first_look, parse
from intents.vocabulary import Vocabulary

QUAY = Vocabulary.of(
    objects=["lobster pot", "oilskin", "bait bucket"],
    places=["slip", "ice chest", "winch"],
    rooms=["net loft"],
    people=["Rowena", "Old Tom", "Kit"],
)
INDEX = index_of(QUAY)
FRAMES = (
    "holler through to {who} that {what}",
    "shout over to {who} that {what}",
    "give {who} the message that {what}",
    "pass on to {who} that {what}",
    "mention to {who}, would you, that {what}",
    "warn {who} {what}",
    "{who} wants telling that {what}",
    "a word for {who}: {what}",
    "get hold of {who} and tell them {what}",
    "relay this to {who}, please: {what}",
    "nip out and tell {who} {what}",
    "tell {who} {what}, quick!",
    "tell that {who} {what}, love",
)
MESSAGES = (
    "the tide is turning", "the ice is gone", "we are three short", "the winch is stuck again",
)  # fmt: skip


@given(st.sampled_from(FRAMES), st.sampled_from(("Rowena", "Old Tom", "Kit")),
       st.sampled_from(MESSAGES))  # fmt: skip
def test_any_frame_tells_the_same(frame: str, who: str, what: str) -> None:
    said = frame.format(who=who, what=what)
    goals = first_look(said, QUAY, Context()).goals
    assert goals == (Say(what=what, to=Person(name=who)),), said


@pytest.mark.parametrize(
    "said",
    [
        "give Rowena the oilskin",
        "pass the oilskin to Rowena",
        "bring it to Kit, please",
        "call Kit",
        "get the bait bucket and bring it to Kit",
        "pop the oilskin on the slip and wave",
    ],
)
def test_what_is_no_message_is_left_as_it_was_said(said: str) -> None:
    assert with_plain_frames(tokenize(said), INDEX) == tokenize(said)


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ("Kit's mum rang, tell him she's running late", "she's running late"),
        ("tell Kit he's running late", "you're running late"),
        ("let Rowena know that a man from Newlyn left his hat", "a man from Newlyn left his hat"),
    ],
)
def test_who_is_spoken_of_is_not_taken_for_who_is_told(said: str, what: str) -> None:
    outcome = parse(said, QUAY)
    assert isinstance(outcome, Goals), outcome
    assert [goal.what for goal in outcome.goals if isinstance(goal, Say)] == [what]
