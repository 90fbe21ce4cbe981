"""Sound is the same however it is cut into blocks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intents.speech.audio import RATE_HZ, AudioError, Resampler, mono


def in_blocks(sound, rate_hz, sizes):
    resampler, made, at = Resampler(rate_hz), [], 0
    while at < len(sound):
        for size in sizes:
            made.append(resampler.push(sound[at : at + size]))
            at += size
    made.append(resampler.flush())
    return np.concatenate(made)


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from([8000, 11025, 22050, 32000, 44100, 48000]),
    st.lists(st.integers(1, 3000), min_size=1, max_size=4),
    st.integers(1, 6000),
)
def test_blocks_make_no_difference(rate_hz, sizes, count):
    sound = np.random.default_rng(count).uniform(-1, 1, count).astype(np.float32)
    whole = in_blocks(sound, rate_hz, [count])
    assert abs(len(whole) - count * RATE_HZ / rate_hz) <= 1
    np.testing.assert_allclose(in_blocks(sound, rate_hz, sizes), whole, atol=1e-6)


def test_what_is_above_the_band_is_filtered_out():
    t = np.arange(48000) / 48000
    high = np.sin(2 * np.pi * 15_000 * t).astype(np.float32)
    assert np.abs(in_blocks(high, 48000, [4800])[800:-800]).max() < 0.02


def test_channels_are_averaged():
    frames = np.array([[0.5, -0.5], [1.0, 0.0]])
    np.testing.assert_allclose(mono(frames), [0.0, 0.5])


@pytest.mark.parametrize("rate_hz", [0, -1, 10_000_000])
def test_absurd_rates_are_refused(rate_hz):
    with pytest.raises(AudioError):
        Resampler(rate_hz)
