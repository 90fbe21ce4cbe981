"""Cries are spotted before anybody pauses, and talk is none."""

import numpy as np
import pytest

from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear
from intents.speech.recogniser import Heard
from intents.speech.spotting import Spotter, Written, cries

BLOCK = RATE_HZ // 20


def written(text, *, score=-5.0, gap=0.0, begin_s=0.2):
    """Words of 0.3 s each."""
    return [
        Written(word, begin_s + 0.3 * n, begin_s + 0.3 * n + 0.3, score, gap)
        for n, word in enumerate(text.split())
    ]


@pytest.mark.parametrize(
    "text",
    ["stop", "stop you will hit the table", "and then he said stop stop", "you have to stop now"],
)
def test_a_cry_to_stop_is_spotted_inside_a_sentence(text):
    assert [cry.stops for cry in cries(written(text), whole=True)][:1] == [True]


@pytest.mark.parametrize(
    "text",
    ["wait", "no leave it there", "careful you will drop it", "don't do that", "hold it", "enough"],
)
def test_a_cry_to_halt_is_spotted_at_the_beginning(text):
    found = cries(written(text), whole=True)
    assert found
    assert not found[0].stops


@pytest.mark.parametrize(
    "text",
    [
        "i don't know that", "we had to wait for the bus", "don't stop now", "there is no milk",
        "it was good enough for me", "hold the bottle for me", "wait ten seconds please",
        "the bus stop is there", "look at the table",
    ],
)  # fmt: skip
def test_talk_and_errands_are_no_cries(text):
    assert cries(written(text), whole=True) == []


def test_a_word_at_the_edge_may_be_half_of_another():
    cut = written("stop", begin_s=0.0)
    assert cries(cut, whole=False) == []
    assert cries(cut, whole=True) != []


@pytest.mark.parametrize(("score", "gap"), [(-9.0, 0.0), (-5.0, 3.0)])
def test_what_does_not_fit_is_no_cry(score, gap):
    assert cries(written("stop", score=score, gap=gap), whole=True) == []


class Told:
    """Writes what it is told, one text a time."""

    def __init__(self, *texts, heard=None):
        self.texts = list(texts)
        self.heard = heard or Heard(text="the weather is nice", doubt=1.5)

    def cried(self, sound):
        text = self.texts.pop(0) if len(self.texts) > 1 else self.texts[0]
        return written(text, begin_s=0.5)

    def recognise(self, sound, *, replying=False):
        return self.heard

    def learn(self):
        pass


def test_a_cry_counts_that_is_found_twice():
    spotter = Spotter(Told("stop", "stop", "go on"))
    sound = np.zeros(RATE_HZ, np.float32)
    how = {"whole": False, "paused": False}
    assert spotter.spotted(sound, 1.0, **how) is None
    cry = spotter.spotted(sound, 1.0, **how)
    assert cry is not None
    assert cry.stops
    assert cry.end_s == pytest.approx(1.8)
    assert spotter.spotted(sound, 1.0, **how) is None


def test_before_a_pause_once_is_enough():
    spotter = Spotter(Told("stop"))
    assert spotter.spotted(np.zeros(RATE_HZ, np.float32), 1.0, whole=True, paused=True)


def listened(told, *, at_work=True):
    """What an ear tells of four seconds of talk without a pause."""
    ear = Ear(told, spotter=Spotter(told))
    ear.at_work = at_work
    noise = np.random.default_rng(0).normal(size=6 * RATE_HZ)
    swing = 0.02 + 0.98 * np.abs(np.sin(np.pi * 3.0 * np.arange(len(noise)) / RATE_HZ))
    talk = 0.2 * noise * swing
    talk[:RATE_HZ], talk[5 * RATE_HZ :] = 1e-5, 1e-5
    found = []
    for at in range(0, len(talk), BLOCK):
        block = talk[at : at + BLOCK].astype(np.float32)
        found += [(at / RATE_HZ, one.kind, one.text) for one in ear.push(block)]
    return found


def test_a_stop_is_told_while_the_talk_goes_on():
    found = listened(Told("stop"))
    assert [kind for _, kind, _ in found] == ["stop"]
    assert found[0][0] < 3.0


def test_a_halt_comes_first_and_what_is_asked_after():
    found = listened(Told("wait"))
    assert [(kind, text) for _, kind, text in found] == [("halt", "wait"), ("halted", "wait")]
    assert found[0][0] < 3.0 < found[1][0]


@pytest.mark.parametrize(
    ("text", "end"),
    [
        ("wave", ("halted", "wait")),
        ("", ("halted", "wait")),
        ("wait go to the table", ("sentence", "wait go to the table")),
    ],
)
def test_after_a_halt_only_what_agrees_with_it_is_done(text, end):
    found = listened(Told("wait", heard=Heard(text=text)))
    assert [(kind, text) for _, kind, text in found] == [("halt", "wait"), end]


def test_nothing_is_spotted_of_a_robot_that_is_not_at_work():
    assert [kind for _, kind, _ in listened(Told("stop"), at_work=False)] == ["ignored"]
