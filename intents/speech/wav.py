"""WAV files of any rate, width and number of channels, read block by block.

Read are integers of 8, 16, 24 and 32 bits and floats of 32 and 64, also in the extensible form.
A file that is cut off is read as far as it goes. Source: Microsoft, Multimedia Programming
Interface and Data Specifications 1.0 (RIFF), and WAVEFORMATEXTENSIBLE.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

import msgspec
import numpy as np
from numpy.typing import NDArray

from intents.speech.audio import AudioError, Resampler, Samples, mono

BLOCK_S = 0.5
MAX_DURATION_S = 2 * 3600.0
"""A file of 4 GB that is all zeros takes no room on the disk, and a day to listen to."""
MOST_CHUNKS = 1000
"""Before the sound; editors write a dozen."""
DESCRIPTION_BYTES = 64
"""Of the longest kind, which has 40."""
MAX_CHANNELS = 64
_PCM, _FLOAT, _EXTENSIBLE = 0x0001, 0x0003, 0xFFFE
_COMPRESSED = {0x0002: "ADPCM", 0x0006: "A-law", 0x0007: "mu-law", 0x0050: "MPEG", 0x0055: "MP3"}
_UNTIL_THE_END = (0, 0xFFFFFFFF)
"""Lengths that are written by programs that do not know yet how long it will be."""
_OTHERS = {
    b"OggS": "Ogg", b"fLaC": "FLAC", b"ID3\x03": "MP3", b"ID3\x04": "MP3", b"\xff\xfb": "MP3",
    b"FORM": "AIFF", b".snd": "AU", b"caff": "CAF",
}  # fmt: skip


class Form(msgspec.Struct, frozen=True, kw_only=True):
    """How the sound of a file is written.

    Attributes:
        rate_hz: frames a second.
        channels: samples a frame.
        bits: of a sample.
        is_float: whether samples are floats.
        offset: where the sound begins in the file [bytes].
        frames: how many there are.
        missing: how many frames are promised and are not there.
    """

    rate_hz: int
    channels: int
    bits: int
    is_float: bool
    offset: int
    frames: int
    missing: int = 0

    @property
    def frame_bytes(self) -> int:
        """Of one frame."""
        return self.channels * self.bits // 8

    @property
    def duration_s(self) -> float:
        """Of what is there."""
        return self.frames / self.rate_hz


Opened = Callable[[Path], BinaryIO]
"""Opens a file to read bytes from; who takes files of strangers hands in one that is careful."""


def plainly(path: Path) -> BinaryIO:
    """Open a file, whatever it is."""
    return path.open("rb")


def form(path: Path, opened: Opened = plainly) -> Form:
    """How a file is written.

    Raises:
        AudioError: it cannot be read, or is no sound that is understood.
    """
    try:
        with opened(path) as file:
            return _form(file, path.stat().st_size, str(path))
    except OSError as error:
        raise AudioError(f"{path} cannot be read: {error.strerror}", "name a WAV file") from None


def blocks(path: Path, opened: Opened = plainly) -> Iterator[Samples]:
    """The sound of a file as one channel at 16 kHz, in blocks of about `BLOCK_S`.

    Raises:
        AudioError: as `form` does.
    """
    found = form(path, opened)
    resampler = Resampler(found.rate_hz)
    left, step = found.frames, max(1, int(BLOCK_S * found.rate_hz))
    with opened(path) as file:
        file.seek(found.offset)
        while left > 0:
            data = file.read(min(left, step) * found.frame_bytes)
            frames = _decoded(data, found)
            if not len(frames):
                break
            left -= len(frames)
            yield resampler.push(mono(frames))
    yield resampler.flush()


def _form(file: BinaryIO, size: int, name: str) -> Form:
    head = file.read(12)
    if head[:4] not in (b"RIFF", b"RF64") or head[8:12] != b"WAVE":
        raise _no_wav(head, name)
    described: tuple[int, int, int, int] | None = None
    for _ in range(MOST_CHUNKS):
        chunk = file.read(8)
        if len(chunk) < 8:
            lacks = "no sound in it" if described else "no description of its sound"
            raise AudioError(f"{name} ends early: there is {lacks}", "record or copy it again")
        kind, length = chunk[:4], int.from_bytes(chunk[4:], "little")
        if kind == b"data" and described is not None:
            return _found(described, length, file.tell(), size, name)
        if kind == b"fmt ":
            begin = file.tell()
            described = _described(file.read(min(length, DESCRIPTION_BYTES)), name)
            file.seek(begin + length)
        else:
            file.seek(length, 1)
        file.seek(length % 2, 1)
    text = f"{name} has {MOST_CHUNKS} parts before its sound"
    raise AudioError(text, "record it again, or convert it")


def _no_wav(head: bytes, name: str) -> AudioError:
    if not head:
        return AudioError(f"{name} is empty", "record or copy it again")
    kind = next((k for magic, k in _OTHERS.items() if head.startswith(magic)), "")
    return AudioError(
        f"{name} is no WAV file" + (f" but {kind}" if kind else ""),
        f"convert it: ffmpeg -i {name} -ar 16000 -ac 1 out.wav",
    )


def _described(chunk: bytes, name: str) -> tuple[int, int, int, int]:
    """The kind, channels, rate and bits of a description."""
    if len(chunk) < 16:
        raise AudioError(f"{name} ends early: its description is cut", "record or copy it again")
    kind, channels, rate_hz, _, _, bits = struct.unpack("<HHIIHH", chunk[:16])
    if kind == _EXTENSIBLE and len(chunk) >= 26:
        kind = int.from_bytes(chunk[24:26], "little")
    known = (kind == _PCM and bits in (8, 16, 24, 32)) or (kind == _FLOAT and bits in (32, 64))
    if not known:
        what = _COMPRESSED.get(kind, f"of kind {kind:#06x} with {bits} bits")
        raise AudioError(
            f"the sound of {name} is {what}, which is not read",
            f"convert it: ffmpeg -i {name} -ar 16000 -ac 1 -c:a pcm_s16le out.wav",
        )
    if not 1 <= channels <= MAX_CHANNELS:
        raise AudioError(f"{name} has {channels} channels", "record it again with one channel")
    Resampler(rate_hz)  # says so if the rate is absurd
    return kind, channels, rate_hz, bits


def _found(
    described: tuple[int, int, int, int], length: int, offset: int, size: int, name: str
) -> Form:
    kind, channels, rate_hz, bits = described
    there = size - offset
    frame = channels * bits // 8
    promised = there if length in _UNTIL_THE_END else length
    if length == 0 and there < frame:
        raise AudioError(f"{name} holds no sound: its length is 0", "record it again")
    frames = min(there, promised) // frame
    if frames == 0:
        raise AudioError(f"{name} ends early: there is no sound in it", "record or copy it again")
    if frames / rate_hz > MAX_DURATION_S:
        text = f"{name} lasts {frames / rate_hz / 3600:.1f} h, at most 2 h are listened to"
        raise AudioError(text, "cut it into pieces")
    return Form(
        rate_hz=rate_hz, channels=channels, bits=bits, is_float=kind == _FLOAT, offset=offset,
        frames=frames, missing=max(0, promised - there) // frame,
    )  # fmt: skip


def _decoded(data: bytes, found: Form) -> NDArray[Any]:
    """Frames as floats in [-1, 1], shape (n, channels); half a frame at the end is left out."""
    data = data[: len(data) // found.frame_bytes * found.frame_bytes]
    if found.is_float:
        samples = np.frombuffer(data, f"<f{found.bits // 8}")
    elif found.bits == 8:
        samples = np.frombuffer(data, np.uint8).astype(np.float32) / 128.0 - 1.0
    elif found.bits == 24:
        padded = np.zeros((len(data) // 3, 4), np.uint8)
        padded[:, 1:] = np.frombuffer(data, np.uint8).reshape(-1, 3)
        samples = padded.view("<i4")[:, 0] / 2.0**31
    else:
        samples = np.frombuffer(data, f"<i{found.bits // 8}") / 2.0 ** (found.bits - 1)
    return samples.reshape(-1, found.channels)
