"""Words of English: what is written like one is no misspelling, however near a name it lies.

The list is that of symspellpy (MIT), 82,765 words in British spelling, read as a file: the package
itself is not imported.
"""

import re
from bisect import bisect_left
from functools import cache
from importlib.util import find_spec
from pathlib import Path

_LIST = "frequency_dictionary_en_82_765.txt"
_BRITISH = tuple(
    (re.compile(american), british)
    for american, british in (
        (r"or(?=s?$|ed$|ing$|ite)", "our"),  # neighbor, favorite
        (r"er(?=s?$)", "re"),  # theater, centimeter
        (r"iz(?=e|ing)", "is"),  # organize
        (r"og(?=s?$)", "ogue"),  # catalog
        (r"l(?=ed$|ing$|er$)", "ll"),  # traveling
    )
)
"""How American spellings are made British, to be found in the list."""
_MORE = {"mom", "mommy", "pajamas", "aluminum", "donut", "donuts", "jewelry", "cozy", "plow"}
"""American words that differ from the British ones in another way."""


def is_english(word: str) -> bool:
    """Whether a lower-case word is one of English, in British or American spelling."""
    return word in _MORE or any(map(_is_listed, (word, *_respelled(word))))


def _respelled(word: str) -> set[str]:
    return {american.sub(british, word) for american, british in _BRITISH} - {word}


def _is_listed(word: str) -> bool:
    words, sought = _listed(), word.encode()
    at = bisect_left(words, sought)
    return at < len(words) and words[at] == sought


@cache
def _listed() -> list[bytes]:
    """The list, sorted, read when the first word is looked up (40 ms).

    4 MB as sorted bytes; as a set of strings it takes 10 MB, and 18 while it is made.
    """
    spec = find_spec("symspellpy")
    assert spec is not None and spec.origin is not None, "symspellpy is a dependency"
    with (Path(spec.origin).parent / _LIST).open("rb") as lines:
        return sorted(line.partition(b" ")[0] for line in lines)
