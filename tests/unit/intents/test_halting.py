"""Cries that a robot at work halts for: any that says wait, no, careful, and no errand."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents import halting
from intents.cries import HALTS, STOPS
from intents.goals import Stop
from intents.halting import besides, is_halt, is_insistent
from intents.letters import bare
from intents.outcomes import Goals
from intents.stopping import is_stay, is_stop
from tests.fakes.machine import in_paces
from tests.unit.intents.hotel_words import heard

CRIES = (
    "wait", "wait a minute, that's mine", "wait I forgot something", "wait for me", "hold it",
    "hold on!", "hold on a second", "hang on", "one moment", "just a second please", "hold up",
    "hold on hold on", "hang on hang on please",
    "easy!", "easy now", "slow down", "not so fast", "too close", "timeout",
    "no", "no no", "nooo", "no, not there", "no not the red one", "no that's wrong", "no way",
    "don't", "don't do that", "dont touch it", "do not go in there", "you can't go in there",
    "not that", "not like that", "not now", "that's wrong", "that's not what I meant", "wrong one",
    "enough", "that's enough now", "no more", "quit it", "never mind", "abort mission", "let go",
    "careful!", "be careful with that", "careful, the glass is going to fall", "watch out",
    "look out!", "watch your step", "mind the cat!", "watch the vase", "behind you!", "back off",
    "stay away from the baby", "get back", "you're going to fall!", "the lamp is about to tip over",
    "you're dropping it", "there's a child in front of you", "ouch", "oh no", "help!", "danger",
    "gently does it", "you've got the wrong one", "that hurts", "you're stepping on my foot",
    "watch where you're going", "the dog is right there", "I changed my mind", "nobody move",
    "stay right where you are", "ruko bhai", "espere um pouco", "pas si vite", "un momento",
    "wiat", "carefull", "enogh", "Juno, wait", "juno wait", "hey robot, careful",
)  # fmt: skip
ERRANDS = (
    "hold the cup", "hold the tray with both hands", "hold out your hand", "hold hands with me",
    "wait for me at the door", "wait in the kitchen", "wait ten seconds",
    "wait five seconds and then go to the table", "no rush, bring me the book",
    "not far from the table there is a ball, bring it", "stop over at the counter and wave",
    "no problem, take the green one", "no cups on the shelf, look on the table",
    "don't forget the box", "don't worry", "don't stop", "never stop", "not bad", "not at all",
    "watch me", "look out of the window", "watch over the baby", "stay in the kitchen",
    "carefully carry the glass to the table", "walk carefully to the door", "take it easy",
    "bring enough plates for four", "is there enough milk?", "that's not enough, bring two more",
    "a second cup please", "one cup please", "a bit more", "a bit further",
    "drop the ball in the box", "leave the cup on the table", "leave the kitchen",
    "turn off the lamp", "shut the door", "get back to the kitchen", "cancel the alarm clock",
    "pick up the pause button", "go to the table", "bring me the matte paint",
    "bring the para cord", "pare the apple", "help me", "and the blue one?", "the blue one", "yes",
    "go on", "continue", "", "...", "you could walk to the table", "it is on the table",
    "wait" + " and see" * 100,
)  # fmt: skip


@pytest.mark.parametrize("cry", CRIES)
def test_a_cry_halts(cry: str) -> None:
    assert is_halt(cry) or is_stop(cry) or is_stay(cry)


@pytest.mark.parametrize("text", ERRANDS)
def test_an_errand_does_not(text: str) -> None:
    assert not is_halt(text)
    assert not is_stop(text)


@given(
    st.sampled_from(["", "hey ", "robot, ", "oh ", "Please ", "ok "]),
    st.sampled_from(["wait", "careful", "hold on", "don't", "no", "not that", "watch out", "easy"]),
    st.sampled_from(["", "!", "!!!", "...", " please", " robot!", ", I said"]),
    st.sampled_from([str.lower, str.upper, str.title]),
)
def test_address_signs_and_case_do_not_matter(before: str, cry: str, after: str, case) -> None:  # type: ignore[no-untyped-def]
    assert is_halt(case(before + cry + after))


@pytest.mark.parametrize("language", STOPS)
def test_every_language_has_its_cries(language: str) -> None:
    for cry in STOPS[language].split(","):
        assert is_stop(cry), cry
        assert is_stop(f"{bare(cry)}!"), cry
    for cry in HALTS[language].split(","):
        assert is_halt(cry) or is_stop(cry), cry


def test_there_are_more_than_twenty_languages() -> None:
    assert STOPS.keys() == HALTS.keys()
    assert len(STOPS) > 20


@pytest.mark.parametrize("word", ["para", "pare", "dur", "vent", "bas", "matte", "alt", "dung"])
def test_a_word_of_another_language_is_itself_in_a_sentence(word: str) -> None:
    for text in (f"bring me the {word}", f"put the {word} on the shelf", f"is the {word} there?"):
        assert not is_stop(text)
        assert not is_halt(text)


@pytest.mark.parametrize(
    ("cry", "rest"),
    [
        ("wait", ""),
        ("no no no", ""),
        ("no, not there", ""),
        ("careful, the glass is going to fall", ""),
        ("no, the blue one", "the blue one"),
        ("no the blue one", "the blue one"),
        ("don't go to the kitchen, go to the hall", "go to the hall"),
        ("wait, the hall", "the hall"),
    ],
)
def test_what_a_cry_says_besides_is_told(cry: str, rest: str) -> None:
    assert is_halt(cry)
    assert besides(cry) == rest


INSISTENT = (
    "easy, easy, that's far enough!", "enough, thank you, not another step", "haud yer horses!",
    "ahhh no no no dont!!", "wait wait wait", "not another inch", "no further!", "nae further!",
    "steady on, steady!", "that's quite close enough", "hold your horses",
    "careful careful careful",
    "time out time out", "hud on, hud on", "back up, back up!", "not one step more", "no no no!",
)  # fmt: skip


@pytest.mark.parametrize("cry", INSISTENT)
def test_who_cries_insistently_is_heard_by_who_stands_as_well(cry: str) -> None:
    assert is_insistent(cry)


@pytest.mark.parametrize(
    "cry",
    ["easy, easy, that's far enough!", "haud yer horses!", "wait wait wait", "no no no no!",
     "enough, thank you, not another step", "not another inch", "steady, steady on!"],
)  # fmt: skip
def test_a_cry_of_which_nothing_else_is_made_is_a_stop(cry: str) -> None:
    outcome = heard(cry)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Stop(),)


@pytest.mark.parametrize("text", (*ERRANDS, "no! the blue one", "no, on the table", "wait", "no"))
def test_no_errand_is_cried(text: str) -> None:
    assert not is_insistent(text)


@pytest.mark.parametrize("said", ["don't touch the scarf!", "wait ten seconds", "wait, then wave"])
def test_an_order_is_no_cry(said: str) -> None:
    outcome = heard(said)
    assert not isinstance(outcome, Goals) or Stop() not in outcome.goals


@given(st.text(max_size=400))
def test_any_text_is_taken(text: str) -> None:
    besides(text)
    assert is_halt(text) in (True, False)


@pytest.mark.parametrize(
    "text", ["it is " * 40, "the a b going to " * 14, "a, " * 80, "停" * 240, "no " * 100_000]
)
def test_no_text_takes_long(text: str) -> None:
    assert in_paces(lambda: is_halt(text)) < 10


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("the red one, and dont drop it", "the red one"),
        ("go on, careful, don’t spill it", "go on"),
        ("take it without breaking it", "take it"),
        ("dont go to the table", "dont go to the table"),
        ("drop it", "drop it"),
    ],
)
def test_what_it_is_to_take_care_of_is_told_from_the_rest(text, left):
    assert halting.without_care(text) == left
