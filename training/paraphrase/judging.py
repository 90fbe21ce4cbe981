"""How well a network says what speakers meant whom it has not heard."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from intents.english.paraphrase.network import unpacked
from intents.english.paraphrase.paraphrasing import Heard, joined
from intents.english.words.names import index_of
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
