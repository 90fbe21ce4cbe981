"""Words of English: what is written like one is no misspelling, however near a name it lies.

The list is that of symspellpy (MIT), 82,765 words in British spelling, read as a file: the package
itself is not imported.
"""

import re
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
_MORE = frozenset("mom mommy pajamas aluminum donut donuts jewelry cozy plow".split())
"""American words that differ from the British ones in another way."""


def is_english(word: str) -> bool:
    """Whether a lower-case word is one of English, in British or American spelling."""
    listed = _listed()
    if word in listed or word in _MORE:
        return True
    return any(british in listed for british in _respelled(word))


def _respelled(word: str) -> set[str]:
    return {american.sub(british, word) for american, british in _BRITISH} - {word}


@cache
def _listed() -> frozenset[str]:
    """The list, read when the first word is looked up: 30 ms and 8 MB that no stop needs."""
    spec = find_spec("symspellpy")
    assert spec is not None and spec.origin is not None, "symspellpy is a dependency"
    lines = (Path(spec.origin).parent / _LIST).read_text(encoding="utf-8-sig").splitlines()
    return frozenset(line.partition(" ")[0] for line in lines)
