"""Speech is found where it is, whatever the background, and silence is not."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from intents.speech import wav
from intents.speech.audio import RATE_HZ
from intents.speech.endpointing import Endpointer, Endpoints

SOUNDS = Path(__file__).parent / "sounds"


def speech(name="command"):
    return np.concatenate(list(wav.blocks(SOUNDS / f"{name}.wav")))


def silence(duration_s):
    return np.zeros(round(duration_s * RATE_HZ), np.float32)


def noisy(sound, snr_db, *, seed=0, kind="white"):
    level = np.sqrt(np.mean(speech() ** 2)) * 10 ** (-snr_db / 20)
    noise = np.random.default_rng(seed).normal(size=len(sound))
    if kind == "rumble":
        spectrum = np.fft.rfft(noise) / np.maximum(np.fft.rfftfreq(len(noise), 1 / RATE_HZ), 20)
        noise = np.fft.irfft(spectrum, len(sound))
        noise /= noise.std()
    return (sound + level * noise).astype(np.float32)


def ended(sound, *, block=800, endpoints=None):
    endpointer, found = Endpointer(endpoints), []
    for at in range(0, len(sound), block):
        found += [one for one in endpointer.push(sound[at : at + block]) if one.ended]
    last = endpointer.flush()
    return found + ([last] if last else [])


@pytest.mark.parametrize("snr_db", [60, 30, 20, 10, 6])
@pytest.mark.parametrize("kind", ["white", "rumble"])
def test_an_utterance_is_found_whole_in_noise(snr_db, kind):
    said = speech()
    stream = noisy(np.concatenate([silence(2), said, silence(1.5)]), snr_db, kind=kind)
    found = ended(stream)
    assert len(found) == 1
    assert found[0].begin_s <= 2.15
    assert 2 + len(said) / RATE_HZ - 0.35 <= found[0].spoken_s <= 2 + len(said) / RATE_HZ + 0.3


def babble(duration_s, level):
    """Eight people who talk at once."""
    said = np.concatenate([speech(name) for name in ("other", "command", "other", "yes")])
    count = round(duration_s * RATE_HZ)
    people = [np.resize(np.roll(said, 7919 * n), count) * (1.0 - 0.05 * n) for n in range(8)]
    talk = np.sum(people, axis=0)
    return (level * talk / np.sqrt(np.mean(talk**2))).astype(np.float32)


@pytest.mark.parametrize("snr_db", [15, 20, 25])
@pytest.mark.parametrize("before_s", [1, 8])
def test_an_utterance_is_found_while_others_talk(snr_db, before_s):
    said = speech()
    level = np.sqrt(np.mean(said**2)) * 10 ** (-snr_db / 20)
    stream = babble(before_s + len(said) / RATE_HZ + 4, level)
    stream[before_s * RATE_HZ :][: len(said)] += said
    end_s = before_s + len(said) / RATE_HZ
    found = [one for one in ended(stream) if one.end_s > before_s and one.begin_s < end_s]
    assert len(found) == 1
    assert found[0].begin_s > before_s - 0.5
    assert found[0].spoken_s < end_s + 0.6


def test_talk_in_the_background_is_no_speech_when_it_is_known():
    assert [one for one in ended(babble(20, 0.01)) if one.begin_s > 3] == []


def test_a_drawn_out_cry_is_speech():
    t = np.arange(RATE_HZ) / RATE_HZ
    vowel = sum(np.sin(2 * np.pi * 120 * n * t) / n for n in range(1, 20))
    stream = np.concatenate([silence(1), 0.1 * vowel, silence(1)])
    assert len(ended(noisy(stream, 40))) == 1


def test_what_is_cut_is_cut_where_it_is_faint_and_nothing_is_lost():
    forever = np.tile(speech(), 6)
    found = ended(forever, endpoints=Endpoints(longest_s=5.0, end_s=2.0))
    assert len(found) > 1
    for one, other in itertools.pairwise(found):
        assert other.begin_s == pytest.approx(one.end_s, abs=0.011)


def test_two_utterances_are_two():
    stream = np.concatenate([silence(1), speech(), silence(1), speech("stop"), silence(1)])
    assert len(ended(noisy(stream, 40))) == 2


def test_speech_at_once_and_to_the_end_is_found():
    found = ended(speech())
    assert len(found) == 1
    assert found[0].begin_s <= 0.1


@pytest.mark.parametrize("level", [0.0, 1e-4, 0.01, 0.3])
def test_a_steady_background_is_no_speech(level):
    noise = level * np.random.default_rng(1).normal(size=20 * RATE_HZ)
    assert ended(noise.astype(np.float32)) == []


def test_a_hum_and_an_offset_are_no_speech():
    t = np.arange(20 * RATE_HZ) / RATE_HZ
    hum = 0.3 + 0.3 * np.sin(2 * np.pi * 50 * t)
    assert ended(hum.astype(np.float32)) == []


def test_an_offset_hides_nothing():
    stream = np.concatenate([silence(1), speech(), silence(1)])
    assert len(ended((noisy(stream, 40) * 0.5 + 0.4).astype(np.float32))) == 1


def test_a_background_that_rises_is_speech_for_seconds_at_most():
    quiet = 0.001 * np.random.default_rng(1).normal(size=5 * RATE_HZ)
    loud = 0.05 * np.random.default_rng(2).normal(size=30 * RATE_HZ)
    stream = np.concatenate([quiet, loud]).astype(np.float32)
    found = ended(stream)
    assert sum(one.spoken_s - one.begin_s for one in found) < 6.0
    said = np.concatenate([loud, noisy(20 * speech(), 20), loud[:RATE_HZ]]).astype(np.float32)
    assert any(one.begin_s > 29 for one in ended(np.concatenate([quiet, said]).astype(np.float32)))


def test_what_never_ends_is_cut():
    forever = np.tile(speech(), 20)
    found = ended(forever, endpoints=Endpoints(longest_s=5.0))
    assert len(found) > 5
    assert all(len(one.sound) <= 5.01 * RATE_HZ for one in found)


def test_a_pause_is_told_before_the_end():
    stream = noisy(np.concatenate([silence(1), speech("stop"), silence(1)]), 40)
    endpointer, told = Endpointer(), []
    for at in range(0, len(stream), 160):
        told += [
            (at / RATE_HZ, one.ended, one.spoken_s)
            for one in endpointer.push(stream[at : at + 160])
        ]
    assert [one[1] for one in told] == [False, True]
    assert told[1][0] - told[0][0] == pytest.approx(0.4, abs=0.02)
    assert told[0][2] == told[1][2]


@pytest.mark.parametrize("block", [1, 7, 160, 4000, 10**6])
def test_blocks_make_no_difference(block):
    stream = noisy(np.concatenate([silence(0.5), speech("yes"), silence(0.8)]), 30)
    if block == 1:
        stream = stream[: RATE_HZ // 2]
    whole = ended(stream, block=160)
    assert [(one.begin_s, one.spoken_s) for one in ended(stream, block=block)] == [
        (one.begin_s, one.spoken_s) for one in whole
    ]
