"""Misspelt words, corrected towards the vocabulary and the words of the grammar."""

import re
from functools import lru_cache
from importlib.resources import files

from rapidfuzz import process
from rapidfuzz.distance import OSA

from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.measures import NUMBER_WORDS, UNIT_WORDS
from intents.english.words.names import NameIndex, index_of
from intents.english.words.properties import PROPERTIES
from intents.english.words.verbs import FIRST_WORDS, SENSES, base_form
from intents.vocabulary import Vocabulary

_PHRASES = (
    set(SENSES)
    | set(lexicon.SUPERLATIVES)
    | set(lexicon.POSTURES)
    | set(lexicon.LOCATIVES)
    | lexicon.CONNECTORS
    | lexicon.FILLERS
    | lexicon.OPENERS
)
GRAMMAR_WORDS = (
    {word for phrase in _PHRASES for word in phrase}
    | lexicon.FUNCTION_WORDS | lexicon.PERSON_NOUNS | lexicon.OBJECT_NOUNS | lexicon.CONTAINERS
    | lexicon.PLACE_NOUNS | lexicon.BODY_NOUNS | lexicon.EMPTY_ADJECTIVES | lexicon.CLOTHES
    | lexicon.OPERATOR_WORDS | lexicon.ONES | set(lexicon.COLORS) | set(lexicon.SIZES)
    | set(lexicon.GENDERS) | set(lexicon.LEVELS) | NUMBER_WORDS | UNIT_WORDS | set(PROPERTIES)
)  # fmt: skip
"""Every word that the grammar itself knows."""
CORE = lexicon.words(
    "please bring take place pick grab grasp find locate search look follow guide escort lead "
    "meet greet introduce tell answer count open close switch turn walk move navigate deliver "
    "give hand stand balance squat wait stop pause continue cancel repeat report left right "
    "forward backward degrees metres meters seconds minutes person people object objects largest "
    "biggest smallest heaviest lightest thinnest leftmost rightmost yellow orange purple black "
    "white brown green where there under behind between above next then after from with into onto "
    "towards question sitting standing lying waving raising pointing wearing something kitchen "
    "bathroom bedroom table shelf counter could would second robot three seven eight thing things "
    "red blue pink"
)
"""The words of the grammar that misspelt words are corrected to."""
_MORE_VERBS = lexicon.words(
    "identify announce recognize inspect examine collect gather describe explain rotate describe "
    "approach accompany proceed retrieve transport carry offer serve inform notify speak point "
    "chuck shove stash dump toss fling plonk plop shift "
    "drop release remove return enter visit fetch grasp lift lower raise hold throw"
)
_VERBS = sorted(w for w in FIRST_WORDS if len(w) > 3 and w in CORE | _MORE_VERBS)
_SHORT_VERBS = ("put", "get", "lay", "set")
COMMON_WORDS = frozenset(
    (files("intents.english.words") / "common_words.txt").read_text(encoding="utf-8").split()
)
"""Words of every day, which nobody is called."""
KNOWN_WORDS = GRAMMAR_WORDS | COMMON_WORDS | {"once", "twice", "thrice", "only"}
"""Words that are no misspellings, and nobody's name."""


_SHORTEST, _LONG = 4, 9
"""A verb of fewer letters is a letter away from too many words; a long one may have two wrong."""
_KEPT = 5000
"""So many corrections are remembered: a bound on memory, far beyond what one conversation says."""


def _slack(word: str) -> int:
    """How many edits a word of its length may be away from what was meant."""
    return 0 if len(word) < 4 else 1 if len(word) < 7 else 2


def _typing_slip(word: str) -> str | None:
    """What a short word with letters swapped, doubled or missing is: "rde", "onn", "blu"."""
    swaps = (word[:i] + word[i + 1] + word[i] + word[i + 2 :] for i in range(len(word) - 1))
    if len(word) == _SHORTEST - 1:
        meant = {w for w in swaps if w in CORE}
        meant = meant or {c for c in lexicon.COLORS if c.startswith(word)}
        if len(meant) == 1:
            return meant.pop()
    single = re.sub(r"(.)\1+$", r"\1", word)
    return single if single != word and single in lexicon.FUNCTION_WORDS else None


def _beside(one: str, other: str) -> bool:
    """Whether two words begin with keys that lie side by side, or with the same two letters."""
    rows = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
    here, there = (
        next(((y, row.index(word[0])) for y, row in enumerate(rows) if word[0] in row), (9, 0))
        for word in (one, other)
    )
    near = abs(here[0] - there[0]) < 2 and -2 < here[1] - there[1] < 2
    return near or set(one[:2]) == set(other[:2])


class Speller:
    """Corrects words towards one vocabulary."""

    def __init__(self, index: NameIndex) -> None:
        self._names = sorted(w for w in index.words if len(w) > 2)
        self._names_said = index.words
        self._known = index.words | GRAMMAR_WORDS
        self._grammar = sorted(CORE)
        self._corrected: dict[tuple[str, bool], list[str]] = {}

    def correct(self, word: str, *, begins: bool = False) -> list[str]:
        """The words that were meant: usually the word itself; "thecup" is two words.

        Where a clause begins a verb is more likely than a name.
        """
        if word in self._known or word in COMMON_WORDS or not word.isalpha():
            return [word]
        if word[:-1] in lexicon.COLORS and word[-2:-1] == word[-1]:
            return [word[:-1]]  # "redd" is in the list, and nobody says it
        if is_english(word):
            return [word]
        past = word.removesuffix("d"), word.removesuffix("ed")
        if base_form(word) in FIRST_WORDS or any(w in FIRST_WORDS for w in past):
            return [word]
        swapped = _typing_slip(word)
        if swapped:
            return [swapped]
        single = re.sub(r"(.)\1+$", r"\1", word)
        if len(single) > 1 and single in self._names_said:
            return [single]  # tvv
        verb = self._verb(word) if begins else None
        if verb:
            return [verb]
        if (word, begins) not in self._corrected:
            if len(self._corrected) > _KEPT:
                self._corrected.clear()
            meant = self._parts(word) or [self._nearest(word, begins=begins)]
            self._corrected[word, begins] = meant
        return self._corrected[word, begins]

    def _verb(self, word: str) -> str | None:
        """The verb that a word may be a misspelling of; begins and length tell."""
        slack = 0 if len(word) < _SHORTEST else 1 if len(word) < _LONG else 2
        if slack and word[:-1] in _SHORT_VERBS:
            return word[:-1]
        found = process.extractOne(word, _VERBS, scorer=OSA.distance, score_cutoff=slack)
        return found[0] if slack and found and found[0][0] == word[0] else None

    def _nearest(self, word: str, *, begins: bool) -> str:
        slack = _slack(word)
        ranked: list[tuple[float, str]] = []
        # Penalties under one edit: they only decide between words that are equally far. A name is
        # likelier misspelt than a word of every day, a first letter is seldom wrong.
        for penalty, words in ((0.0, self._names), (0.25, self._grammar)) if slack else ():
            for known, distance, _ in process.extract(
                word, words, scorer=OSA.distance, score_cutoff=slack, limit=4
            ):
                elsewhere = known[0] != word[0]
                if elsewhere and begins and len(known) == len(word) and not _beside(known, word):
                    continue  # "yeet" is a verb of its own, and not "meet"
                if distance < 2 or not elsewhere:
                    ranked.append((distance + penalty + 0.5 * elsewhere, known))
        if ranked:
            return min(ranked)[1]
        begun = [n for n in self._names if len(word) >= 4 and n.startswith(word)]
        return begun[0] if len(begun) == 1 and len(word) * 2 >= len(begun[0]) else word

    def _parts(self, word: str) -> list[str]:
        """Two words written as one, the first a small one; empty if it is not two words."""
        for size in (2, 3, 4, 5):
            head, tail = word[:size], word[size:]
            small = head in lexicon.FUNCTION_WORDS or (head,) in SENSES
            ends = len(tail) > 2 and tail in self._known
            if small and ends:
                return [head, tail]
        return []


@lru_cache(maxsize=8)
def speller_of(vocabulary: Vocabulary) -> Speller:
    """The speller of a vocabulary, kept from one sentence to the next."""
    return Speller(index_of(vocabulary))
