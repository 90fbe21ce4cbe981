"""What is left of a sentence without its background, and how sure that is."""

from typing import NamedTuple

from intents.english.faithfulness import CARRYING
from intents.english.learnt.background import Passed, background
from intents.english.learnt.looks import said
from intents.english.trouble import listing
from intents.english.words import lexicon
from intents.english.words.measures import UNIT_WORDS
from intents.english.words.names import NameIndex

SURE = 0.8
"""From here on what is passed over is only remarked on; below it is asked about."""
_SURE_OF_MUCH = 0.95
"""The same for words that change what is asked more often than not: a number, a condition."""
_CHANGING = (
    CARRYING | UNIT_WORDS
    | lexicon.words("not never no without when whenever once times clock with using to into onto")
)  # fmt: skip
_LIMITS = lexicon.words(
    "until till unless if provided providing assuming except besides only twice thrice"
)
"""What holds one of these is never passed over, however sure the tagger is."""
_POLITE = lexicon.words("mind please possible convenient kind moment dare you'd")
"""With one of these "if" is only courtesy."""
_WHOSE = lexicon.words("i you he she we they that which who whose")
"""After a name these may begin what says which is meant: "the cap she is wearing"."""
_ARTICLES = lexicon.words("the a an some")
_EDGES = " ,.;:!?-–—…"


class Remainder(NamedTuple):
    """What is left of a sentence.

    Attributes:
        text: The sentence without its background.
        passed: What was passed over, in quotation marks, as a list in words.
        sure: Whether that needs no asking.
    """

    text: str
    passed: str
    sure: bool


def remainders(text: str, index: NameIndex) -> list[Remainder]:
    """What may be left of a sentence, the surest first; empty if nothing can be passed over."""
    spans = [span for span in background(text, index) if not _limits(text, span)]
    sure = [span for span in spans if _is_sure(text, span, index)]
    kept = [_left(text, some, sure=some is sure) for some in (sure, spans) if some]
    if len(sure) == len(spans):
        kept = kept[:1]
    return [one for one in kept if any(c.isalnum() for c in one.text)]


def _limits(text: str, span: Passed) -> bool:
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    denied = "not" in [word for word in words if word[0].isalnum()][:2]  # "but not before noon"
    return denied or (bool(_LIMITS.intersection(words)) and not _POLITE.intersection(words))


def _is_sure(text: str, span: Passed, index: NameIndex) -> bool:
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    if _describes(text, span, words, index):
        return False
    named = any(index.match(words, at) for at in range(len(words)))
    much = named or bool(_CHANGING.intersection(words))
    return span.sure >= (_SURE_OF_MUCH if much else SURE)


def _describes(text: str, span: Passed, words: list[str], index: NameIndex) -> bool:
    """Whether it may say which thing is meant, how, or be the name of another."""
    before = [word.raw.lower() for word in said(text[: span.start])]
    heard = [word for word in words if word[0].isalnum()]
    manner = len(heard) == 1 and heard[0].endswith("ly")
    verbless = not lexicon.AUXILIARIES.intersection(heard) and "'" not in "".join(heard)
    thing = len(heard) < 6 and verbless and bool(_ARTICLES.intersection(heard[:-1]))
    named = any(
        match is not None and match.end == len(before)
        for match in (index.match(before, at) for at in range(max(0, len(before) - 4), len(before)))
    )
    return manner or thing or (named and words[0] in _WHOSE)


def _left(text: str, spans: list[Passed], *, sure: bool) -> Remainder:
    left = text
    for span in reversed(spans):
        left = f"{left[: span.start].rstrip()} {left[span.end :].lstrip()}"
    quoted = [f"“{text[span.start : span.end].strip(_EDGES)}”" for span in spans]
    return Remainder(left.strip(), listing(quoted, "and"), sure)
