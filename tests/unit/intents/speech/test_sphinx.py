"""The embedded recogniser on recordings of a synthetic voice, clean and in noise."""

from pathlib import Path

import numpy as np
import pytest

from intents.outcomes import Goals
from intents.parser import parse
from intents.speech import wav
from intents.speech.audio import RATE_HZ
from intents.speech.frontend import LEVEL, prepared
from intents.speech.rejection import Fit, doubt_of_command, doubt_of_free
from intents.speech.sphinx import Sphinx
from intents.stopping import is_stop
from intents.vocabulary import Spot, Thing, Vocabulary

SOUNDS = Path(__file__).parent / "sounds"
KITCHEN = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="cup", color="blue"), "bottle", "box"],
    places=["table", Spot(name="counter", synonyms=("worktop",)), "shelf", "cabinet"],
    rooms=["kitchen"],
    people=["Priya"],
)


@pytest.fixture(scope="module")
def recogniser():
    return Sphinx(KITCHEN)


def sound(name):
    return np.concatenate(list(wav.blocks(SOUNDS / f"{name}.wav")))


def in_noise(spoken, snr_db, *, seed=0):
    level = np.sqrt(np.mean(spoken**2)) * 10 ** (-snr_db / 20)
    around = np.pad(spoken, RATE_HZ // 4)
    noise = np.random.default_rng(seed).normal(scale=level, size=len(around))
    return (around + noise).astype(np.float32)


@pytest.mark.parametrize("snr_db", [60, 20])
def test_a_command_is_understood(recogniser, snr_db):
    heard = recogniser.recognise(in_noise(sound("command"), snr_db))
    assert heard.believed
    meant = "pick up the red cup and put it on the shelf"
    assert parse(heard.text, KITCHEN).goals == parse(meant, KITCHEN).goals


@pytest.mark.parametrize("change", ["quiet", "loud and clipped", "offset", "short", "long pauses"])
def test_a_command_is_understood_however_it_was_recorded(recogniser, change):
    spoken = in_noise(sound("command"), 40)
    spoken = {
        "quiet": 0.01 * spoken,
        "loud and clipped": np.clip(4 * spoken / np.abs(spoken).max(), -1, 1),
        "offset": 0.5 * spoken + 0.4,
        "short": spoken[RATE_HZ // 4 : -RATE_HZ // 4],
        "long pauses": np.pad(spoken, 2 * RATE_HZ),
    }[change].astype(np.float32)
    assert "red cup" in recogniser.recognise(spoken).text


@pytest.mark.parametrize("snr_db", [60, 20, 15])
def test_stop_is_heard(recogniser, snr_db):
    assert is_stop(recogniser.recognise(in_noise(sound("stop"), snr_db)).text)


@pytest.mark.parametrize("snr_db", [60, 20])
def test_other_speech_is_not_believed(recogniser, snr_db):
    heard = recogniser.recognise(in_noise(sound("other"), snr_db))
    assert not heard.believed
    assert not is_stop(heard.text)


def test_an_answer_is_heard_only_as_an_answer(recogniser):
    answer = in_noise(sound("yes"), 40)
    heard = recogniser.recognise(answer, replying=True)
    assert heard.text.startswith("yes")
    assert heard.believed
    assert not isinstance(parse(recogniser.recognise(answer).text, KITCHEN), Goals)


def test_the_same_sound_gives_the_same_words(recogniser):
    spoken = in_noise(sound("command"), 15)
    first = recogniser.recognise(spoken)
    recogniser.recognise(in_noise(sound("other"), 20))
    second = recogniser.recognise(spoken)
    assert (first.text, first.doubt) == (second.text, second.doubt)


@pytest.mark.parametrize(
    "nothing",
    [np.zeros(0), np.zeros(10), np.zeros(RATE_HZ), np.full(RATE_HZ, 0.7), np.ones(1)],
    ids=["empty", "ten samples", "silence", "an offset", "one sample"],
)
def test_nothing_is_nothing(recogniser, nothing):
    heard = recogniser.recognise(nothing.astype(np.float32))
    assert not heard.believed


def test_a_voice_is_got_used_to_by_commands_only():
    recogniser = Sphinx(KITCHEN)
    recogniser.recognise(in_noise(sound("command"), 40))
    assert recogniser.speakers == ()
    recogniser.learn()
    (known,) = recogniser.speakers
    assert known.frames > 50
    recogniser.learn()
    recogniser.recognise(np.zeros(0, np.float32))
    recogniser.learn()
    assert recogniser.speakers == (known,)


def higher(spoken, factor):
    """The same, said faster by a shorter speaker."""
    at = np.arange(0, len(spoken) - 1, factor)
    return np.interp(at, np.arange(len(spoken)), spoken).astype(np.float32)


@pytest.mark.rest
def test_voices_are_told_apart():
    recogniser = Sphinx(KITCHEN)
    for _ in range(2):
        for factor in (1.0, 1.2):
            recogniser.recognise(in_noise(higher(sound("command"), factor), 40))
            recogniser.learn()
    high, low = recogniser.speakers
    for factor, speaker in [(1.0, low), (1.2, high)]:
        for name in ("command", "other"):
            recogniser.recognise(in_noise(higher(sound(name), factor), 40))
            recogniser.learn()
            assert recogniser.speakers[0].frames > speaker.frames
            recogniser.speakers = (high, low)


@pytest.mark.rest
def test_a_command_of_a_known_voice_fits_better():
    recogniser = Sphinx(KITCHEN)
    spoken, doubts = in_noise(sound("command"), 30), []
    for _ in range(3):
        heard = recogniser.recognise(spoken)
        recogniser.learn()
        doubts.append(heard.doubt)
    assert heard.believed
    assert doubts[-1] <= doubts[0]


def test_noise_moves_nothing(recogniser):
    noise = np.random.default_rng(0).normal(scale=0.1, size=2 * RATE_HZ).astype(np.float32)
    heard = recogniser.recognise(noise)
    assert not heard.believed or is_stop(heard.text)


def test_the_wake_word_is_recognised_with_the_rest(recogniser):
    called = Sphinx(KITCHEN, wake_word="juno")
    assert "red cup" in called.recognise(in_noise(sound("command"), 40)).text


def test_a_word_is_known_as_others_say_it():
    bowls = Vocabulary.of(objects=["bowl", "fishbowl"], places=["table"], rooms=[], people=[])
    decoder = Sphinx(bowls)._decoder._decoder
    for word in ("bowl", "fishbowl", "bowls"):
        spoken, number = [decoder.lookup_word(word)], 1
        while spoken[-1] is not None:
            number += 1
            spoken.append(decoder.lookup_word(f"{word}({number})"))
        assert len(set(spoken)) == len(spoken)
        assert any("AH UH L" in one for one in spoken if one)


# --- its parts -----------------------------------------------------------------------------------


def test_the_frontend_cuts_levels_and_never_overflows():
    spoken = np.pad(sound("command"), RATE_HZ)
    data = np.frombuffer(prepared((20 * spoken).astype(np.float32)), "<i2") / 32_768
    assert len(data) < len(spoken) - RATE_HZ
    assert np.sqrt(np.mean(data**2)) == pytest.approx(LEVEL, rel=0.3)
    assert prepared(np.zeros(RATE_HZ, np.float32)) == b""


def fit(score=-5.0, frames=30, chance=-0.5, power=0.33):
    return Fit(word="cup", frames=frames, score=score * frames, chance=chance, power=power)


@pytest.mark.parametrize("doubt", [doubt_of_command, doubt_of_free])
def test_doubt_grows_as_words_fit_worse(doubt):
    others = [fit(score=-4)] * 3
    doubts = [
        doubt([fit(score=-4), fit(score=score), fit(score=-4)], others, agree=False)
        for score in (-3, -4, -6, -8, -12, -100)
    ]
    assert doubts == sorted(doubts)
    assert doubts[0] < 1.0 < doubts[-1] <= 2.0


def test_a_command_is_doubtful_where_free_words_fit_far_better():
    free = [fit(score=score) for score in (-4, -3, -2, -1)]
    doubts = [doubt_of_command([fit(score=-4)], [one], agree=False) for one in free]
    assert doubts == sorted(doubts)
    assert doubts[0] < doubts[-1]


def test_what_both_mean_is_less_doubtful():
    one = [fit(score=-4)]
    assert doubt_of_free(one, one, agree=True) < doubt_of_free(one, one, agree=False)


def test_doubt_grows_with_what_no_word_accounts_for():
    doubts = [
        doubt_of_command([fit(score=-4, power=power)] * 3, [fit(score=-4)] * 3, agree=False)
        for power in (0.33, 0.3, 0.25, 0.05)
    ]
    assert doubts == sorted(doubts)
    assert doubts[0] < 1.0 < doubts[-1]


def test_a_pause_between_words_makes_nothing_doubtful(recogniser):
    spoken = sound("command")
    middle = len(spoken) // 2 + int(np.abs(spoken[len(spoken) // 2 :][:8000]).argmin())
    halves = [in_noise(half, 40) for half in (spoken[:middle], spoken[middle:])]
    assert recogniser.recognise(np.concatenate(halves)).doubt < 1.0
