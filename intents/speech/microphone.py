"""The microphone, through PortAudio: sound as it comes, in blocks."""

from __future__ import annotations

import queue
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from intents.speech.audio import AudioError, Resampler, Samples, mono

BLOCK_S = 0.05
KEPT_BLOCKS = 2_000
"""So much waits while the recogniser is at work; the oldest is lost beyond."""
GONE_S = 3.0
"""A microphone that delivers nothing for so long, not even silence, is there no more."""
_LIBRARY = "install it: sudo apt install libportaudio2"
_PLUG_IN = "plug one in, or use a recording: humanoid listen --file FILE.wav"


class Microphone:
    """An open microphone: blocks of sound, until it is closed.

    Attributes:
        lost: how many blocks nobody was in time for.
    """

    def __init__(self, rate_hz: int) -> None:
        """Take in sound of a rate."""
        self.lost = 0
        self._resampler = Resampler(rate_hz)
        self._blocks: queue.Queue[Samples] = queue.Queue(KEPT_BLOCKS)

    def take(self, frames: Any) -> None:
        """Take in frames, shape (n, channels); called by the sound system, never waits."""
        try:
            self._blocks.put_nowait(mono(np.array(frames)))
        except queue.Full:
            self.lost += 1

    def blocks(self, *, timeout_s: float = 0.2) -> Iterator[Samples]:
        """Sound at 16 kHz as it comes; an empty block when none came in time.

        Raises:
            AudioError: nothing came for long; it was unplugged.
        """
        missed = 0
        while missed * timeout_s < GONE_S:
            try:
                block = self._blocks.get(timeout=timeout_s)
            except queue.Empty:
                missed += 1
                yield np.zeros(0, np.float32)
            else:
                missed = 0
                yield self._resampler.push(block)
        raise AudioError("the microphone delivers nothing any more", _PLUG_IN)


@contextmanager
def opened(device: str | None = None) -> Generator[Microphone]:
    """Open a microphone, the usual one if none is named.

    Raises:
        AudioError: there is no sound library, no microphone, or it cannot be opened.
    """
    try:
        import sounddevice  # pyright: ignore[reportMissingTypeStubs]
    except ImportError:
        raise AudioError("sounddevice is not installed", "pip install sounddevice") from None
    except OSError:
        raise AudioError("the sound library PortAudio is not there", _LIBRARY) from None
    library: Any = sounddevice
    try:
        found: Any = library.query_devices(device, "input")
        rate_hz = int(found["default_samplerate"])
        microphone = Microphone(rate_hz)
        stream: Any = library.InputStream(
            samplerate=rate_hz, device=device, channels=1, dtype="float32",
            blocksize=int(BLOCK_S * rate_hz),
            callback=lambda frames, *_: microphone.take(frames),  # type: ignore[misc]
        )  # fmt: skip
        stream.start()
    except (library.PortAudioError, ValueError) as error:
        raise AudioError(f"there is no microphone: {error}", _PLUG_IN) from None
    try:
        yield microphone
    finally:
        stream.close()
