"""Files of every kind come out as the same sound, or say what is wrong with them."""

import os
import struct

import numpy as np
import pytest

from intents.speech import wav
from intents.speech.audio import RATE_HZ, AudioError

TONE_HZ = 440.0


def tone(rate_hz, duration_s=0.5, level=0.5, offset=0.0):
    t = np.arange(round(rate_hz * duration_s)) / rate_hz
    return offset + level * np.sin(2 * np.pi * TONE_HZ * t)


def encoded(sound, bits, *, is_float=False):
    if is_float:
        return sound.astype(f"<f{bits // 8}").tobytes()
    if bits == 8:
        return np.round(sound * 127 + 128).astype(np.uint8).tobytes()
    whole = np.round(np.clip(sound, -1, 1) * (2.0 ** (bits - 1) - 1)).astype(
        "<i4" if bits < 64 else "<i8"
    )
    raw = whole.astype("<i4").tobytes()
    if bits == 16:
        return whole.astype("<i2").tobytes()
    return raw if bits == 32 else np.frombuffer(raw, np.uint8).reshape(-1, 4)[:, :3].tobytes()


def write(path, sound, rate_hz, *, bits=16, channels=1, is_float=False, kind=None, extensible=False,
          length=None, extra=b"", cut=0):  # fmt: skip
    frames = np.repeat(np.asarray(sound)[:, None], channels, axis=1).ravel()
    data = encoded(frames, bits, is_float=is_float)
    kind = kind or (3 if is_float else 1)
    width = channels * bits // 8
    form = struct.pack("<HHIIHH", 0xFFFE if extensible else kind, channels, rate_hz,
                       rate_hz * width, width, bits)  # fmt: skip
    if extensible:
        form += struct.pack("<HHI", 22, bits, 0) + struct.pack("<H", kind) + b"\0" * 14
    body = b"WAVE" + extra + b"fmt " + struct.pack("<I", len(form)) + form
    body += b"data" + struct.pack("<I", len(data) if length is None else length) + data
    whole = b"RIFF" + struct.pack("<I", len(body)) + body
    path.write_bytes(whole[: len(whole) - cut])
    return path


def sound(path):
    return np.concatenate(list(wav.blocks(path)))


def is_the_tone(found, *, level=0.5, duration_s=0.5, within=0.02):
    inside = found[RATE_HZ // 20 : -RATE_HZ // 20]
    spectrum = np.abs(np.fft.rfft(inside * np.hanning(len(inside))))
    loudest_hz = spectrum.argmax() * RATE_HZ / len(inside)
    return (
        abs(len(found) - duration_s * RATE_HZ) <= 2
        and abs(loudest_hz - TONE_HZ) < 5
        and abs(np.sqrt(2 * np.mean(inside**2)) - level) < within
    )


@pytest.mark.parametrize("rate_hz", [8000, 11025, 16000, 22050, 44100, 48000, 96000, 192000])
def test_any_rate(tmp_path, rate_hz):
    found = sound(write(tmp_path / "a.wav", tone(rate_hz), rate_hz))
    assert found.dtype == np.float32
    assert is_the_tone(found)


@pytest.mark.parametrize(
    ("bits", "is_float"),
    [(8, False), (16, False), (24, False), (32, False), (32, True), (64, True)],
)
@pytest.mark.parametrize("extensible", [False, True])
def test_any_width(tmp_path, bits, is_float, extensible):
    path = write(tmp_path / "a.wav", tone(RATE_HZ), RATE_HZ, bits=bits, is_float=is_float,
                 extensible=extensible)  # fmt: skip
    assert is_the_tone(sound(path))


@pytest.mark.parametrize("channels", [1, 2, 6])
def test_any_number_of_channels(tmp_path, channels):
    path = write(tmp_path / "a.wav", tone(48000), 48000, channels=channels)
    assert is_the_tone(sound(path))
    assert wav.form(path).channels == channels


def test_clipped_and_offset_sound_stays_in_range(tmp_path):
    loud = np.clip(3.0 * tone(RATE_HZ), -1, 1)
    assert np.abs(sound(write(tmp_path / "a.wav", loud, RATE_HZ))).max() <= 1.0
    shifted = sound(write(tmp_path / "b.wav", tone(RATE_HZ, level=0.2, offset=0.4), RATE_HZ))
    assert abs(shifted.mean() - 0.4) < 0.01


def test_what_is_no_number_is_silence(tmp_path):
    broken = tone(RATE_HZ)
    broken[10], broken[11], broken[12] = np.nan, np.inf, -np.inf
    found = sound(write(tmp_path / "a.wav", broken, RATE_HZ, bits=32, is_float=True))
    assert found[10] == 0.0
    assert np.isfinite(found).all()
    assert np.abs(found).max() <= 1.0


def test_other_chunks_are_passed_over(tmp_path):
    path = write(tmp_path / "a.wav", tone(RATE_HZ), RATE_HZ, extra=b"LIST\x05\0\0\0hello\0")
    assert is_the_tone(sound(path))


@pytest.mark.parametrize("length", [0, 0xFFFFFFFF])
def test_a_length_that_was_not_known_yet_is_taken_from_the_file(tmp_path, length):
    path = write(tmp_path / "a.wav", tone(RATE_HZ), RATE_HZ, length=length)
    assert is_the_tone(sound(path))
    assert wav.form(path).missing == 0


def test_a_file_that_is_cut_off_is_read_as_far_as_it_goes(tmp_path):
    path = write(tmp_path / "a.wav", tone(RATE_HZ, duration_s=1.0), RATE_HZ, cut=RATE_HZ + 1)
    assert wav.form(path).missing == pytest.approx(RATE_HZ / 2, abs=1)
    assert is_the_tone(sound(path), duration_s=0.5)


def test_an_hour_of_silence_takes_no_hour_and_little_memory(tmp_path):
    path = tmp_path / "a.wav"
    write(path, np.zeros(0), 8000, length=3600 * 8000)
    with path.open("r+b") as file:
        file.truncate(path.stat().st_size + 3600 * 8000 * 2 // 2)  # a sparse half of it
    seconds, largest = 0.0, 0
    for block in wav.blocks(path):
        seconds += len(block) / RATE_HZ
        largest = max(largest, len(block))
    assert seconds == pytest.approx(1800.0, abs=0.01)
    assert largest < 2 * RATE_HZ


def test_a_day_of_silence_that_takes_no_room_is_refused(tmp_path):
    path = tmp_path / "a.wav"
    write(path, np.zeros(0), 8000, length=86_400 * 8000 * 2)
    os.truncate(path, 86_400 * 8000 * 2)
    with pytest.raises(AudioError, match=r"lasts 24\.0 h"):
        wav.form(path)


def broken(tmp_path, data):
    path = tmp_path / "broken.wav"
    path.write_bytes(data)
    return path


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "is empty"),
        (b"hello, this is text", "is no WAV file"),
        (b"OggS" + b"\0" * 40, "but Ogg"),
        (b"ID3\x04" + b"\0" * 40, "but MP3"),
        (b"RIFF\0\0\0\0WAVE", "no description"),
        (b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0", "ends early"),
        (b"RIFF\0\0\0\0AVI " + b"\0" * 40, "is no WAV file"),
    ],
)
def test_what_is_no_sound_is_said(tmp_path, data, says):
    with pytest.raises(AudioError, match=says) as caught:
        wav.form(broken(tmp_path, data))
    assert caught.value.cure


def test_a_description_without_sound_is_said(tmp_path):
    path = write(tmp_path / "a.wav", tone(RATE_HZ), RATE_HZ, cut=2 * RATE_HZ // 2 + 8)
    with pytest.raises(AudioError, match="no sound"):
        wav.form(path)
    with pytest.raises(AudioError, match="no sound"):
        wav.form(write(tmp_path / "b.wav", np.zeros(0), RATE_HZ))


@pytest.mark.parametrize(
    ("kind", "says"), [(2, "ADPCM"), (7, "mu-law"), (0x55, "MP3"), (99, "0x0063")]
)
def test_compressed_sound_is_said(tmp_path, kind, says):
    path = write(tmp_path / "a.wav", tone(RATE_HZ), RATE_HZ, kind=kind)
    with pytest.raises(AudioError, match=says) as caught:
        wav.form(path)
    assert "ffmpeg" in caught.value.cure


@pytest.mark.parametrize("rate_hz", [0, 100, 2_000_000])
def test_an_absurd_rate_is_said(tmp_path, rate_hz):
    with pytest.raises(AudioError, match=f"{rate_hz} Hz"):
        wav.form(write(tmp_path / "a.wav", tone(RATE_HZ), rate_hz))


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(AudioError, match="No such file"):
        wav.form(tmp_path / "none.wav")
    with pytest.raises(AudioError, match="cannot be read"):
        wav.form(tmp_path)
