"""What a noun phrase holds once it is read."""

from dataclasses import dataclass, field
from typing import Literal

from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.lexer import singular
from intents.english.words.measures import NUMBER_WORDS, UNIT_WORDS
from intents.english.words.names import Name
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Clothing, How, Part, Superlative

Noun = Literal[
    "name", "object", "person", "place", "one", "body", "pronoun", "operator", "here", "there",
    "unknown",
]  # fmt: skip


SAID_HOW: dict[How, str] = {
    "left": "to the left of",
    "right": "to the right of",
    "in_front": "in front of",
    "near": "next to",
}
"""How a relation is said, where that is not its own name."""


@dataclass(slots=True)
class Locative:
    """Where something is: a preposition and what follows it; ``how`` None is plain "at".

    Between two things, ``other`` is the second. With ``part`` it is said of furniture which part of
    it is meant ("*on* the left of the shelf"), without it what is beside it ("left of the oven").
    """

    how: How | None
    of: "NounPhrase"
    other: "NounPhrase | None" = None
    part: bool = False


@dataclass(slots=True)
class NounPhrase:
    """What was said of a thing, a person or a place, in words ``start`` to ``end``.

    Attributes:
        noun: What kind of noun it has; "name" means ``names`` holds names of the vocabulary.
        said: The noun as it was said.
        exact: The noun is a whole name, not a part of one.
        names: What the noun can stand for; several names of one kind mean that it is ambiguous.
        side: "left" or "right", of the body or of several things.
        places: Where it is, in the order said.
        other: It is the one that was not spoken of.
        part: Which part of it is meant: "the other end of the table".
        without: What of it is not meant: "all cups except the red one".
        owner: Whose it is, if that is a person.
        where: What was said, if the phrase is a place by what is there: "where the cup is".
    """

    start: int
    end: int
    noun: Noun = "unknown"
    said: str = ""
    exact: bool = True
    names: tuple[Name, ...] = ()
    determiner: str = ""
    color: str | None = None
    size: str | None = None
    superlative: Superlative | None = None
    count: int | Literal["all"] | None = None
    gender: Literal["male", "female"] | None = None
    posture: Literal["sitting", "standing", "lying"] | None = None
    gesture: str | None = None
    wearing: Clothing | None = None
    side: str = ""
    level: str = ""
    places: list[Locative] = field(default_factory=list[Locative])
    other: bool = False
    owner: str = ""
    where: str = ""
    part: Part | None = None
    without: "NounPhrase | None" = None

    @property
    def is_person(self) -> bool:
        """It can only be a person."""
        marked = self.gender or self.gesture or self.wearing
        return self.noun in ("person", "operator") or bool(marked) or self.name("person") != ""

    @property
    def is_spot(self) -> bool:
        """It names a place or room and nothing else."""
        if self.noun in ("here", "there", "place"):
            return True
        return self.noun == "name" and not self.name("object", "category", "person")

    def name(self, *kinds: str) -> str:
        """The first name of these kinds, or an empty string."""
        return next((n.name for kind in kinds for n in self.names if n.kind == kind), "")

    def all_names(self, *kinds: str) -> list[str]:
        """All names of these kinds."""
        return list(dict.fromkeys(n.name for n in self.names if n.kind in kinds))


_DEFINITE = lexicon.words("the my your our his her their these those")


def is_all(phrase: NounPhrase) -> bool:
    """Whether a phrase is of all there are: "the cups", but not "the glasses" one reads with."""
    said = phrase.said.split()
    plural = bool(said) and singular(said[-1]) != said[-1]
    named = any(phrase.said == name.name.lower() for name in phrase.names)
    if named or not plural or phrase.noun != "name" or phrase.determiner not in _DEFINITE:
        return False
    return not (phrase.count or phrase.superlative or phrase.other)


SOMETHING = lexicon.words("something anything everything")
_NO_NOUN = (
    lexicon.FUNCTION_WORDS | lexicon.ADVERBS | NUMBER_WORDS | (UNIT_WORDS - lexicon.BODY_NOUNS)
    | lexicon.words("located placed situated wearing raising pointing waving named called dressed "
                    "standing sitting lying laying weighs weigh weight weights doing making once "
                    "no not got twice thrice closed opened need needs belong belongs only ends "
                    "lands winds hiding hidden tucked sat stood lurking perched parked dumped lain "
                    "stuck propped stashed stowed sprawled scattered strewn "
                    "gets wants asked ordered requested requires fancies asks gone called alone "
                    "moved brought lie required needed wanted wanting needing "
                    "know too went using instead rather except excluding apart plus")
)  # fmt: skip


def is_content(text: Text, at: int) -> bool:
    """Whether a word can be part of a noun: no function word, number or sign."""
    word = text.word(at)
    apart = word in ("other", "different") and text.word(at + 1) in ("than", "from", "to")
    return word[0].isalpha() and word not in _NO_NOUN and not apart


_LOCATING = frozenset(phrase[0] for phrase in lexicon.LOCATIVES)


def is_at_it(text: Text, at: int) -> bool:
    """Whether a participle only says how something is where it is: *hiding* behind the box."""
    word = text.word(at)
    if not word.endswith("ing") or text.word(at + 1) not in _LOCATING or text.name_at(at):
        return False
    return not verbs_at(text.words, at) and is_english(word)
