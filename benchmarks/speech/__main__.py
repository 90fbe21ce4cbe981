"""`python -m benchmarks.speech`: one table of how well speech is heard (needs espeak-ng)."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Iterable
from typing import Annotated, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.markdown import Markdown

from benchmarks import machine
from benchmarks.markdown import table
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

    def cells(self) -> list[str]:
        """As text: all, those held out, what was asked."""
        held_out = [one for one in self.results if one.take.held_out]
        return [
            self.what, str(len(self.results)), _percent(self.results), _percent(held_out),
            f">= {100 * self.asked:g} %" if self.asked else "", _verdict(self),
        ]  # fmt: skip


def _percent(results: list[Result]) -> str:
    return f"{100 * _share(results):.1f} %" if results else ""


def _share(results: list[Result]) -> float:
    return sum(one.good for one in results) / max(1, len(results))


def _verdict(row: Row) -> str:
    if row.asked is None:
        return ""
    return "yes" if _share(row.results) >= row.asked else "NO"


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


def main(
    *,
    share: Annotated[int, typer.Option(help="take one in so many; 1 is all")] = 3,
    misses: Annotated[int, typer.Option(help="takes that went wrong, to show of each row")] = 0,
    only: Annotated[str, typer.Option(help="commands, others or stops")] = "",
) -> None:
    """Measure: goals right, other speech rejected, cries to stop heard, time taken."""
    if not shutil.which("espeak-ng"):
        sys.exit("espeak-ng is not installed: sudo apt install espeak-ng")
    console, listener, rows = Console(width=120), Listener(), list[Row]()
    for noise, snr_db in CONDITIONS:
        where = noise if noise == "clean" else f"{noise} noise at {snr_db:g} dB"
        asked = {
            "commands": ASKED_GOALS.get((noise, snr_db)),
            "others": ASKED_REJECTED if snr_db in (0.0, 20.0) and noise != "babble" else None,
            "stops": ASKED_STOPS if (noise, snr_db) == ("white", 20.0) else None,
        }
        for name, does in _WHAT.items():
            if only and name != only:
                continue
            each = max(1, share // 4) if name == "stops" else share
            results = [
                listener.hear(name, take, noise, snr_db, seed)
                for seed, take in enumerate(takes(name, each))
            ]
            rows.append(Row(f"{does}, {where}", results, asked[name]))
            console.print(rows[-1].cells(), _by_voice(results))
            for one in [one for one in results if not one.good][:misses]:
                said = f"{one.take.voice} {one.take.speed_wpm} {one.take.line.text}"
                console.print(f"  {said}: {one.heard}", highlight=False, markup=False)
    head = ("what", "of", "all", "held out", "asked", "reached")
    everything = [one for row in rows for one in row.results]
    factor = sum(one.busy_s for one in everything) / sum(one.sound_s for one in everything)
    cells = [row.cells() for row in rows]
    verdict = "yes" if factor < ASKED_FACTOR else "NO"
    cells.append(["real-time factor", "", f"{factor:.3f}", "", f"< {ASKED_FACTOR:g}", verdict])
    console.print(Markdown(table(head, cells)))
    console.print(f"{machine.describe()}; one in {share} of all takes")


_WHAT = {"commands": "goals right", "others": "other speech rejected", "stops": "stop heard"}


def _by_voice(results: Iterable[Result]) -> str:
    found: dict[str, list[bool]] = {}
    for one in results:
        found.setdefault(one.take.voice, []).append(one.good)
    return ", ".join(f"{voice} {100 * np.mean(good):.1f} %" for voice, good in found.items())


if __name__ == "__main__":
    typer.run(main)
