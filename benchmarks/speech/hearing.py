"""How well takes are heard: goals right, other speech rejected, cries to stop, time taken."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import NamedTuple

from benchmarks.speech.material import Noise, Take, stream, takes, vocabularies
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear, Spoken
from intents.speech.sphinx import Sphinx
from intents.vocabulary import Vocabulary

CONDITIONS: tuple[tuple[Noise, float], ...] = (
    ("clean", 0.0), ("white", 20.0), ("white", 10.0), ("babble", 20.0),
)  # fmt: skip
ASKED_GOALS = {("clean", 0.0): 0.97, ("white", 20.0): 0.92, ("white", 10.0): 0.75}
ASKED_REJECTED, ASKED_STOPS, ASKED_FACTOR = 0.90, 0.99, 0.1
WHAT = {"commands": "goals right", "others": "other speech rejected", "stops": "stop heard"}
BLOCK = RATE_HZ // 20


class Result(NamedTuple):
    """What came of one take."""

    take: Take
    good: bool
    stopped: bool
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
    """Listens to takes, with the grammar of the world that each is of."""

    def __init__(self) -> None:
        """Compile the grammars."""
        self._vocabularies = vocabularies()
        self._recognisers = {name: Sphinx(v) for name, v in self._vocabularies.items()}

    def hear(self, name: str, take: Take, noise: Noise, snr_db: float, seed: int) -> Result:
        """Listen to one take, and judge it by the list that it is from."""
        names = list(self._recognisers)
        world = take.line.world or names[seed % len(names)]
        sound = stream(take, noise, snr_db, seed)
        begun_s = time.process_time()
        ear = Ear(self._recognisers[world])
        found = [s for at in range(0, len(sound), BLOCK) for s in ear.push(sound[at : at + BLOCK])]
        found += ear.finish()
        busy_s = time.process_time() - begun_s
        sentences = [one for one in found if one.kind == "sentence"]
        stopped = any(one.kind == "stop" for one in found)
        good = {
            "commands": not stopped and _is_right(take, sentences, self._vocabularies[world]),
            "others": not stopped and not sentences,
            "stops": stopped,
        }[name]
        heard = "; ".join(f"{one.kind} {one.text!r}" for one in found)
        return Result(take, good, stopped, busy_s, len(sound) / RATE_HZ, heard)


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
    listener = Listener()
    for noise, snr_db in CONDITIONS:
        where = noise if noise == "clean" else f"{noise} noise at {snr_db:g} dB"
        asked = {
            "commands": ASKED_GOALS.get((noise, snr_db)),
            "others": ASKED_REJECTED if snr_db in (0.0, 20.0) and noise != "babble" else None,
            "stops": ASKED_STOPS if (noise, snr_db) == ("white", 20.0) else None,
        }
        for name, does in WHAT.items():
            if only and name != only:
                continue
            found = [
                listener.hear(name, take, noise, snr_db, seed)
                for seed, take in enumerate(
                    takes(name, max(1, each // 4 if name == "stops" else each))
                )
            ]
            yield Row(f"{does}, {where}", found, asked[name])
