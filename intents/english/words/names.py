"""The names of a vocabulary, found in text whatever the spelling, plural or synonym said."""

from collections import Counter
from collections.abc import Iterable
from functools import lru_cache
from typing import Literal, NamedTuple

from rapidfuzz import fuzz, process

from intents.english.words.lexer import singular, tokenize
from intents.english.words.lexicon import COLORS, SIZES, words
from intents.english.words.measures import number
from intents.english.words.synonyms import AKIN, SHORT_WORDS, SYNONYMS
from intents.vocabulary import Someone, Spot, Thing, Vocabulary

Kind = Literal["object", "category", "place", "room", "person"]


class Name(NamedTuple):
    """A name of the vocabulary, spelled as the vocabulary spells it."""

    kind: Kind
    name: str


class Match(NamedTuple):
    """Names that stand in the text and end before word ``end``; several if it is ambiguous."""

    end: int
    names: tuple[Name, ...]

    def of(self, *kinds: Kind) -> str | None:
        """The name, as one of these kinds."""
        return next((n.name for kind in kinds for n in self.names if n.kind == kind), None)


_LIKE = 78.0
"""How like a name has to be to be asked back for [%]: above it stand a word in common (90), a part
of the name (85) and, as the likeness of letters, one letter of five."""


_TITLES = {
    "doctor": "dr", "mister": "mr", "missus": "mrs", "professor": "prof", "saint": "st",
    "dr": "doctor", "mr": "mister", "mrs": "missus", "prof": "professor", "st": "saint",
}  # fmt: skip


def _likeness(said: str, name: str, *, score_cutoff: float | None = None) -> float:
    """How much a name is like what was said: misspelt, a part of it, or a word in common [%]."""
    del score_cutoff
    one, other = said.lower(), name.lower()
    words, others = one.split(), other.split()
    shared = {singular(w) for w in words} & {singular(w) for w in others}
    if any(len(w) > _PART for w in shared):
        return 90.0
    part = min(len(one), len(other)) > _PART and (one in other or other in one)
    return 85.0 if part else fuzz.ratio(one, other)


_SHORT_OR_LONG = SHORT_WORDS | {short: long for long, short in SHORT_WORDS.items()}
_INITIALS = 2
"""A name of more words is also called by the initials of all but its last."""
_BEGINNING = 32
"""So many letters tell what no name begins with; names of strangers may have thousands."""
_MANY_SENSES = words("counter paper bin glasses remote hall mobile study")
"""Words for other things that what is called so may be as well."""
_MOST_WORDS = 4096
"""So many words are remembered to be names or none."""
_PART = 2
"""A part that is no longer than this, "of" or "a", tells nothing."""


def _split(name: str) -> list[str]:
    return [t.text for t in tokenize(name) if t.text[0].isalnum()]


def _key(words: list[str]) -> str:
    """Spelling without blanks, singular: "side tables" and "sidetable" are one."""
    return "".join(w for w in words[:-1] if w != "'s") + singular(words[-1])


class NameIndex:
    """A vocabulary compiled for looking names up.

    Attributes:
        words: Every word of every name, singular and as spelled, and every colour of a thing.
        colors: Colour words and what they mean, with those that only this world has ("teal").
        furniture: Names of places that are walked up to and nothing else.
        rooms: Names of the rooms.
        looks: By name and by category, the colours of what is called so; "" for one not told.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        """Compile; takes a few hundred microseconds for a household."""
        self._names: dict[str, tuple[Name, ...]] = {}
        self._parts: dict[str, tuple[Name, ...]] = {}
        self._alone: dict[str, tuple[Name, ...]] = {}
        self._longest = 1
        told = {t.color: t.color for t in vocabulary.objects if t.color.isalpha()}
        self.colors = told | COLORS
        self.words: frozenset[str] = frozenset(told)
        self._variants = _variants(vocabulary)
        self.looks = _looks(vocabulary, self.colors)
        self._categories = {t.name: t.category for t in vocabulary.objects}
        self.rooms = tuple(dict.fromkeys(s.name for s in vocabulary.rooms))
        floors = [s.name for s in (*vocabulary.rooms, *vocabulary.places) if not s.furniture]
        self.furniture = frozenset(s.name for s in vocabulary.places).difference(floors)
        spellings = _spellings(vocabulary)
        taken = {_key(_split(s)) for _, s in spellings if _split(s)}
        aliases = [(n, s) for n, s in _aliases(vocabulary) if _key(_split(s)) not in taken]
        for name, spelling in spellings:
            self._add(name, spelling)
            self._add_parts(name, _split(spelling))
        for name, spelling in aliases:
            self._add_alias(name, spelling)
        # What no longer name begins with needs no looking for one: most words of a sentence.
        starts = {key[:_BEGINNING] for key in self._names}
        self._begins = {start[:end] for start in starts for end in range(1, len(start) + 1)}
        self._begins.add("'s")  # which counts for nothing

    def is_of(self, name: str, category: str | None) -> bool:
        """Whether a thing is of a category."""
        return bool(category) and self._categories.get(name) == category

    def _add(self, name: Name, spelling: str) -> None:
        words = _split(spelling)
        if not words:
            return
        counted = [number([word], 0) for word in words]
        figures = [f"{n.value:.0f}" if n else word for n, word in zip(counted, words, strict=True)]
        titled = [_TITLES.get(word, word) for word in words]
        for short in (figures, titled):
            if short != words and len(words) > 1:
                self._names.setdefault(_key(short), (name,))  # room 12 for room twelve
                self.words |= set(short)
        key = _key(words)
        known = self._names.get(key, ())
        if name not in known:
            self._names[key] = (*known, name)
        self._longest = max(self._longest, len(words) + 1)
        self.words |= {*words, singular(words[-1])}

    def _add_alias(self, name: Name, spelling: str) -> None:
        """Add another word for a name; where others end with it, any of them may be meant.

        Of a worktop and a shop counter "the counter" may be either; "the couch" is the sofa, though
        there is a television couch as well.
        """
        word = singular(spelling)
        if word not in _MANY_SENSES:
            self._add(name, spelling)
            return
        others = [other for other in self._parts.get(word, ()) if other.kind == name.kind]
        if any(singular(_split(other.name)[-1]) == word for other in others if other != name):
            self._parts[word] = (*self._parts[word], name)
        else:
            self._add(name, spelling)

    def _add_parts(self, name: Name, words: list[str]) -> None:
        parts = {singular(words[0]), singular(words[-1])} if len(words) > 1 else set[str]()
        parts |= {" ".join(words[:end]) for end in range(2, len(words))}
        for part in parts:
            if name not in self._parts.get(part, ()):
                self._parts[part] = (*self._parts.get(part, ()), name)

    def match(self, words: list[str], start: int) -> Match | None:
        """The longest name that begins at a word."""
        if start >= len(words):
            return None
        if words[start][:_BEGINNING] not in self._begins:
            return self._match_alone(words[start], start)
        longest = self._longest
        stop = min(len(words), start + longest)
        for end in range(start + 1, stop + 1):
            if not words[end - 1][0].isalnum() and words[end - 1] != "'s":
                stop = end - 1
                break
        for end in range(stop, start, -1):
            names = self._names.get(_key(words[start:end]))
            if names:
                return Match(end, names)
        return None

    def _match_alone(self, word: str, start: int) -> Match | None:
        """The names that a word stands for with which no longer name begins: many are plurals."""
        names = self._alone.get(word)
        if names is None:
            names = self._names.get(_key([word]), ()) if word[0].isalnum() else ()
            if len(self._alone) >= _MOST_WORDS:
                self._alone.clear()
            self._alone[word] = names
        return Match(start + 1, names) if names else None

    def variants(self, name: str) -> tuple[str, ...]:
        """What tells the things of a name apart, where each has a colour or size of its own."""
        return self._variants.get(name, ())

    def sibling(self, name: str, *, color: str | None = None, size: str | None = None) -> str:
        """The name that tells another colour or size: "blue mug" for "red mug" and blue.

        The name itself where it tells none; empty where no other is known.
        """
        words = _split(name)
        for meant, marks in ((color, self.colors), (size, SIZES)):
            at = next((n for n, word in enumerate(words[:-1]) if word in marks), None)
            if meant is None or at is None:
                continue
            alike = [said for said, mark in marks.items() if mark == meant]
            spelled = (" ".join([*words[:at], said, *words[at + 1 :]]) for said in alike)
            return next((n.name for said in spelled for n in self.exact(said)), "")
        return name

    def exact(self, spelling: str) -> tuple[Name, ...]:
        """The names that a spelling stands for."""
        words = _split(spelling)
        return self._names.get(_key(words), ()) if words else ()

    def partial(self, word: str) -> tuple[Name, ...]:
        """The longer names that words begin or a word ends: "table" in "dining table"."""
        return self._parts.get(singular(word), ())

    @property
    def knows_people(self) -> bool:
        """Whether the vocabulary names anybody."""
        return any(n.kind == "person" for names in self._names.values() for n in names)

    def like(self, said: str, kinds: tuple[str, ...]) -> list[str]:
        """Up to three names of these kinds that may well be meant by what was said."""
        known = sorted({n.name for names in self._names.values() for n in names if n.kind in kinds})
        plain = singular(said)
        found = process.extract(plain, known, scorer=_likeness, limit=3, score_cutoff=_LIKE)
        akin = [n for n in known if any({n, plain.split()[-1]} <= group for group in AKIN)]
        return [name for name, _, _ in found] or akin[:3]

    def nearest(self, said: str, kinds: tuple[str, ...]) -> list[str]:
        """Up to three names of these kinds that are written most like what was said."""
        known = sorted({n.name for names in self._names.values() for n in names if n.kind in kinds})
        # Only a hint behind a refusal, so it may be further off than what is asked back.
        found = process.extract(said, known, scorer=fuzz.WRatio, limit=3, score_cutoff=60)
        return [name for name, _, _ in found] or known[:3]


def _spellings(vocabulary: Vocabulary) -> list[tuple[Name, str]]:
    """Every name with every word given for it; categories before objects."""
    pairs: list[tuple[Name, str]] = []
    for category in vocabulary.categories:
        name = Name("category", category.singular)
        pairs += [(name, category.singular), (name, category.plural)]
    listed = {c.singular for c in vocabulary.categories}
    kinds: tuple[tuple[Kind, Iterable[Thing | Spot | Someone]], ...] = (
        ("object", vocabulary.objects),
        ("place", vocabulary.places),
        ("room", vocabulary.rooms),
        ("person", vocabulary.people),
    )
    for kind, entries in kinds:
        for entry in entries:
            name = Name(kind, entry.name)
            pairs += [(name, spelling) for spelling in (entry.name, *entry.synonyms)]
    for thing in vocabulary.objects:
        if thing.category and thing.category not in listed:
            pairs.append((Name("category", thing.category), thing.category))
    return pairs


def _variants(vocabulary: Vocabulary) -> dict[str, tuple[str, ...]]:
    """By name, the colours or else the sizes of several things that have it."""
    by_name: dict[str, list[Thing]] = {}
    for thing in vocabulary.objects:
        by_name.setdefault(thing.name, []).append(thing)
    told: dict[str, tuple[str, ...]] = {}
    for name, things in by_name.items():
        for marks in ([t.color for t in things], [t.size for t in things]):
            if len(things) > 1 and all(marks) and len(set(marks)) == len(marks):
                told.setdefault(name, tuple(marks))
    return told


def _looks(vocabulary: Vocabulary, meant: dict[str, str]) -> dict[str, frozenset[str]]:
    """By name and by category, the colours of the things that are called so."""
    found: dict[str, set[str]] = {}
    for thing in vocabulary.objects:
        for name in {thing.name, thing.category} - {""}:
            found.setdefault(name, set()).add(meant.get(thing.color, thing.color))
    return {name: frozenset(colors) for name, colors in found.items()}


def _aliases(vocabulary: Vocabulary) -> list[tuple[Name, str]]:
    """Common synonyms of names, where only one name of their group is in the vocabulary."""
    names = {_key(_split(n.name)): n for n, _ in _spellings(vocabulary) if _split(n.name)}
    pairs: list[tuple[Name, str]] = []
    for members in SYNONYMS:
        present = {names[_key(_split(m))] for m in members if _key(_split(m)) in names}
        if len(present) == 1:
            name = present.pop()
            pairs += [(name, member) for member in members]
    for name, spelling in _spellings(vocabulary):
        if name.kind == "room" and spelling.endswith(" room"):
            pairs.append((name, spelling.removesuffix("room") + "area"))
    spellings = _spellings(vocabulary)
    others = {(name, short) for name, spelling in spellings for short in _other_words(spelling)}
    spoken = Counter(_key(_split(short)) for _, short in (*pairs, *others))
    return pairs + [(n, short) for n, short in sorted(others) if spoken[_key(_split(short))] == 1]


def _other_words(spelling: str) -> list[str]:
    """A name in other words: bike pump, BP cuff (blood pressure cuff), cup red."""
    words = _split(spelling)
    short = [_SHORT_OR_LONG.get(word, word) for word in words]
    found = [" ".join(short)] if short != words else []
    if len(words) > _INITIALS and all(word.isalpha() for word in words):
        found.append("".join(word[0] for word in words[:-1]) + " " + words[-1])
    if len(words) == _INITIALS and words[0] in COLORS:
        found.append(f"{words[1]} {words[0]}")
    return found


@lru_cache(maxsize=8)
def index_of(vocabulary: Vocabulary) -> NameIndex:
    """The compiled vocabulary, kept from one sentence to the next."""
    return NameIndex(vocabulary)
