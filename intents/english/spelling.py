"""Misspelt words, corrected towards the vocabulary and the words of the grammar."""

from functools import lru_cache

from rapidfuzz.distance import OSA

from intents.english import lexicon
from intents.english.measures import NUMBER_WORDS, UNIT_WORDS
from intents.english.names import NameIndex, index_of
from intents.english.verbs import FIRST_WORDS, SENSES, base_form
from intents.vocabulary import Vocabulary

_PHRASES = (
    set(SENSES)
    | set(lexicon.SUPERLATIVES)
    | set(lexicon.POSTURES)
    | lexicon.CONNECTORS
    | lexicon.FILLERS
    | lexicon.OPENERS
)
GRAMMAR_WORDS = (
    {word for phrase in _PHRASES for word in phrase}
    | lexicon.FUNCTION_WORDS | lexicon.PERSON_NOUNS | lexicon.OBJECT_NOUNS | lexicon.CONTAINERS
    | lexicon.PLACE_NOUNS | lexicon.BODY_NOUNS | lexicon.EMPTY_ADJECTIVES | lexicon.CLOTHES
    | lexicon.OPERATOR_WORDS | lexicon.ONES | set(lexicon.COLORS) | set(lexicon.SIZES)
    | set(lexicon.GENDERS) | set(lexicon.LEVELS) | NUMBER_WORDS | UNIT_WORDS
    | lexicon.words("time day date name question quiz pose posture gesture wearing raising waving "
                    "pointing dressed named called many much located placed something yourself "
                    "joke weighs least most team holding seeing")
)  # fmt: skip
"""Every word that the grammar itself knows."""
COMMON_NOUNS = lexicon.words(
    "moon noon spoon moor book boot hook cook look cap cup cat hat bat mat map mop tap nap bowl "
    "ball bell bill bull doll table cable fable maple apple ample plate plane plant place shelf "
    "self shell chair hair stair lamp camp damp clamp desk disk risk bed bad bag bug beg box fox "
    "ox door floor sofa soda cola cold gold glass grass class brass drink brick brink fork work "
    "pork knife life wife bottle battle button cattle kettle settle lemon melon salmon water "
    "waiter later tea sea pea pear bear wear gear peach beach bench bread broad milk silk mail "
    "nail rail tail sail news song music radio movie alarm email list phone weather play taxi "
    "train ticket lights game card cards bank stock price house mouse home horse nurse purse car "
    "cart star bar jar can pan man van fan pen hen ten toy boy joy coin corn horn coat boat goat "
    "road read bead lead head soap soup sand hand land band wall ball hall mall call tower towel "
    "power flower shower paper pepper rice ice dice mice wine pine line lime time dime cake lake "
    "rake snake shake steak cookie rookie cream dream scream sauce source unicorn dragon rocket"
)
"""Words that mean themselves even where a name of the vocabulary is one letter away."""


def _slack(word: str) -> int:
    """How many edits a word of its length may be away from what was meant."""
    return 0 if len(word) < 4 else 1 if len(word) < 7 else 2


class Speller:
    """Corrects words towards one vocabulary."""

    def __init__(self, index: NameIndex) -> None:
        self._names = sorted(w for w in index.words if len(w) > 2)
        self._known = index.words | GRAMMAR_WORDS
        self._grammar = sorted(w for w in GRAMMAR_WORDS if len(w) > 3)

    def correct(self, word: str) -> list[str]:
        """The words that were meant: usually the word itself; "thecup" is two words."""
        if word in self._known or word in COMMON_NOUNS or not word.isalpha():
            return [word]
        past = word.removesuffix("d"), word.removesuffix("ed")
        if base_form(word) in FIRST_WORDS or any(w in FIRST_WORDS for w in past):
            return [word]
        return self._parts(word) or [self._nearest(word)]

    def _nearest(self, word: str) -> str:
        slack = _slack(word)
        ranked: list[tuple[float, str]] = []
        for penalty, words in ((0.0, self._names), (0.25, self._grammar)):
            for known in words:
                if abs(len(known) - len(word)) <= slack and slack:
                    distance = OSA.distance(word, known, score_cutoff=slack)
                    far = distance > slack or (distance > 1 and known[0] != word[0])
                    if not far:
                        ranked.append((distance + penalty + 0.5 * (known[0] != word[0]), known))
        if ranked:
            return min(ranked)[1]
        begun = [n for n in self._names if len(word) >= 4 and n.startswith(word)]
        return begun[0] if len(begun) == 1 and len(word) * 2 >= len(begun[0]) else word

    def _parts(self, word: str) -> list[str]:
        """Two words written as one, the first a small one; empty if it is not two words."""
        for size in (2, 3, 4, 5):
            head, tail = word[:size], word[size:]
            small = head in lexicon.FUNCTION_WORDS or (head,) in SENSES or head == "a"
            if small and len(tail) > 1 and tail in self._known:
                return [head, tail]
        return []


@lru_cache(maxsize=8)
def speller_of(vocabulary: Vocabulary) -> Speller:
    """The speller of a vocabulary, kept from one sentence to the next."""
    return Speller(index_of(vocabulary))
