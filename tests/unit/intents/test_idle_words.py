"""Words that say nothing: particles in any number and order, and notes for whole sentences."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.english.words.lexer import tokenize
from intents.english.words.names import index_of
from intents.english.words.particles import without_particles
from intents.goals import Find, Greet
from intents.outcomes import Goals, Question, Refusal
from tests.unit.intents.hotel_words import HOTEL, assert_means_the_same, heard

RUNS = (
    "right so", "och well", "arre yaar,", "yeah so like", "okay well right", "aye, right then",
    "hey buddy,", "blimey,", "lovely,", "good, so", "accha beta,", "you know what,", "pray tell,",
    "beg your pardon,", "before I forget,", "say,", "oh jeez,", "well now,", "ahem,", "hmm okay so",
)  # fmt: skip
ORDERS = (
    "bring me the cap", "put the teapot on the bar", "could you go to the spa?",
    "where is the cap?",
    "the torch goes in the bin", "if Olga is in the lobby, wave",
)  # fmt: skip


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("run", RUNS)
def test_a_run_of_particles_changes_no_order(run: str, order: str) -> None:
    index = index_of(HOTEL)
    kept = [token.text for token in without_particles(tokenize(f"{run} {order}"), index)]
    assert kept == [token.text for token in tokenize(order)]


@given(st.lists(st.sampled_from(["right", "och", "aye", "well", "jings", "yaar"]), min_size=1))
def test_their_number_and_order_do_not_matter(run: list[str]) -> None:
    index = index_of(HOTEL)
    kept = without_particles(tokenize(f"{' '.join(run)} fetch the cap"), index)
    assert [token.text for token in kept] == ["fetch", "the", "cap"]


@pytest.mark.parametrize("run", ["right so", "arre yaar,", "och well,", "grand,"])
def test_after_them_an_order_is_read(run: str) -> None:
    assert_means_the_same(f"{run} bring me the cap", "bring me the cap")


@pytest.mark.parametrize(
    "said", ["hi", "hello", "yes", "sure", "good", "turn right", "right", "the sweet tea", "well"]
)
def test_alone_or_elsewhere_they_stay(said: str) -> None:
    tokens = tokenize(said)
    assert without_particles(tokens, index_of(HOTEL)) == tokens


def test_a_greeting_is_one() -> None:
    outcome = heard("hello")
    assert isinstance(outcome, Goals)
    assert isinstance(outcome.goals[0], Greet)


SAME = [
    # courtesies in the midst
    ("go, if you would, to the spa", "go to the spa"),
    ("put, please, the cap on the bar", "put the cap on the bar"),
    ("walk, if you please, two metres forward", "walk two metres forward"),
    # notes
    ("Need: cap, from the bar", "I need the cap from the bar"),
    ("caps x 4 to Olga", "4 caps to Olga"),
    ("small teapot, not the large one, to Hans", "small teapot to Hans"),
    ("upon which surface is the torch to be found?", "where is the torch?"),
    # little words of dialects and learners
    ("c'mon over here", "come over here"),
    ("all tools into the wardrobe, 'cept for the hammer",
     "all tools into the wardrobe, except for the hammer"),
    ("put all drinks on the bar, only the cola not", "put all drinks on the bar except the cola"),
    ("whit are ye carrying?", "what are you carrying?"),
    ("awa' and get me the cap", "get me the cap"),
    ("put the cap frae the bar intae the bin", "put the cap from the bar into the bin"),
    ("bring me the cola alone", "bring me the cola"),
    # roundabout, and what is only told before
    ("I should be obliged if you came to me", "come to me"),
    ("I would be grateful if you took the cap to Olga", "take the cap to Olga"),
    ("I was going to do it myself but anyway take the cap to Olga", "take the cap to Olga"),
    ("if by any chance there's a cap on the bar then yeah bring it here",
     "if there is a cap on the bar, bring it here"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), SAME)
def test_what_says_nothing_changes_nothing(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize("asked", ["Torch: location?", "The torch: whereabouts?", "torch: where?"])
def test_a_heading_is_asked_after(asked: str) -> None:
    outcome = heard(asked)
    assert isinstance(outcome, Goals)
    (goal,) = outcome.goals
    assert isinstance(goal, Find)
    assert goal.object is not None
    assert goal.object.name == "torch"


@pytest.mark.parametrize("said", ["I will do it myself", "leave the cap alone"])
def test_what_asks_for_nothing_still_does_not(said: str) -> None:
    assert isinstance(heard(said), Refusal)


def test_a_particle_of_another_sense_is_not_lost() -> None:
    outcome = heard("bring me the sweet tea and the grand menu")
    assert isinstance(outcome, Question | Refusal) or "grand" in (outcome.reason or "")
