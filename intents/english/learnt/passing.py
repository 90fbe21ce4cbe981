"""What is left of a sentence without its background, and how sure that is."""

from itertools import pairwise
from typing import NamedTuple

from intents.english.clauses.parentheses import INTERJECTIONS
from intents.english.faithfulness import CARRYING
from intents.english.learnt.background import Passed, background
from intents.english.learnt.looks import said
from intents.english.learnt.sight import Sight
from intents.english.trouble import listing
from intents.english.words import lexicon
from intents.english.words.courtesy import ADDRESSES
from intents.english.words.dictionary import is_english
from intents.english.words.limits import CONDITIONS, DENIALS, MEASURES, TIMES
from intents.english.words.names import NameIndex

_SURE = 0.8
"""From here on something is passed over at the first attempt, below it at the second."""
_SURE_OF_TALK, _TALK = 0.65, 4
"""The same for at least so many words: nobody orders what is not known at such length."""
_LIKELY, _POSSIBLE = 0.5, 0.25
"""From here on something is passed over at the second attempt, and at the third."""
_SURE_OF_MUCH = 0.95
"""So sure words are passed over that change what is asked more often than not: a number, a time."""
_CHANGING = (
    CARRYING | MEASURES | DENIALS | (TIMES - lexicon.words("before after while then"))
    | lexicon.words("times clock with using to into onto")
)  # fmt: skip
_LIMITS = CONDITIONS | lexicon.words("only twice thrice")
"""What holds one of these is never passed over, however sure the tagger is."""
_POLITE = lexicon.words("mind please possible convenient kind moment dare you'd")
"""With one of these "if" is only courtesy."""
_WHOSE = lexicon.words("i you he she we they that which who whose")
"""After a name these may begin what says which is meant: "the cap she is wearing"."""
_ARTICLES = lexicon.words("the a an some")
_ASIDES = lexicon.LISTED | ADDRESSES | INTERJECTIONS
"""What is said beside an order in a single word."""
_EDGES = " ,.;:!?-–—…"


class Remainder(NamedTuple):
    """What is left of a sentence.

    Attributes:
        text: The sentence without its background.
        spans: The characters that were passed over, from where to where.
        passed: What was passed over, in quotation marks, as a list in words.
        plain: Whether none of it may say which thing is meant, or how.
    """

    text: str
    spans: tuple[tuple[int, int], ...]
    passed: str
    plain: bool


def remainders(text: str, seen: Sight, index: NameIndex) -> list[Remainder]:
    """What may be left of a sentence, the surest first; empty if nothing can be passed over."""
    likely, possible = (
        [span for span in background(seen.words, seen.idle, least) if not _limits(text, span)]
        for least in (_LIKELY, _POSSIBLE)
    )
    sure = [span for span in likely if _is_harmless(text, span, index)]
    found: list[Remainder] = []
    for spans in (sure, likely, possible):
        left = _left(text, spans, index)
        if spans and any(map(str.isalnum, left.text)) and left not in found:
            found.append(left)
    return found


def _limits(text: str, span: Passed) -> bool:
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    heard = [word for word in words if word[0].isalnum()]
    denied = "not" in heard[:2] or any(  # "but not before noon"
        one == "not" and two in TIMES for one, two in pairwise(heard)
    )
    return denied or (bool(_LIMITS.intersection(words)) and not _POLITE.intersection(words))


def _is_harmless(text: str, span: Passed, index: NameIndex) -> bool:
    """Whether nothing in it is likely to say which thing is meant, how many, when or how."""
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    named = any(index.match(words, at) for at in range(len(words)))
    much = named or bool(_CHANGING.intersection(words))
    least = _SURE_OF_MUCH if much else _SURE_OF_TALK if len(words) >= _TALK else _SURE
    return span.sure >= least and not _describes(text, span, index) and not _is_terse(words)


def _is_terse(words: list[str]) -> bool:
    """Whether it may be an order or a thing in a single word: "juggle", "and a saucer"."""
    heard = [word for word in words if word[0].isalnum() and word not in lexicon.FUNCTION_WORDS]
    return len(heard) == 1 and is_english(heard[0]) and heard[0] not in _ASIDES


def _describes(text: str, span: Passed, index: NameIndex) -> bool:
    """Whether it may say which thing is meant, how, or be the name of another."""
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
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


def _left(text: str, spans: list[Passed], index: NameIndex) -> Remainder:
    left = text
    for span in reversed(spans):
        left = f"{left[: span.start].rstrip()} {left[span.end :].lstrip()}"
    quoted = [f"“{text[span.start : span.end].strip(_EDGES)}”" for span in spans]
    plain = all(_is_harmless(text, span, index) for span in spans)
    where = tuple((span.start, span.end) for span in spans)
    return Remainder(left.strip(), where, listing(quoted, "and"), plain)
