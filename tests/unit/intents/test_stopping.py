"""Cries to stop: none is missed, whatever it looks like, and none takes long."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.stopping import is_stay, is_stop
from tests.fakes.machine import in_paces

CRIES = (
    "stop", "STOP!", "Stop!!! Stop!!!", "stpo", "sotp", "stopp", "STOOOOP", "s t o p", "S.T.O.P",
    "ＳＴＯＰ", "st\u00f3p", "halt", "Halt!", "haaalt", "freeze", "freez", "frezze", "emergency",
    "emergancy", "e-stop", "arrête", "arretez-vous", "¡alto!", "fermati", "стоп", "стой",
    "停", "ストップ", "stopp jetzt", "don't move", "whoa", "for heaven's sake, stop",
    "would you please stop", "you have to stop right now", "I said stop", "can you stop",
    "bring me the mug. no, stop", "bring me the old green mug no stop now",
    "robot would you just stop moving already, thank you",
)  # fmt: skip
OTHERS = (
    "", "step back", "go to the shop", "take the top one", "put it on the stove", "freezer",
    "stop by the garage", "why did you stop?", "when did you stop", "don't stop",
    "go to the bus stop", "walk to the sofa, then stop", "walk until I say stop", "pick up a stool",
)  # fmt: skip


@pytest.mark.parametrize("cry", CRIES)
def test_cries_are_heard(cry: str) -> None:
    assert is_stop(cry)


@pytest.mark.parametrize("text", OTHERS)
def test_other_words_are_not_cries(text: str) -> None:
    assert not is_stop(text)


@given(
    st.sampled_from(["stop", "halt", "freeze"]),
    st.sampled_from(["", "!", "!!!", "...", "?!"]),
    st.sampled_from([str.lower, str.upper, str.title]),
    st.text(" \t\n", max_size=4),
)
def test_case_signs_and_blanks_do_not_matter(word: str, sign: str, case, blanks: str) -> None:  # type: ignore[no-untyped-def]
    assert is_stop(blanks + case(word) + sign + blanks)


@given(st.text(max_size=300), st.sampled_from([". stop", "! Halt", "\nSTOP!!"]))
def test_a_cry_of_its_own_at_the_end_is_heard(before: str, cry: str) -> None:
    assert is_stop(before + cry)


@pytest.mark.parametrize(
    "text",
    ["x" * 100_000, "please " * 20_000, "a, " * 50_000, "\u0301" * 100_000, "stop " * 20_000],
    ids=lambda t: ascii(t[:6]),
)
def test_no_text_takes_long(text: str) -> None:
    assert in_paces(lambda: is_stop(text)) < 40  # what grows with the square takes thousands


HIDDEN = (
    "st\u200bop", "s\u00adtop", "st\u200dop", "\ufeffstop", "s\u2060t\u2061o\u2062p", "st\u202eop",
    "st\ufe0fop", "st\u034fop", "st\u3164op", "s\u0323\u0307t\u20ddop", "st\0op", "st\x9bop",
    "ѕtop", "ѕтор", "ѕτορ", "hаlt", "ꜱᴛᴏᴘ", "ſtop", "ⓢⓣⓞⓟ", "🅢🅣🅞🅟", "🆂🆃🅾🅿", "🇸🇹🇴🇵", "𝐬𝐭𝐨𝐩",
    "🅂🅃🄾🄿", "st op", "s-t.op", "🛑", "st" + "\u200b" * 1500 + "op", "don\u200b't move",
    "bring the cup st\u200bop now", "\x1b[31mstop\x1b[0m", "\x9b0mstop\x9b0m", "st\x1b[1mop",
    "\x1b]0;stop\x07", "\x1b]8;;http://x\x1b\\stop\x1b]8;;\x1b\\", "\x1b]0;stop", "\x1bOstop",
)  # fmt: skip
GLUED = ("asdfstop", "[31mstop", "walk to thestop", "stopstop", "stopnow")


@pytest.mark.parametrize("cry", HIDDEN)
def test_letters_that_are_unseen_or_look_alike_hide_no_cry(cry: str) -> None:
    assert is_stop(cry)


@given(
    st.sampled_from(["stop", "halt", "freeze", "стоп", "detente"]),
    st.lists(st.sampled_from("\u00ad\u200b\u200c\u200d\u200e\u202e\u2060\ufeff\ufe0f\u0336\0")),
    st.randoms(),
)
def test_whatever_is_unseen_hides_no_cry(word: str, unseen: list[str], random) -> None:  # type: ignore[no-untyped-def]
    for one in unseen:
        at = random.randint(0, len(word))
        word = word[:at] + one + word[at:]
    assert is_stop(word)


@pytest.mark.parametrize("cry", GLUED)
def test_a_cry_that_runs_into_other_words_is_heard(cry: str) -> None:
    assert is_stop(cry)


@pytest.mark.parametrize(
    "text",
    ["nonstop", "pick up the doorstop", "don\u200bt stop", "тор", "the asphalt", "antifreeze",
     "чашка на стол"],
)  # fmt: skip
def test_names_that_end_like_a_cry_are_none(text: str) -> None:
    assert not is_stop(text)


@pytest.mark.parametrize(
    "text",
    ["stand still", "Stand still!", "please stand still now", "no, stay there",
     "stay where you are",
     "hold still, robot", "stay put", "stand stil", "st\u200band still", "stay right there please",
     "robot, stay", "ok, stay here, thanks", "don't walk"],
)  # fmt: skip
def test_wishes_to_stay_are_told(text: str) -> None:
    assert is_stay(text)
    assert not is_stop(text)  # to a robot that stands it is a task


@pytest.mark.parametrize(
    "text",
    ["", "stand", "stand up", "stand still for 5 seconds", "go to the table, stay there",
     "stay there until I am back", "stay with me", "then stay there and wave", "stand on one leg",
     "wait", "do you stand still?", "stay " * 10_000, "please", "now"],
)  # fmt: skip
def test_tasks_and_questions_are_no_wishes_to_stay(text: str) -> None:
    assert not is_stay(text)


UNMARKED = (
    "what are you doing stop", "what the hell stop", "are you crazy stop", "are you deaf stop now",
    "did you hear me stop", "can you not hear me stop please", "why are you still moving stop",
    "how many times do I have to say stop", "I say STOP!", "I say stop", "I would like you to stop",
    "we need you to stop", "the robot is about to hit the child please make it stop right now",
    "walk to the door and stop!", "abort abort", "ABORT! abort!", "cut the power", "motors off",
    "kill the motors now", "turn the motors off", "please shut off the power", "shutdown",
    "dnt move", "donot move", "don;t move", "do nt move", "get off me", "✋", "⛔", "⛔ no",
    "atop!", "stoop!",
)  # fmt: skip
ORDINARY = (
    "why did you stop", "what makes you stop", "how do you stop", "how can I stop",
    "where is the bus stop", "where does the bus stop", "when will you stop",
    "who told you to stop",
    "are you going to stop", "what is a full stop", "what should I say to make you stop",
    "how do I make it stop", "do not make it stop", "what happens if I say stop",
    "I don't want you to stop", "unstoppable", "put it atop the shelf",
    "stoop down", "the salt", "halo", "hold the hat", "cut the power cable", "cut the bread",
    "switch the lights off", "why are the motors off", "what does shutdown mean", "high five ✋",
    "take the spot", "go to the sofa and then stop", "how does the train stop",
)  # fmt: skip


@pytest.mark.parametrize("cry", UNMARKED)
@pytest.mark.parametrize("at_rest", [False, True])
def test_cries_without_a_sign_before_them_or_in_other_words_are_heard(
    cry: str, at_rest: bool
) -> None:
    assert is_stop(cry, at_rest=at_rest)


@pytest.mark.parametrize("text", ORDINARY)
def test_what_only_speaks_of_stopping_is_none(text: str) -> None:
    assert not is_stop(text)


def test_and_stop_at_the_end_is_a_cry_to_a_robot_on_its_way_only() -> None:
    assert is_stop("go to the sofa and stop")
    assert not is_stop("go to the sofa and stop", at_rest=True)


KEYS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")


@given(
    st.sampled_from(["stop", "halt", "freeze"]),
    st.integers(0, 5),
    st.sampled_from(["beside", "swapped", "doubled"]),
    st.integers(0, 1),
    st.sampled_from(["", "!", " now", " please"]),
)
def test_slips_of_the_fingers_are_heard(
    word: str, at: int, slip: str, side: int, after: str
) -> None:
    at %= len(word)
    keys = next(row for row in KEYS if word[at] in row)
    left, _, right = keys.partition(word[at])
    near = (left[-1:], right[:1])[side]
    if slip == "beside":
        said = word[:at] + (near or word[at]) + word[at + 1 :]
    elif slip == "swapped":
        said = word[:at] + word[at : at + 2][::-1] + word[at + 2 :]
    else:
        said = word[: at + 1] + word[at:]
    own = said in ("atop", "stoop") and after != "!"  # words of English
    assert own or is_stop(said + after), said
