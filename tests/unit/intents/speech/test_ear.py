"""What is heeded, what is passed over, and when."""

import numpy as np
import pytest

from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear
from intents.speech.recogniser import Heard

BLOCK = RATE_HZ // 20


class Told:
    """A recogniser that is told what it hears, an utterance after the other."""

    def __init__(self, *heard):
        self.heard = [Heard(text=one) if isinstance(one, str) else one for one in heard]
        self.asked = []
        self.learnt = 0

    def learn(self):
        self.learnt += 1

    def recognise(self, sound, *, replying=False):
        self.asked.append((len(sound) / RATE_HZ, replying))
        return self.heard[0] if len(self.heard) == 1 else self.heard.pop(0)


def burst(duration_s, seed=0):
    return (0.3 * np.random.default_rng(seed).normal(size=round(duration_s * RATE_HZ))).astype(
        np.float32
    )


def quiet(duration_s):
    return np.full(round(duration_s * RATE_HZ), 1e-5, np.float32)


def listened(ear, *parts, speaking=lambda t_s: False, heeded=lambda t_s: True):
    stream, found = np.concatenate(parts), []
    for at in range(0, len(stream), BLOCK):
        t_s = at / RATE_HZ
        for one in ear.push(stream[at : at + BLOCK], speaking=speaking(t_s), heeded=heeded(t_s)):
            found.append((t_s, one))
    return found + [(len(stream) / RATE_HZ, one) for one in ear.finish()]


def kinds(found):
    return [(one.kind, one.text) for _, one in found]


def test_a_sentence_is_told_once_when_it_has_ended():
    recogniser = Told("go to the table")
    found = listened(Ear(recogniser), quiet(1), burst(1), quiet(1))
    assert kinds(found) == [("sentence", "go to the table")]
    assert found[0][0] == pytest.approx(2.6, abs=0.15)
    assert len(recogniser.asked) == 1  # what was heard at the pause is what was said in all


def test_words_after_a_pause_belong_to_the_sentence():
    recogniser = Told("put it", "put it on the table")
    found = listened(Ear(recogniser), quiet(1), burst(1), quiet(0.4), burst(1), quiet(1))
    assert kinds(found) == [("sentence", "put it on the table")]


def test_a_cry_to_stop_does_not_wait_for_the_end():
    found = listened(Ear(Told("stop")), quiet(1), burst(0.5), quiet(1))
    assert kinds(found) == [("stop", "stop")]
    assert found[0][0] - 1.5 < 0.3


def test_a_cry_to_stop_is_heeded_however_doubtful():
    ear = Ear(Told(Heard(text="robot stop", doubt=5.0)), wake_word="juno")
    assert kinds(listened(ear, quiet(1), burst(0.5), quiet(1))) == [("stop", "robot stop")]


@pytest.mark.parametrize("how", ["speaking", "heeded"])
def test_a_cry_to_stop_is_heeded_while_the_robot_speaks_and_without_the_key(how):
    ear, always = Ear(Told("stop")), {how: lambda t_s: how == "speaking"}
    assert kinds(listened(ear, quiet(1), burst(0.5), quiet(1), **always)) == [("stop", "stop")]


def test_what_is_said_in_one_breath_after_a_cry_is_passed_over():
    found = listened(Ear(Told("stop", "bring me the cup")), quiet(1), burst(0.5), quiet(0.3),
                     burst(1), quiet(1))  # fmt: skip
    assert kinds(found) == [("stop", "stop")]


def test_it_does_not_hear_itself():
    ear = Ear(Told("go to the table"))
    found = listened(ear, quiet(1), burst(1), quiet(1), speaking=lambda t_s: 0.9 < t_s < 2.0)
    assert [one.kind for _, one in found] == ["ignored"]


def test_the_room_still_sounds_after_it_has_spoken():
    ear = Ear(Told("go to the table"))
    parts = quiet(1), burst(0.5), quiet(1), burst(1, seed=1), quiet(1)
    found = listened(ear, *parts, speaking=lambda t_s: t_s < 0.85)
    assert [one.kind for _, one in found] == ["ignored", "sentence"]


def test_what_it_has_just_said_is_no_command():
    ear = Ear(Told("go to the table"))
    ear.said("I shall go to the table; that is what I heard. Shall I?")
    parts = quiet(1), burst(1), quiet(1)
    assert [one.kind for _, one in listened(ear, *parts)] == ["ignored"]
    listened(ear, quiet(8))
    assert [one.kind for _, one in listened(ear, *parts)] == ["sentence"]


def test_one_word_that_it_said_may_be_the_answer():
    ear = Ear(Told("yes"))
    ear.said("Say yes or no.")
    ear.replying = True
    assert kinds(listened(ear, quiet(1), burst(0.4), quiet(1))) == [("sentence", "yes")]
    assert ear._recogniser.asked[0][1] is True


@pytest.mark.parametrize("heard", [Heard(text=""), Heard(text="go there", doubt=1.0)])
def test_what_is_not_believed_is_passed_over(heard):
    found = listened(Ear(Told(heard)), quiet(1), burst(1), quiet(1))
    assert [one.kind for _, one in found] == ["ignored"]
    assert found[0][1].why


@pytest.mark.parametrize(
    ("texts", "kinds_"),
    [
        (["juno go to the table"], [("sentence", "go to the table")]),
        (["Juno, go to the table."], [("sentence", "go to the table")]),
        (["go to the table"], [("ignored", "go to the table")]),
        (["juno", "go to the table"], [("ignored", "juno"), ("sentence", "go to the table")]),
    ],
)
def test_the_wake_word_comes_first(texts, kinds_):
    parts = [quiet(1)]
    for number in range(len(texts)):
        parts += [burst(0.8, seed=number), quiet(1.5)]
    assert kinds(listened(Ear(Told(*texts), wake_word="Juno"), *parts)) == kinds_


def test_being_called_lasts_for_seconds_only():
    ear = Ear(Told("juno", "go to the table"), wake_word="juno")
    found = listened(ear, quiet(1), burst(0.5), quiet(8), burst(1), quiet(1))
    assert [one.kind for _, one in found] == ["ignored", "ignored"]


def test_without_the_key_nothing_but_stop_counts():
    ear = Ear(Told("go to the table"))
    found = listened(ear, quiet(1), burst(1), quiet(1), heeded=lambda t_s: False)
    assert [one.kind for _, one in found] == ["ignored"]


def test_a_voice_is_learnt_from_what_is_meant_for_the_robot():
    doubtful = Heard(text="go to the table", doubt=1.5)
    for heard, learnt in [("go to the table", 1), ("stop", 0), ("", 0), (doubtful, 0)]:
        told = Told(heard)
        listened(Ear(told), quiet(1.0), burst(1.0), quiet(2.0))
        assert told.learnt == learnt
