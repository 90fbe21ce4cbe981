"""How well takes are heard: goals right, other speech rejected, cries to stop, time taken."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from typing import Literal, NamedTuple

from benchmarks.speech.material import (
    SPEEDS_WPM,
    VOICES,
    Noise,
    Take,
    lines,
    stream,
    takes,
    vocabularies,
)
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear, Spoken
from intents.speech.speaker import Speaker
from intents.speech.sphinx import Sphinx
from intents.vocabulary import Vocabulary

ASKED_FACTOR = 0.1
WHAT = {"commands": "goals right", "others": "other speech rejected", "stops": "stop heard"}
BLOCK = RATE_HZ // 20


class Condition(NamedTuple):
    """What is measured: a list of sentences, in a noise, and whether the voice is known.

    Attributes:
        name: of the list.
        noise: what sounds beside the voice.
        snr_db: how much louder the voice is.
        known: "alone", "among others" (of four voices), or "not": a stranger's.
        asked: the share that has to be right; None if nothing was asked.
    """

    name: str
    noise: Noise = "clean"
    snr_db: float = 0.0
    known: Literal["alone", "among others", "not"] = "alone"
    asked: float | None = None

    def __str__(self) -> str:
        """As the table has it."""
        where = self.noise if self.noise == "clean" else f"{self.noise} {self.snr_db:g} dB"
        who = {"alone": "", "among others": ", one of four people", "not": ", by a stranger"}
        return f"{WHAT[self.name]}, {where}{who[self.known]}"


CONDITIONS = (
    Condition("commands", asked=0.97),
    Condition("commands", "white", 20.0, asked=0.92),
    Condition("commands", "white", 10.0, asked=0.75),
    Condition("others", asked=0.90),
    Condition("others", "white", 20.0, asked=0.90),
    Condition("stops", "white", 20.0, asked=0.99),
    Condition("stops", "white", 20.0, known="not", asked=0.99),
    Condition("others", known="not", asked=0.90),
    Condition("commands", "babble", 20.0),
    Condition("commands", known="among others"),
    Condition("commands", known="not"),
    Condition("commands", "white", 10.0, known="not"),
    Condition("others", "white", 10.0),
    Condition("others", "babble", 20.0),
    Condition("stops"),
    Condition("stops", "white", 10.0),
    Condition("stops", "babble", 20.0),
)
"""The voice has said sixteen sentences before, and goes on being got used to; one of four people is
not told from the others but by the voice; a stranger's is forgotten after each sentence."""


class Result(NamedTuple):
    """What came of one take."""

    take: Take
    good: bool
    busy_s: float
    sound_s: float
    heard: str


class Row(NamedTuple):
    """A line of the table."""

    what: str
    results: list[Result]
    asked: float | None = None

    @property
    def reached(self) -> bool | None:
        """Whether it is as good as was asked; None if nothing was."""
        return None if self.asked is None else share(self.results) >= self.asked


def share(results: list[Result]) -> float:
    """How many of the takes went right."""
    return sum(one.good for one in results) / max(1, len(results))


def factor(rows: list[Row]) -> float:
    """How long the processor was busy, relative to the sound: the real-time factor."""
    results = [one for row in rows for one in row.results]
    return sum(one.busy_s for one in results) / sum(one.sound_s for one in results)


class Listener:
    """Listens to takes of one voice, with the grammar of the world that each is of."""

    def __init__(self) -> None:
        """Compile the grammars."""
        self._vocabularies = vocabularies()
        self._recognisers = {name: Sphinx(v) for name, v in self._vocabularies.items()}
        self.speakers: tuple[Speaker, ...] = ()

    def hear(self, take: Take, condition: Condition, seed: int) -> Result:
        """Listen to one take, and judge it by the list that it is from."""
        names = list(self._recognisers)
        world = take.line.world or names[seed % len(names)]
        recogniser = self._recognisers[world]
        recogniser.speakers = self.speakers
        sound = stream(take, condition.noise, condition.snr_db, seed)
        begun_s = time.process_time()
        ear = Ear(recogniser)
        found = [s for at in range(0, len(sound), BLOCK) for s in ear.push(sound[at : at + BLOCK])]
        found += ear.finish()
        busy_s = time.process_time() - begun_s
        self.speakers = recogniser.speakers
        sentences = [one for one in found if one.kind == "sentence"]
        stopped = any(one.kind == "stop" for one in found)
        good = {
            "commands": not stopped and _is_right(take, sentences, self._vocabularies[world]),
            "others": not stopped and not sentences,
            "stops": stopped,
        }[condition.name]
        heard = "; ".join(f"{one.kind} {one.text!r}" for one in found)
        return Result(take, good, busy_s, len(sound) / RATE_HZ, heard)

    @cache  # noqa: B019 - there is one in a process
    def meet(self, voices: tuple[str, ...]) -> tuple[Speaker, ...]:
        """The speakers when some voices have said their first sentences, each after the other."""
        self.speakers = ()
        for voice in voices:
            for number, line in enumerate(lines("acquaintance")):
                take = Take(line, voice, SPEEDS_WPM[number % len(SPEEDS_WPM)])
                self.hear(take, Condition("commands"), number)
        return self.speakers


@cache
def _listener() -> Listener:
    """The one of this process: compiling the grammars takes seconds."""
    return Listener()


def _listened(voice: str, condition: Condition, each: int) -> list[Result]:
    """What came of one in `each` takes of a voice."""
    listener, found = _listener(), list[Result]()
    met = {"alone": (voice,), "among others": VOICES, "not": ()}[condition.known]
    listener.speakers = listener.meet(met)
    for number, take in enumerate(takes(condition.name, voice, each)):
        if condition.known == "not":
            listener.speakers = ()
        found.append(listener.hear(take, condition, number))
    return found


def _is_right(take: Take, sentences: list[Spoken], vocabulary: Vocabulary) -> bool:
    """Whether one sentence was heard, and means what the typed one means."""
    if len(sentences) != 1:
        return False
    heard, typed = parse(sentences[0].text, vocabulary), parse(take.line.text, vocabulary)
    if isinstance(heard, Goals) and isinstance(typed, Goals):
        return heard.goals == typed.goals
    return (
        isinstance(heard, Question)
        and isinstance(typed, Question)
        and heard.question == typed.question
    )


def measured(each: int, *, only: str = "") -> Iterator[Row]:
    """Every line of the table, of one in `each` takes, as it is done."""
    conditions = [one for one in CONDITIONS if only in ("", one.name)]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        waiting = [
            [
                pool.submit(
                    _listened, voice, one, max(1, each // (4 if one.name == "stops" else 1))
                )
                for voice in VOICES
            ]
            for one in conditions
        ]
        for condition, voices in zip(conditions, waiting, strict=True):
            results = [result for one in voices for result in one.result()]
            yield Row(str(condition), results, condition.asked)
