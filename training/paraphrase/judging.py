"""How well a network, and the whole, reads what speakers meant who were not heard."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from intents.context import Context
from intents.english.paraphrase.network import unpacked
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard, joined
from intents.english.words.names import index_of
from intents.goals import to_builtins
from intents.outcomes import Goals, Question
from intents.parser import first_look, parse
from intents.sameness import same
from training.marked import Marked
from training.paraphrase.examples import Pair

_LEVELS = (0.5, 0.7, 0.85, 0.95)


def judged(held: Iterable[Pair], file: Path) -> str:
    """Lines: what share is said word for word, and that of those it is so sure of.

    Args:
        held: sentences that were not learnt.
        file: the network.
    """
    with np.load(file) as stored:
        network = unpacked(dict(stored))
    count: Counter[str] = Counter()
    for one in held:
        said = Heard(one.source.text, index_of(one.source.vocabulary), network).paraphrase()
        wanted = [one.units[w].meant if isinstance(w, int) else w for w in one.plain]
        right = said.text == joined(wanted)
        count.update(all=1, right=right)
        for level in _LEVELS:
            if said.likely >= level:
                count.update({f"{level}": 1, f"{level} right": right})
    told = [f"word for word: {count['right'] / max(1, count['all']):.3f} of {count['all']}"]
    told += [
        f"surer than {level}: {count[f'{level}'] / max(1, count['all']):.3f}, "
        f"of those right {count[f'{level} right'] / max(1, count[f'{level}']):.3f}"
        for level in _LEVELS
    ]
    return "\n".join(told)


def understood(told: Iterable[tuple[Marked, str]]) -> str:
    """A line: what share of sentences is acted on as was meant, asked, refused, or else acted on.

    What asks for nothing or has to be asked about is right where nothing is done. Plain words that
    the grammar cannot read are not counted.

    Args:
        told: Sentences, each with its plain words.
    """
    count: Counter[str] = Counter()
    for one, plain in told:
        wanted = None if plain in (ASK, NOTHING) else first_look(plain, one.vocabulary, Context())
        meant = None if wanted is None else wanted.outcome
        if meant is not None and not isinstance(meant, Goals):
            continue
        found = parse(one.text, one.vocabulary)
        if isinstance(found, Goals):
            right = meant and same(to_builtins(meant.goals), to_builtins(found.goals))
            count["right" if right else "otherwise"] += 1
        elif meant is None:
            count["right"] += 1
        else:
            count["asked" if isinstance(found, Question) else "refused"] += 1
    every = max(1, count.total())
    shares = (f"{kind} {count[kind] / every:.1%}" for kind in ("right", "asked", "refused"))
    return f"{', '.join(shares)}, otherwise {count['otherwise'] / every:.1%} of {count.total()}"
