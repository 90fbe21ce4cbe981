"""A language model of three words, counted in sentences that a grammar makes up, in the ARPA form.

What was not counted has the chance of the last word alone, or of the last two: smoothing after
Witten and Bell (1991), in the form of Chen and Goodman (1999), section 2.6.
"""

from __future__ import annotations

import math
import random
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence

from intents.speech.jsgf import Node, Rules

BEGIN, END = "<s>", "</s>"
ORDER = 3
_NEVER = -99.0


def sentence(rules: Rules, root: str, rng: random.Random) -> list[str]:
    """A sentence that fits a rule, each alternative as likely as the others."""
    return _made(Node("rule", root), rules, rng)


def _made(node: Node, rules: Rules, rng: random.Random) -> list[str]:
    if node.kind == "word":
        return [node.text]
    if node.kind == "rule":
        return _made(rules[node.text], rules, rng)
    if node.kind == "choice":
        return _made(rng.choice(node.parts), rules, rng) if node.parts else []
    said = [word for part in node.parts for word in _made(part, rules, rng)]
    if node.kind == "repeat" and rng.random() < 0.3:
        return said + _made(node, rules, rng)
    return said


def arpa(sentences: Iterable[Sequence[str]], others: Mapping[str, float], share: float) -> str:
    """The model of sentences, with other words that may stand anywhere.

    Args:
        sentences: that are counted.
        others: how often each word is said at all, among them those that are in no sentence.
        share: of what is said that is no word of a sentence: how likely the `others` are.
    """
    counts: list[Counter[tuple[str, ...]]] = [Counter() for _ in range(ORDER)]
    for one in sentences:
        words = (BEGIN, *one, END)
        for order in range(ORDER):
            for at in range(max(1 - order, 0), len(words) - order):
                counts[order][words[at : at + order + 1]] += 1
    follow: list[dict[tuple[str, ...], list[int]]] = [defaultdict(lambda: [0, 0]) for _ in counts]
    for order in range(1, ORDER):
        for words, count in counts[order].items():
            seen = follow[order][words[:-1]]
            seen[0] += count
            seen[1] += 1
    single = _single(counts[0], others, share)
    chances: list[dict[tuple[str, ...], float]] = [single]
    for order in range(1, ORDER):
        found: dict[tuple[str, ...], float] = {}
        for words, count in counts[order].items():
            total, kinds = follow[order][words[:-1]]
            found[words] = (count + kinds * chances[-1][words[1:]]) / (total + kinds)
        chances.append(found)
    return "\n".join(_lines(chances, follow))


def _single(
    counted: Counter[tuple[str, ...]], others: Mapping[str, float], share: float
) -> dict[tuple[str, ...], float]:
    total, all_others = sum(counted.values()), sum(others.values())
    chance = {words: (1.0 - share) * count / total for words, count in counted.items()}
    for word, often in others.items():
        chance[(word,)] = chance.get((word,), 0.0) + share * often / all_others
    return chance


def _lines(
    chances: Sequence[Mapping[tuple[str, ...], float]],
    follow: Sequence[Mapping[tuple[str, ...], Sequence[int]]],
) -> Iterable[str]:
    chances = [{(BEGIN,): 0.0, **chances[0]}, *chances[1:]]
    yield "\\data\\"
    yield from (f"ngram {n}={len(found)}" for n, found in enumerate(chances, 1))
    for order, found in enumerate(chances):
        yield f"\n\\{order + 1}-grams:"
        for words in sorted(found):
            line = f"{math.log10(found[words]) if found[words] else _NEVER:.4f}\t{' '.join(words)}"
            if order + 1 < len(chances):
                total, kinds = follow[order + 1].get(words, (0, 0))
                line += f"\t{math.log10(kinds / (total + kinds)) if total else 0.0:.4f}"
            yield line
    yield "\n\\end\\\n"
