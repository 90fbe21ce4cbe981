"""`python -m benchmarks.speech.cries`: cries while the robot works and eight people talk.

A cry counts that is heeded while it or the second after it lasts. Beside it stand the false alarms:
ordinary commands taken for a cry, and halts over babble alone. Sentences and voices that tuning or
training saw are told from those held out (`benchmarks.speech.voices`).
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Iterator
from typing import Annotated, NamedTuple

import numpy as np
import typer

from benchmarks import machine
from benchmarks.speech.material import Noise, Take, in_noise, lines, vocabularies
from benchmarks.speech.voices import HEARD, UNHEARD, missing, spoken
from intents.halting import is_halt
from intents.speech.audio import RATE_HZ, Samples
from intents.speech.dictation import Dictation
from intents.speech.ear import Ear
from intents.speech.keywords import Keywords
from intents.speech.sphinx import Sphinx
from intents.speech.spotting import Spotter
from intents.stopping import is_stay, is_stop

SPEEDS_WPM = (130, 155, 180, 210)
BLOCK = RATE_HZ // 20
LEVEL = 0.08
BEFORE_S, AFTER_S = 3.0, 1.0
PIECE_S = 20.0
"""Babble alone comes in pieces of that."""
_SEED = 2


class Answer(NamedTuple):
    """What the robot heeded of a take.

    Attributes:
        kind: "stop", "halt", or empty: nothing.
        text: the words heard.
        after_s: since the take began to be said.
    """

    kind: str
    text: str
    after_s: float


class Listener:
    """Listens as a robot at work does, each time to a stranger."""

    def __init__(self) -> None:
        """Compile the grammars."""
        vocabulary = vocabularies()["kitchen"]
        self._dictation = Dictation(vocabulary)
        self._recogniser = Sphinx(vocabulary, dictation=self._dictation)
        self.busy_s = self.sound_s = 0.0

    def answers(self, sound: Samples) -> Iterator[Answer]:
        """What is heeded, as it comes, `after_s` the beginning of the sound."""
        self._recogniser.speakers = ()
        ear = Ear(self._recogniser, spotter=Spotter(self._dictation, Keywords()))
        self.sound_s += len(sound) / RATE_HZ
        for at in range(0, len(sound), BLOCK):
            begun_s = time.process_time()
            found = ear.push(sound[at : at + BLOCK])
            self.busy_s += time.process_time() - begun_s
            for one in found:
                if one.kind in ("stop", "halt"):
                    yield Answer(one.kind, one.text, (at + BLOCK) / RATE_HZ)


def main(
    *,
    what: Annotated[str, typer.Option(help="cries, commands, or babble alone")] = "cries",
    noise: Annotated[str, typer.Option(help="clean, white or babble")] = "babble",
    snr_db: Annotated[float, typer.Option(help="of the noise")] = 15.0,
    takes: Annotated[int, typer.Option(help="so many; of babble, minutes; 0 is all")] = 90,
    held_out: Annotated[bool, typer.Option(help="held-out voices and sentences only")] = False,
    show: Annotated[bool, typer.Option(help="show what went wrong")] = False,
) -> None:
    """Count cries heard, and what was taken for one."""
    if missing():
        sys.exit(f"not installed: {', '.join(missing())} (apt: espeak-ng flite festival)")
    listener = Listener()
    if what == "babble":
        _print_babble(listener, takes, show=show)
    else:
        kind: Noise = "white" if noise == "white" else "babble" if noise == "babble" else "clean"
        _print_takes(listener, what, kind, snr_db, takes, held_out=held_out, show=show)
    print(f"real-time factor {listener.busy_s / listener.sound_s:.2f}; {machine.describe()}")


def _print_takes(
    listener: Listener, what: str, noise: Noise, snr_db: float, count: int, *,
    held_out: bool, show: bool,
) -> None:  # fmt: skip
    """Say takes, and print how many were heeded, in all and by voice."""
    heeded: dict[str, list[bool]] = {}
    waits_s: list[float] = []
    for number, take in enumerate(_takes(what, held_out=held_out)[: count or None]):
        sound, said_s = stream(take, noise, snr_db, number)
        found = [one for one in listener.answers(sound) if one.after_s > BEFORE_S]
        late = [one for one in found if one.after_s > BEFORE_S + said_s + AFTER_S]
        good = bool(found) and not late
        group = "unheard voice" if take.voice in UNHEARD else "heard voice"
        other = "held out" if take.held_out else "tuning"
        for name in ("all", take.voice, f"{group}, {other}"):
            heeded.setdefault(name, []).append(good)
        if good:
            waits_s.append(found[0].after_s - BEFORE_S - said_s)
        if show and good != (what == "cries"):
            told = "; ".join(f"{one.kind} {one.text!r} {one.after_s:.1f}" for one in found)
            print(f"{take.voice} {take.speed_wpm} | {take.line.text} | {told}", flush=True)
    for name, goods in sorted(heeded.items()):
        print(f"{name}: {sum(goods)} of {len(goods)} ({100 * np.mean(goods):.1f} %)")
    if waits_s:
        half, most = np.percentile(waits_s, (50, 90))
        print(f"after the last word: median {half:.2f} s, 90 % within {most:.2f} s")


def _print_babble(listener: Listener, minutes: int, *, show: bool) -> None:
    """Play babble alone, and print how often the robot halted for it."""
    count, rng = 0, np.random.default_rng(_SEED)
    for _ in range(round(minutes * 60.0 / PIECE_S)):
        silence = np.zeros(round(PIECE_S * RATE_HZ), np.float32)
        voice = np.full(RATE_HZ, LEVEL, np.float32)
        sound = in_noise(silence, voice, "babble", 5.0, int(rng.integers(1 << 30)))
        found = list(listener.answers(sound))
        count += bool(found)
        if show and found:
            print("; ".join(f"{one.kind} {one.text!r}" for one in found), flush=True)
    print(f"halted in {count} of {round(minutes * 60.0 / PIECE_S)} pieces of {PIECE_S:g} s")


def stream(take: Take, noise: Noise, snr_db: float, seed: int) -> tuple[Samples, float]:
    """A take in a noise that sounds before and after, and how long its words last [s]."""
    said = spoken(take.line.text, take.voice, take.speed_wpm)
    loud = np.flatnonzero(np.abs(said) > 0.02)
    said = said[loud[0] : loud[-1] + 1]
    said = said * (LEVEL / np.sqrt(np.mean(said[np.abs(said) > 0.02] ** 2)))
    sound = np.pad(said, (round(BEFORE_S * RATE_HZ), round((AFTER_S + 0.5) * RATE_HZ)))
    return in_noise(sound, said, noise, snr_db, seed), len(said) / RATE_HZ


def is_cry(text: str) -> bool:
    """Whether a robot at work halts when that is typed."""
    return is_stop(text) or is_halt(text) or is_stay(text)


def _takes(what: str, *, held_out: bool) -> list[Take]:
    """Every sentence in every voice, in random order: a part of them is a fair sample."""
    names = ("cries", "halts", "stops") if what == "cries" else ("commands", "ordinary")
    said = [line for name in names for line in lines(name)]
    wanted = [line for line in said if is_cry(line.text) == (what == "cries")]
    voices = UNHEARD if held_out else (*HEARD, *UNHEARD)
    found = [
        Take(line, voice, SPEEDS_WPM[(i + j) % len(SPEEDS_WPM)])
        for i, line in enumerate(wanted)
        for j, voice in enumerate(voices)
        if not (held_out and line.tuning)
    ]
    random.Random(_SEED).shuffle(found)
    return found


if __name__ == "__main__":
    typer.run(main)
