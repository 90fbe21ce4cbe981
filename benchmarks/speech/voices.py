"""Who speaks the takes: voices of three synthesisers, all of which run offline."""

from __future__ import annotations

import io
import shutil
import subprocess
import wave
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from intents.speech.audio import Resampler, Samples

NINE = (
    "en-us", "en-us+f4", "en-gb+f2", "en-gb-scotland+m3", "flite:slt", "flite:rms", "flite:awb",
    "flite:kal16", "festival:kal_diphone",
)  # fmt: skip
"""American and Scottish, men and women, by rules, by diphones, and (slt, rms, awb) after recordings
of people. What has no colon is a voice of espeak-ng."""
HEARD = (
    "en-us", "en-gb+f2", "en-gb-x-rp+m7", "flite:rms", "flite:kal16", "festival:kal_diphone",
)  # fmt: skip
UNHEARD = (
    "en-us+f4", "en-gb-scotland+m3", "en-029+f1", "flite:slt", "flite:awb", "festival:ked_diphone",
)  # fmt: skip
"""Voices that the network which spots cries was trained with, and people it never heard."""
_USUAL_WPM = 170
"""Words a minute of flite and festival, where nothing is asked."""


def missing() -> list[str]:
    """The synthesisers that are not installed."""
    return [name for name in ("espeak-ng", "flite", "text2wave") if not shutil.which(name)]


def spoken(text: str, voice: str, speed_wpm: int, *, pitch: int = 50) -> Samples:
    """A sentence, synthesised; the pitch is espeak-ng's, from 0 to 99."""
    program, _, name = voice.rpartition(":")
    with TemporaryDirectory() as folder:
        words, sound = Path(folder, "words.txt"), Path(folder, "sound.wav")
        words.write_text(text, encoding="utf-8")
        stretch = _USUAL_WPM / speed_wpm
        commands = {
            "": ["espeak-ng", "-v", name, "-s", speed_wpm, "-p", pitch, "-f", words, "-w", sound],
            "flite": ["flite", "-voice", name, "--setf", f"duration_stretch={stretch:.3f}",
                      "-f", words, "-o", sound],
            "festival": ["text2wave", "-eval", f"(voice_{name})", "-eval",
                         f"(Parameter.set 'Duration_Stretch {stretch:.3f})", words, "-o", sound],
        }  # fmt: skip
        arguments = [str(one) for one in commands[program]]
        subprocess.run(arguments, check=True, capture_output=True)
        return _read(sound.read_bytes())


def _read(data: bytes) -> Samples:
    """A file of 16-bit samples at 16 kHz."""
    with wave.open(io.BytesIO(data)) as file:
        rate_hz, raw = file.getframerate(), file.readframes(file.getnframes())
    sound = (np.frombuffer(raw, "<i2") / 32_768.0).astype(np.float32)
    resampler = Resampler(rate_hz)
    return np.concatenate([resampler.push(sound), resampler.flush()])
