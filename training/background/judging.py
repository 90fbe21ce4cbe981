"""How well the background of sentences is found, word by word and sentence by sentence."""

from collections.abc import Iterable

from intents.english.background.looks import said
from training.background.marked import Marked


def judged(seen: Iterable[tuple[Marked, list[float]]], *, sure: float = 0.5) -> str:
    """A line with figures.

    Args:
        seen: Sentences, and how likely each of their words was said to be background.
        sure: From what probability on a word counts as such.
    """
    found = right = there = whole = lost = n = 0
    for sentence, likely in seen:
        words = said(sentence.text)
        pairs = [
            (all(sentence.idle[w.start : w.end]), p >= sure)
            for w, p in zip(words, likely, strict=True)
            if not w.is_sign
        ]
        there += sum(is_ for is_, _ in pairs)
        found += sum(said_ for _, said_ in pairs)
        right += sum(is_ and said_ for is_, said_ in pairs)
        whole += all(is_ == said_ for is_, said_ in pairs)
        lost += any(said_ and not is_ for is_, said_ in pairs)
        n += 1
    return (
        f"{n} sentences: precision {right / max(1, found):.3f}, recall {right / max(1, there):.3f} "
        f"of words; {whole / max(1, n):.3f} whole; {lost / max(1, n):.3f} lose a word that asks"
    )
