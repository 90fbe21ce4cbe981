"""The microphone: what comes of the sound library's answers, the library being a stand-in."""

import sys
import types

import numpy as np
import pytest

from intents.speech import microphone
from intents.speech.audio import RATE_HZ, AudioError


class Stream:
    """Delivers three blocks as soon as it is started."""

    made: list = []

    def __init__(self, *, callback, samplerate, blocksize, **_):
        self.callback, self.rate_hz, self.block = callback, samplerate, blocksize
        self.closed = False
        Stream.made.append(self)

    def start(self):
        for level in (0.1, 0.2, 0.3):
            self.callback(np.full((self.block, 1), level, np.float32), self.block, None, None)

    def close(self):
        self.closed = True


def library(**changes):
    """A stand-in for sounddevice."""
    found = types.ModuleType("sounddevice")
    found.PortAudioError = type("PortAudioError", (Exception,), {})
    found.InputStream = Stream
    found.query_devices = lambda device, kind: {"default_samplerate": 48000.0}
    for name, value in changes.items():
        setattr(found, name, value)
    return found


@pytest.fixture
def stand_in(monkeypatch):
    def install(**changes):
        found = library(**changes)
        monkeypatch.setitem(sys.modules, "sounddevice", found)
        return found

    return install


def test_sound_comes_at_the_rate_that_is_wanted(stand_in):
    stand_in()
    with microphone.opened() as source:
        blocks = source.blocks(timeout_s=0.01)
        parts = [next(blocks) for _ in range(4)]
    assert len(parts[3]) == 0  # none in time is an empty block, not a wait for ever
    assert sum(map(len, parts)) == pytest.approx(0.15 * RATE_HZ, abs=100)
    assert parts[1].max() == pytest.approx(0.2, abs=0.05)
    assert Stream.made[-1].closed


def test_a_microphone_that_is_unplugged_ends_the_stream(stand_in, monkeypatch):
    stand_in()
    monkeypatch.setattr(microphone, "GONE_S", 0.03)
    parts = []
    with (
        microphone.opened() as source,
        pytest.raises(AudioError, match="nothing any more") as caught,
    ):
        for block in source.blocks(timeout_s=0.01):
            parts.append(len(block))
    assert [length > 0 for length in parts] == 3 * [True] + 3 * [False]
    assert "plug one in" in caught.value.cure


def test_it_is_closed_after_an_error(stand_in):
    stand_in()
    with pytest.raises(ZeroDivisionError), microphone.opened():
        raise ZeroDivisionError
    assert Stream.made[-1].closed


def test_blocks_that_nobody_takes_are_lost_not_waited_for():
    source = microphone.Microphone(RATE_HZ)
    for _ in range(microphone.KEPT_BLOCKS + 5):
        source.take(np.zeros((1, 1), np.float32))
    assert source.lost == 5


def test_no_microphone_is_said(stand_in):
    found = stand_in()

    def none(device, kind):
        raise found.PortAudioError("Error querying device -1")

    found.query_devices = none
    with pytest.raises(AudioError, match="there is no microphone") as caught, microphone.opened():
        pass
    assert "--file" in caught.value.cure


def test_no_such_microphone_is_said(stand_in):
    def none(device, kind):
        raise ValueError(f"No input device matching {device!r}")

    stand_in(query_devices=none)
    with pytest.raises(AudioError, match="'studio'"), microphone.opened("studio"):
        pass


def test_no_library_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    with pytest.raises(AudioError, match="sounddevice is not installed"), microphone.opened():
        pass


def test_no_portaudio_is_said(tmp_path, monkeypatch):
    (tmp_path / "sounddevice.py").write_text("raise OSError('PortAudio library not found')")
    monkeypatch.delitem(sys.modules, "sounddevice", raising=False)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(AudioError, match="PortAudio") as caught, microphone.opened():
        pass
    assert "libportaudio2" in caught.value.cure
