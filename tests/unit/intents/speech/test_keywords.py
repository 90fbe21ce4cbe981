"""The network that spots words follows a stream, and what it is sure of counts at once."""

import numpy as np
import pytest

from intents.speech.audio import RATE_HZ
from intents.speech.filterbank import BANDS, Filterbank
from intents.speech.keywords import KEYWORDS, Keyword, Keywords
from intents.speech.network import DILATIONS, STRIDE, TAPS, Network
from intents.speech.spotting import ONCE_S, POSSIBLE, SURE, Spotter

CHANNELS = 8


def weights(seed=0):
    """A network that was taught nothing."""
    rng = np.random.default_rng(seed)
    shapes = {
        "enter": (STRIDE * BANDS, CHANNELS), "enter_bias": (CHANNELS,),
        "taps": (len(DILATIONS), TAPS, CHANNELS), "mix": (len(DILATIONS), CHANNELS, CHANNELS),
        "mix_bias": (len(DILATIONS), CHANNELS), "leave": (CHANNELS, 1 + len(KEYWORDS)),
        "leave_bias": (1 + len(KEYWORDS),),
    }  # fmt: skip
    return {name: rng.normal(size=shape).astype(np.float32) for name, shape in shapes.items()}


def noise(count, level=0.1):
    return (level * np.random.default_rng(1).normal(size=count)).astype(np.float32)


@pytest.mark.parametrize("block", [7, 160, 801, 5000])
def test_a_stream_is_the_same_however_it_is_cut(block):
    sound = noise(2 * RATE_HZ)
    bank, network = Filterbank(), Network(weights())
    pieces = [network.push(bank.push(sound[at : at + block])) for at in range(0, len(sound), block)]
    whole = Network(weights()).push(Filterbank().push(sound))
    assert np.concatenate(pieces) == pytest.approx(whole, abs=1e-3)


def test_the_network_does_not_look_ahead():
    bands = np.random.default_rng(2).normal(size=(120, BANDS)).astype(np.float32)
    later = bands.copy()
    later[60:] = 0.0
    one, other = Network(weights()).push(bands), Network(weights()).push(later)
    assert one[: 60 // STRIDE] == pytest.approx(other[: 60 // STRIDE])


def test_neither_level_nor_steady_noise_matter():
    quiet, loud = (Filterbank().push(noise(RATE_HZ, level)) for level in (0.01, 0.1))
    assert quiet == pytest.approx(loud, rel=0.1, abs=0.02)


def test_silence_is_no_word():
    told = Keywords(weights()).push(np.zeros(RATE_HZ, np.float32))
    assert all(np.isfinite(one.sure) for one in told)


class Sure:
    """Thinks what it is told of each block of 0.1 s."""

    def __init__(self, *told):
        self.told = list(told)
        self.now_s = 0.0
        self.last = 0.0

    def push(self, sound):
        self.now_s += len(sound) / RATE_HZ
        word, self.last = self.told.pop(0) if self.told else ("stop", 0.0)
        return [Keyword(word, word == "stop", self.last, self.now_s)]

    def likeliest(self):
        return self.last


class Writes:
    """Would find a cry to stop in anything."""

    def cried(self, sound):
        raise AssertionError("the decoder was asked")


def pushed(spotter, count):
    block = np.zeros(RATE_HZ // 10, np.float32)
    return [cry for _ in range(count) if (cry := spotter.push(block)) is not None]


def test_what_the_network_is_sure_of_counts_at_once_and_once():
    many = [("stop", 1.0)] * 5
    found = pushed(Spotter(Writes(), Sure(*many)), 10)
    assert [(cry.text, cry.stops) for cry in found] == [("stop", True)]
    assert found[0].end_s == pytest.approx(0.1)


def test_a_cry_to_stop_counts_right_after_one_to_halt():
    told = Sure(("wait", 1.0), ("stop", 1.0), ("wait", 1.0))
    assert [cry.text for cry in pushed(Spotter(Writes(), told), 3)] == ["wait", "stop"]


def test_what_is_cried_again_later_counts_again():
    told = [("wait", 1.0)] * (2 + round(10 * ONCE_S))
    assert len(pushed(Spotter(Writes(), Sure(*told)), len(told))) == 2


def test_where_the_network_thinks_of_no_cry_the_decoder_is_not_asked():
    spotter = Spotter(Writes(), Sure(("stop", POSSIBLE / 2)))
    assert pushed(spotter, 1) == []
    assert spotter.spotted(noise(RATE_HZ), 1.0, whole=True, paused=True) is None


def test_where_it_thinks_of_one_the_decoder_is_asked():
    spotter = Spotter(Writes(), Sure(("stop", (POSSIBLE + SURE) / 2)))
    assert pushed(spotter, 1) == []
    with pytest.raises(AssertionError, match="asked"):
        spotter.spotted(noise(RATE_HZ), 1.0, whole=True, paused=True)
