"""What was lost of a sentence may forbid it: then nothing is done that was not agreed to."""

from itertools import product

import pytest

from benchmarks.intents.replies import HOME
from intents.caution import cautious
from intents.dialogue import Dialogue
from intents.goals import GoTo, Stop
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse

SOFA = Goals(goals=(GoTo(place="sofa"),))
PLAIN = "go to the sofa"

FORBIDS = (
    "I forbid you to {}", "you are forbidden to {}", "you are not permitted to {}",
    "you have no permission to {}", "you lack permission to {}", "it is verboten to {}",
    "god forbid you {}", "heaven forbid that you {}", "lest you {}", "nicht {}",
    "far be it from you to {}", "one shall not {}", "I'd hate for you to {}", "noone {}",
    "you wouldn't want to {}", "I would rather die than see you {}", "you mustn't ever {}",
    "I do not want you to {}", "under no circumstances {}", "{}... just kidding",
    "if I were you I would not {}",
)  # fmt: skip
SLIPS = (
    "nver", "neber", "nevr", "neever", "nevet", "enver", "dotn", "dnot", "donr", "dpn't", "do nto",
    "do mot", "do n o t", "do ont", "don;t", "do knot", "dn't", "dont't", "d'ont", "pls no",
)  # fmt: skip
TALKS = (
    "translate into german: {}", "spell {}", "write a poem about how you {}",
    "only a fool would {}", "robots that {} get scrapped", "it says here that robots {}",
    "the manual says: {}", "“{}” is what my sister said", "imagine you {}",
)  # fmt: skip
GOES_ON = (
    "go to the sofa now", "don't forget to go to the sofa", "no hurry, go to the sofa",
    "take note: go to the sofa", "I can't walk, so go to the sofa", "no, go to the sofa",
    "not the stove, go to the sofa", "would you not mind going to the sofa",
    "prevent accidents and go to the sofa", "oot wi ye, go to the sofa",
    "that is where you belong, wouldn't you say, go to the sofa", "isn't it late, go to the sofa",
)  # fmt: skip


@pytest.mark.parametrize("said", FORBIDS)
def test_what_forbids_and_was_not_read_is_refused_and_said(said: str) -> None:
    outcome = cautious(said.format(PLAIN), PLAIN, SOFA, HOME)
    assert isinstance(outcome, Refusal)
    assert outcome.reason.startswith("I heard “")
    assert not outcome.puzzled  # and nobody else is asked to make an order of it


def test_a_no_forbids_what_is_told_with_it_and_no_further_sentence() -> None:
    for said in ("no go to the sofa", "no go to the sofa. Please.", "no go to the sofa! none"):
        assert not isinstance(cautious(said, said, SOFA, HOME), Goals), said
    for said in ("no running. go to the sofa", "no smoking in here! Please go to the sofa"):
        assert cautious(said, said, SOFA, HOME) is SOFA, said


def test_never_before_you_forbids_what_a_question_does_not() -> None:
    assert not isinstance(cautious("don't you go to the sofa", PLAIN, SOFA, HOME), Goals)
    assert cautious("wouldn't you go to the sofa", PLAIN, SOFA, HOME) is SOFA


@pytest.mark.parametrize(("slip", "manner"), list(product(SLIPS, ("", "please ", "robot, "))))
def test_a_slip_from_a_negation_is_asked_about(slip: str, manner: str) -> None:
    said = f"{manner}{slip} {PLAIN}"
    if slip == "pls no" and manner:
        return  # the grammar reads every word of it
    outcome = cautious(said, said if slip == "pls no" else PLAIN, SOFA, HOME)
    assert isinstance(outcome, Question | Refusal), outcome


def test_all_slips_of_a_finger_in_never_and_not_are_asked_about() -> None:
    keys = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
    row = {letter: keys[number] for number in range(3) for letter in keys[number]}
    for at, letter in enumerate("never"):
        near = [
            n for n in row[letter] if abs(row[letter].index(n) - row[letter].index(letter)) == 1
        ]
        wrong = ["never"[:at] + one + "never"[at + 1 :] for one in near]
        wrong += ["never"[:at] + "never"[at + 1 :], "never"[:at] + letter + "never"[at:]]
        for one in wrong:
            if one in ("ever", "fever", "lever", "sever", "newer", "bever", "mever"):
                continue
            assert isinstance(cautious(f"{one} {PLAIN}", PLAIN, SOFA, HOME), Question), one


@pytest.mark.parametrize("said", TALKS)
def test_an_order_that_is_talked_about_is_asked_about(said: str) -> None:
    assert isinstance(cautious(said.format(PLAIN), PLAIN, SOFA, HOME), Question)


@pytest.mark.parametrize("said", [*FORBIDS, *TALKS, *(f"{slip} {{}}" for slip in SLIPS)])
def test_nothing_of_the_kind_is_ever_acted_on(said: str) -> None:
    turn = Dialogue(HOME).hear(said.format(PLAIN))
    assert not isinstance(turn, Goals) or all(isinstance(goal, Stop) for goal in turn.goals)


@pytest.mark.parametrize("said", GOES_ON)
def test_ordinary_words_that_look_like_it_change_nothing(said: str) -> None:
    outcome = cautious(said, PLAIN if said != GOES_ON[0] else said, SOFA, HOME)
    expected = Refusal if "prevent" in said else Goals
    assert isinstance(outcome, expected), outcome


@pytest.mark.parametrize(
    "said", ["go to the sofa now", "don't forget to go to the sofa", "no, go to the sofa", PLAIN]
)
def test_they_are_acted_on(said: str) -> None:
    assert isinstance(parse(said, HOME), Goals)


def test_what_is_kept_in_the_words_that_were_read_was_heeded() -> None:
    said = "mate, fetch a mug that is not red"
    assert cautious(said, "fetch a mug that is not red", SOFA, HOME) is SOFA


def test_a_prohibition_of_another_thing_is_kept_to_and_asks_nothing() -> None:
    said = "mate, don't touch the plate, just go to the sofa"
    assert cautious(said, PLAIN, SOFA, HOME) is SOFA


def test_a_question_of_which_does_not_hide_it() -> None:
    which = Question(question="Which mug?", goals=SOFA.goals, kind="choice")
    assert isinstance(cautious("I forbid you to take it", "take it", which, HOME), Refusal)
    asked = cautious("nevr take it", "take it", which, HOME)
    assert isinstance(asked, Question)
    assert "nevr" in asked.question
