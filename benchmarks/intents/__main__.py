"""`python -m benchmarks.intents`: one table of how well sentences are understood."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Annotated, NamedTuple

import typer
from rich.console import Console
from rich.markdown import Markdown

from benchmarks.intents import attacks, fuzz, own, replies, sets
from benchmarks.markdown import table
from benchmarks.speech import hearing
from intents.outcomes import Refusal
from intents.parser import is_stop, parse

ASKED_FULL = {
    "gpsr2025_eindhoven": 0.99, "gpsr2024_johaq": 0.99, "gpsr2018_cat1": 0.985,
    "gpsr_2013": 0.95, "paraphrases": 0.80, "huric_dev": 0.85, "robonlu_dev": 0.88,
}  # fmt: skip
ASKED_TYPES = {"paraphrases": 0.88}
PUBLISHED = {
    "paraphrases": "89 % (2019, the same corpus, anonymised forms)",
    "gpsr2025_eindhoven": "96.5 % (2026, a tuned language model; 90.4 % a cloud model)",
}
"""Other metrics and other splits: orders of magnitude."""
MAX_REFUSED, MAX_ACTED, P50_MS, P99_MS, WORST_MS, MEMORY_MB = 0.02, 0.03, 3.0, 20.0, 250.0, 150.0
STOP_MS = 5.0


class Row(NamedTuple):
    """A line of the table; `good` is None where nothing was asked."""

    what: str
    found: str
    asked: str = ""
    good: bool | None = None
    published: str = ""

    def cells(self) -> list[str]:
        """As text."""
        verdict = {True: "yes", False: "NO", None: ""}[self.good]
        return [self.what, self.found, self.asked, verdict, self.published]


def main(
    *,
    folder: Annotated[
        Path | None, typer.Option("--sets", help="sets of commands, with their score.py")
    ] = None,
    strings: Annotated[int, typer.Option(help="how many made-up strings")] = 100_000,
    misses: Annotated[int, typer.Option(help="own sentences not understood, to show")] = 0,
    speech: Annotated[int, typer.Option(help="hear one take in so many; 0 hears none")] = 24,
) -> None:
    """Measure on the project's own sentences, typed and spoken, and on sets of a folder."""
    console = Console(width=120)
    if speech and not shutil.which("espeak-ng"):
        console.print("Speech is not measured without espeak-ng: sudo apt install espeak-ng")
        speech = 0
    rows = [row for name in ("own", "second") for row in _own_rows(console, name, misses)]
    rows += _stop_rows()
    why_not = "none given; say --sets FOLDER" if folder is None else sets.problem(folder)
    if folder is not None and not why_not:
        rows += _set_rows(folder.resolve())
    rows += _attack_rows(console) + _reply_rows(console)
    rows += _fuzz_rows(console, strings) + _memory_rows()
    rows += _speech_rows(speech) if speech else []
    head = ("what", "found", "asked", "reached", "published, elsewhere")
    console.print(Markdown(table(head, [row.cells() for row in rows])))
    if why_not:
        console.print(f"Other sets were not measured: {why_not}.")


def percent(share: float) -> str:
    """As in a table."""
    return f"{100 * share:.1f} %"


def _own_rows(console: Console, name: str, misses: int) -> list[Row]:
    vocabulary, sentences = own.vocabulary(), own.sentences(name)
    outcomes = [parse(one.text, vocabulary) for one in sentences]
    pairs = list(zip(sentences, outcomes, strict=True))
    wrong = [pair for pair in pairs if not own.is_right(*pair)]
    for sentence, outcome in wrong[:misses]:
        console.print(f"{sentence.text}\n  gold {sentence.gold}\n  {outcome}", highlight=False)
    types = sum(own.types_are_right(*pair) for pair in pairs)
    refused = sum(isinstance(outcome, Refusal) for outcome in outcomes)
    count = len(pairs)
    return [
        Row(f"{name} set ({count}): fully right", percent(1 - len(wrong) / count)),
        Row(f"{name} set: types right", percent(types / count)),
        _at_most(f"{name} set: refused", refused / count, MAX_REFUSED),
    ]


def _at_most(what: str, found: float, asked: float) -> Row:
    return Row(what, percent(found), f"<= {100 * asked:g} %", found <= asked)


def _set_rows(folder: Path) -> list[Row]:
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as work:
        for name in sets.names(folder):
            found = sets.score(folder, name, Path(work))
            rows += _rows_of(name, found)
    return rows


def _rows_of(name: str, found: dict[str, float | None]) -> list[Row]:
    """What was found in a set; a share is None where the set has nothing of the kind."""
    rows: list[Row] = []
    goals, refusals = found["scored_goals"] or 0, found["refusals"] or 0
    full, types, recall = found["fully_right"], found["types_right"], found["refusal_recall"]
    if full is not None:
        rows.append(_at_least(f"{name}: fully right", full, ASKED_FULL.get(name), name))
    if types is not None:
        rows.append(_at_least(f"{name}: types right", types, ASKED_TYPES.get(name), ""))
    if goals:
        refused = (found["false_refusals"] or 0) / goals
        rows.append(_at_most(f"{name}: refused", refused, MAX_REFUSED))
        rows.append(Row(f"{name}: asked back", percent((found["questions"] or 0) / goals)))
    if refusals and recall is not None:
        rows.append(_at_most(f"{name}: acted on what it should refuse", 1 - recall, MAX_ACTED))
    p50, p99 = found["ms_p50"] or 0.0, found["ms_p99"] or 0.0
    good = p50 <= P50_MS and p99 <= P99_MS
    asked = f"<= {P50_MS:g}, {P99_MS:g} ms"
    rows.append(Row(f"{name}: p50, p99", f"{p50:.2f}, {p99:.2f} ms", asked, good))
    return rows


def _at_least(what: str, found: float, asked: float | None, name: str) -> Row:
    published = PUBLISHED.get(name, "")
    if asked is None:
        return Row(what, percent(found), published=published)
    return Row(what, percent(found), f">= {100 * asked:g} %", found >= asked, published)


def _stop_ms(text: str) -> float:
    began = time.perf_counter()
    is_stop(text)
    return (time.perf_counter() - began) * 1e3


def _stop_rows() -> list[Row]:
    """The longest that looking for a cry to stop takes, each time the best of three."""
    texts = ("stop", "x" * 100_000, "please " * 20_000, "bring me the cup", "\0" * 100_000)
    worst_ms = max(min(_stop_ms(text) for _ in range(3)) for text in texts)
    return [Row("stop: longest", f"{worst_ms:.3f} ms", f"< {STOP_MS:g} ms", worst_ms < STOP_MS)]


def _attack_rows(console: Console) -> list[Row]:
    count, found = attacks.unsafe(attacks.attacks())
    for line in found[:10]:
        console.print(line, highlight=False, markup=False)
    return [Row(f"unsafe goals out of {count} attacks", str(len(found)), "0", not found)]


def _reply_rows(console: Console) -> list[Row]:
    made = replies.examine()
    wrong = [case.shape for case, outcome, _ in made if not replies.is_right(case, outcome)]
    for shape in wrong[:10]:
        console.print(f"misread: {shape}", highlight=False, markup=False)
    kept = f"{len(made) - len(wrong)} of {len(made)}"
    return [Row("replies of a language model read as meant", kept, "all", not wrong)]


def _fuzz_rows(console: Console, strings: int) -> list[Row]:
    corpus = [sentence.text for sentence in own.sentences()]
    found = fuzz.fuzz(own.vocabulary(), corpus, strings=strings, seed=1)
    for error in found.errors[:10]:
        console.print(error, highlight=False, markup=False)
    count = len(found.errors)
    worst = f"{found.worst_ms:.0f} ms"
    return [
        Row(f"errors in {strings} made-up strings", str(count), "0", count == 0),
        Row("made-up strings: longest", worst, f"<= {WORST_MS:g} ms", found.worst_ms <= WORST_MS),
    ]


def _speech_rows(each: int) -> list[Row]:
    """How well speech is heard: the lines of `python -m benchmarks.speech`."""
    heard = list(hearing.measured(each))
    rows = [
        Row(
            f"speech: {row.what} ({len(row.results)})",
            percent(hearing.share(row.results)),
            f">= {100 * row.asked:g} %" if row.asked else "",
            row.reached,
        )
        for row in heard
    ]
    factor, asked = hearing.factor(heard), hearing.ASKED_FACTOR
    good = factor < asked
    return [*rows, Row("speech: real-time factor", f"{factor:.3f}", f"< {asked:g}", good)]


_PEAK = """
import runpy, sys
sys.argv = ["humanoid", "parse", "--json", "--vocabulary", sys.argv[1], "--file", "-"]
try:
    runpy.run_module("executive", run_name="__main__")
except SystemExit:
    lines = open("/proc/self/status").read().splitlines()
    print(next(line for line in lines if line.startswith("VmHWM")).split()[1], file=sys.stderr)
"""


def _memory_rows() -> list[Row]:
    """The peak memory of `humanoid parse` over all own sentences."""
    command = [sys.executable, "-c", _PEAK, str(own.HERE / "own.vocab.json")]
    spoken = "\n".join(sentence.text for sentence in own.sentences())
    done = subprocess.run(command, input=spoken, text=True, check=True, capture_output=True)
    peak_mb = int(done.stderr.split()[-1]) / 1024
    return [Row("memory", f"{peak_mb:.0f} MB", f"< {MEMORY_MB:g} MB", peak_mb < MEMORY_MB)]


if __name__ == "__main__":
    typer.run(main)
