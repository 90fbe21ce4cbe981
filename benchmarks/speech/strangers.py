"""`python -m benchmarks.speech.strangers`: what becomes of what strangers ask and cry.

Nine voices of three synthesisers (espeak-ng, flite, festival) say them, each for the first time, in
silence, in white noise, or while eight people talk. Takes come in random order, so that a part of
them is a fair sample; sentences that tuning saw are left out.
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter
from typing import Annotated

import numpy as np
import typer

from benchmarks import machine
from benchmarks.speech.material import Noise, Take, in_noise, lines, vocabularies
from benchmarks.speech.voices import NINE, missing, spoken
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.speech.audio import RATE_HZ, Samples
from intents.speech.dictation import Dictation
from intents.speech.ear import Ear, Spoken
from intents.speech.keywords import Keywords
from intents.speech.sphinx import Sphinx
from intents.speech.spotting import Spotter
from intents.vocabulary import Vocabulary

SPEEDS_WPM = (140, 165, 190)
BLOCK = RATE_HZ // 20
LEVEL = 0.08
BEFORE_S, AFTER_S = 3.0, 1.0
_SEED = 1


def main(
    *,
    what: Annotated[str, typer.Option(help="ordinary (wordings), halts or others")] = "ordinary",
    noise: Annotated[str, typer.Option(help="clean, white or babble")] = "clean",
    snr_db: Annotated[float, typer.Option(help="of white noise or babble")] = 15.0,
    takes: Annotated[int, typer.Option(help="so many of them; 0 is all")] = 90,
    show: Annotated[bool, typer.Option(help="show each take")] = False,
) -> None:
    """Count what is right, another goal, read back, asked about, passed over, or a cry."""
    if missing():
        sys.exit(f"not installed: {', '.join(missing())} (apt: espeak-ng flite festival)")
    vocabulary = vocabularies()["kitchen"]
    dictation = Dictation(vocabulary)
    recogniser = Sphinx(vocabulary, dictation=dictation)
    count, busy_s, sound_s = Counter[str](), 0.0, 0.0
    taken = _takes(what)[: takes or None]
    for number, take in enumerate(taken):
        sound = _stream(take, noise, snr_db, number)
        begun_s = time.process_time()
        recogniser.speakers = ()
        heard = _heard(Ear(recogniser, spotter=Spotter(dictation, Keywords())), sound)
        busy_s, sound_s = busy_s + time.process_time() - begun_s, sound_s + len(sound) / RATE_HZ
        count.update(_kinds(heard, take.line.text, vocabulary))
        if show:
            said = "; ".join(f"{one.kind} {one.text!r} {one.doubt:.2f}" for one in heard)
            print(f"{take.voice} | {take.line.text} | {said}", flush=True)
    for kind, often in count.most_common():
        print(f"{kind}: {often} of {len(taken)}")
    print(f"real-time factor {busy_s / sound_s:.2f}; {machine.describe()}")


def _takes(what: str) -> list[Take]:
    """Every sentence that is held out in every voice, in random order."""
    found = [
        Take(line, voice, SPEEDS_WPM[(i + j) % len(SPEEDS_WPM)])
        for i, line in enumerate(lines(what))
        for j, voice in enumerate(NINE)
        if not line.tuning
    ]
    random.Random(_SEED).shuffle(found)
    return found


def _stream(take: Take, noise: str, snr_db: float, seed: int) -> Samples:
    """A take, as loud as all others, with what sounds before and after."""
    said = spoken(take.line.text, take.voice, take.speed_wpm)
    said = said * (LEVEL / np.sqrt(np.mean(said[np.abs(said) > 0.02] ** 2)))
    sound = np.pad(said, (round(BEFORE_S * RATE_HZ), round(AFTER_S * RATE_HZ)))
    kind: Noise = "white" if noise == "white" else "babble" if noise == "babble" else "clean"
    return in_noise(sound, said, kind, snr_db, seed)


def _heard(ear: Ear, sound: Samples) -> list[Spoken]:
    found = [one for at in range(0, len(sound), BLOCK) for one in ear.push(sound[at : at + BLOCK])]
    return found + ear.finish()


def _kinds(heard: list[Spoken], typed: str, vocabulary: Vocabulary) -> list[str]:
    """What became of a take: one of them, and whether something was halted for."""
    halts = ["halt"] if any(one.kind == "halt" for one in heard) else []
    if any(one.kind == "stop" for one in heard):
        return ["stop", *halts]
    right = _meant(typed, vocabulary)
    sentences = [one for one in heard if one.kind == "sentence"]
    meant = [(one.sure, _meant(one.text, vocabulary)) for one in sentences]
    if any(sure and isinstance(goals, tuple) for sure, goals in meant):
        return ["right" if [goals for _, goals in meant] == [right] else "another goal", *halts]
    if any(isinstance(goals, tuple) for _, goals in meant):
        back = "right" if right in [goals for _, goals in meant] else "another"
        return [f"read back, {back}", *halts]
    return ["asked or refused" if sentences else "passed over", *halts]


def _meant(text: str, vocabulary: Vocabulary) -> object:
    """The goals of a text, or what is asked about it."""
    outcome = parse(text, vocabulary)
    if isinstance(outcome, Goals):
        return outcome.goals
    return outcome.question if isinstance(outcome, Question) else None


if __name__ == "__main__":
    typer.run(main)
