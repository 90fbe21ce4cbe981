"""How it is said of something that it is not meant: "not", "all but", "with the exception of"."""

from intents.english.words import lexicon
from intents.english.words.text import Text

_NOT = lexicon.phrases(
    "not,but not,and not,only not,except,except for,apart from,other than,besides,excluding,"
    "save for,aside from,with the exception of,not counting,leaving out,just not,anything but,"
    "any but,all but,but for"
)


def excluding_end(text: Text, at: int) -> int | None:
    """Where words end that begin at ``at`` and say that what follows is not meant."""
    return text.phrase_end(_NOT, at)


def is_excluded(text: Text, start: int, at: int) -> bool:
    """Whether what stands at a word is left out, by words from ``start`` on or "but" before it."""
    if any(excluding_end(text, n) for n in range(start, at)):
        return True
    ahead = at - (text.word(at - 1) in lexicon.DETERMINERS)
    return "but" in (text.word(at), text.word(ahead), text.word(ahead - 1), text.word(start - 1))
