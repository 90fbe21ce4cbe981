"""What the voices say: cries, each with the word that cries, and what is none."""

from __future__ import annotations

import json
import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from benchmarks.speech.material import lines, vocabularies
from intents.halting import is_halt
from intents.speech.dictation import common_words
from intents.speech.grammar import rules
from intents.speech.keywords import KEYWORDS
from intents.speech.ngrams import sentence
from intents.stopping import is_stay, is_stop

_HERE = Path(__file__).parent
_MARKED = _HERE.parent / "sentences"
_CALLS = (
    "hey",
    "robot",
    "oh",
    "please",
    "okay",
    "oh no",
    "hey robot",
    "no",
    "just",
    "now",
    "oh god",
)
_ENDS = {
    "stop": (
        "it", "now", "please", "that", "right now", "moving", "walking", "right there", "stop",
        "stop stop", "robot", "what you are doing", "you will hit the chair", "at once",
        "you are about to fall", "there is a dog", "for a second", "the cup is falling", "turning",
        "I changed my mind", "that is my foot", "before you break it",
    ),
    "halt": ("now", "please", "robot", "halt", "at once", "you two", "stop", "here", "this minute"),
    "freeze": (
        "now", "please", "robot", "right now", "freeze", "there is glass on the floor",
        "do not move", "this second", "where you are", "all of you",
    ),
    "emergency": ("stop", "stop now", "emergency", "please stop", "everybody stop"),
    "wait": (
        "please", "a minute", "a second", "one moment", "wait", "robot", "that is not mine",
        "I am not ready", "there is someone there", "you took the wrong one", "the cable",
        "I forgot something", "let me move", "no", "up", "stop",
    ),
    "no": (
        "no", "no no", "don't", "not there", "not like that", "that is not it", "please don't",
        "stop", "wait", "the other one", "put that down", "that's wrong", "not on the floor",
        "leave it alone", "you can't", "not so fast", "the red one",
    ),
    "don't": (
        "move", "touch it", "go there", "drop it", "do that", "take it", "break it", "go in there",
        "step on that", "fall", "push it", "turn around", "walk on the carpet", "hit him", "please",
    ),
    "careful": (
        "robot", "please", "the cat", "the floor is wet", "with my plate", "that's hot", "now",
        "it is slippery", "you will fall", "careful", "of the stairs", "behind you",
    ),
    "stay": ("there", "back", "here", "still", "put", "away", "where you are", "right there",
             "out of there", "away from me"),
    "enough": ("now", "already", "thanks", "of this", "that is enough", "enough", "please"),
    "hold": ("it", "on", "still", "on a minute", "it there", "it right there", "on please",
             "your horses", "everything", "on one second", "on I need to think"),
    "hang": ("on", "on please", "on one second", "on a minute", "on wait", "on I forgot"),
    "look": ("out", "out robot", "out there is a step", "out for the cat", "out the table"),
    "watch": ("out", "it", "out robot", "out there is a wall", "out the lamp", "your step",
              "out you will trip", "where you are going"),
    "whoa": ("", "whoa", "whoa there", "stop", "easy", "wait", "robot"),
    "easy": ("", "easy", "there", "robot", "does it", "now please"),
}  # fmt: skip
"""What follows a word that cries. None of the sentences held out for measuring is made of these."""
_LAST = (
    "I said {}", "you have to {}", "you must {}", "could you {}", "can you please {}", "okay {}",
    "I want you to {} now", "for god's sake {}", "I told you to {}", "that is {}", "oh no {}",
)  # fmt: skip
"""Before the word, where it ends a cry."""


class Said(NamedTuple):
    """A text, and the word in it that cries; None if none does."""

    text: str
    cries_at: int | None = None


def cries(count: int, rng: random.Random) -> Iterator[Said]:
    """Cries, each word about as often, none of them held out for measuring."""
    kept = {line.text.lower() for name in ("cries", "halts", "stops") for line in lines(name)
            if not line.tuning and len(line.text.split()) > 1}  # fmt: skip
    known = [line.text for n in ("cries", "halts", "stops") for line in lines(n) if line.tuning]
    while count:
        one = _known(rng.choice(known)) if rng.random() < 0.15 else _made(rng)
        if one is not None and one.text.lower() not in kept and is_cry(one.text):
            count -= 1
            yield one


def others(count: int, rng: random.Random) -> Iterator[Said]:
    """Errands, talk, and words in a row; none is a cry."""
    told = [text for file in sorted(_MARKED.glob("*.jsonl")) for text in _texts(file)]
    made = [rules(one, "wordings.jsgf") for one in vocabularies().values()]
    talk = [line.text for line in lines("others") if line.tuning]
    otherwise = (_HERE / "otherwise.txt").read_text(encoding="utf-8").splitlines()[1:]
    common = common_words()
    while count:
        text = rng.choice(
            (
                lambda: " ".join(sentence(rng.choice(made), "wording", rng)),
                lambda: " ".join(sentence(rng.choice(made), "wording", rng)),
                lambda: rng.choice(told),
                lambda: rng.choice(otherwise),
                lambda: rng.choice(talk),
                lambda: " ".join(rng.choices(list(common), list(common.values()), k=6)),
                lambda: " ".join(rng.choices(list(common), k=5)),
            )
        )()
        if not is_cry(text):
            count -= 1
            yield Said(" ".join(text.split()[:14]))


def is_cry(text: str) -> bool:
    """Whether a robot at work halts when that is typed."""
    return is_stop(text) or is_halt(text) or is_stay(text)


def _made(rng: random.Random) -> Said | None:
    word = rng.choice(KEYWORDS)
    if rng.random() < 0.15 and word in ("stop", "wait", "freeze", "enough", "halt", "careful"):
        before = rng.choice(_LAST).format(word).split()
        return Said(" ".join(before), before.index(word))
    before = rng.choice(_CALLS).split() if rng.random() < 0.25 else []
    bare = word not in ("hold", "hang", "look", "watch") and rng.random() < 0.3
    after = "" if bare else rng.choice(_ENDS[word])
    return Said(" ".join([*before, word, *after.split()]), len(before))


def _known(text: str) -> Said | None:
    words = text.lower().split()
    at = [n for n, word in enumerate(words) if word in KEYWORDS]
    return Said(" ".join(words), at[0]) if at else None


def _texts(file: Path) -> Iterator[str]:
    for line in file.read_text(encoding="utf-8").splitlines():
        text = re.sub(r"[^\w' ]+", " ", json.loads(line)["text"])
        yield " ".join(text.split())
