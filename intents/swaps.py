"""What is said to be meant in place of what, by name: "not the bottle, the box".

It says itself which order it corrects: the one that speaks of the bottle, be it the last or not.
"""

import re
from collections.abc import Iterable
from typing import NamedTuple

from msgspec.structs import replace

from intents.context import Context
from intents.english.faithfulness import strings
from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.goals import Goal, ObjectQuery, Person, each

_SIGN = r"\s*[,;:.!—–-]+\s*"
_LEAD = (
    rf"\W*(?:(?:oh|no|nope|oops|sorry|wait|actually|rather|please|i mean|i meant|i said|make (?:it|"
    rf"that)|correction)(?:{_SIGN}|\s+))*"
)
_TAIL = r"(?:\W+(?:please|instead|rather|i mean|i meant|sorry))*\W*"
_PHRASE = r"(?!(?:do|please|thanks?|thank|robot|sorry|okay|ok|now)\b)[\w'’]+(?: [\w'’]+){0,6}?"
_LEFT = (
    r"(?:not|(?:do not|don['’]?t|never) \w+(?: (?:me|us|him|her|them))?|never mind|"
    r"forget(?: about)?|leave|skip|drop|scratch)"
)
_DENIED_FIRST = re.compile(
    rf"{_LEAD}{_LEFT} (?P<old>{_PHRASE})(?:{_SIGN}(?:but )?| but )"
    rf"(?:(?:rather|i mean|i meant|it['’]?s)\s+)?(?P<new>{_PHRASE}){_TAIL}",
    re.IGNORECASE,
)
_DENIED_LAST = re.compile(
    rf"{_LEAD}(?:(?:take|use|choose) )?(?P<new>{_PHRASE})(?:{_SIGN}|\s+)"
    rf"(?:and )?(?:not|instead of|rather than|in place of) (?P<old>{_PHRASE}){_TAIL}",
    re.IGNORECASE,
)
_NO_NAMES = lexicon.DETERMINERS | lexicon.words(
    "one ones on in to at from into onto by with for of"
)


class Swap(NamedTuple):
    """What is not meant, and what is.

    ``by_name`` says that there is no more in it: the new order is to be like the old one but for
    that, as it may as well be one of its own ("put it on the shelf, not on the table").
    """

    old: str
    new: str
    by_name: bool


def swap(text: str) -> Swap | None:
    """What a sentence says to be meant in place of what; None if it says nothing of the kind."""
    for pattern in (_DENIED_FIRST, _DENIED_LAST):
        found = pattern.fullmatch(text.strip())
        if found:
            return Swap(found["old"], found["new"], by_name=pattern is _DENIED_LAST)
    return None


def speaks_of(goals: Iterable[Goal], said: str) -> bool:
    """Whether goals speak of all that a phrase names."""
    told = {word for value in strings(goals) for word in re.split(r"[\s_-]+", value)}
    words = _names(said)
    return bool(words) and words <= {form for word in told for form in (word, singular(word))}


def focused(context: Context, said: str) -> Context | None:
    """A context in which "it" and "there" are what a phrase names of the goals; None if nothing is.

    Something said after "no" takes the place of that then.
    """
    if not speaks_of(context.goals, said):
        return None
    words = _names(said)
    found = [value for value in _parts(context.goals) if words & _words_in(value)]
    thing = next((one for one in found if isinstance(one, ObjectQuery)), context.object)
    person = next((one for one in found if isinstance(one, Person)), context.person)
    place = next((one for one in found if isinstance(one, str)), context.place)
    return replace(context, object=thing, person=person, place=place, question=None)


def is_alike(goals: tuple[Goal, ...], others: tuple[Goal, ...]) -> bool:
    """Whether goals are others with one thing, person or place in each in place of another."""
    if len(goals) != len(others) or list(map(type, goals)) != list(map(type, others)):
        return False
    pairs = zip(goals, others, strict=True)
    return all(
        sum(getattr(one, name) != getattr(other, name) for name in one.__struct_fields__) <= 1
        for one, other in pairs
    )


def _parts(goals: tuple[Goal, ...]) -> list[ObjectQuery | Person | str]:
    """What stands in goals."""
    values = [getattr(goal, name) for goal in each(goals) for name in goal.__struct_fields__]
    return [one for one in values if isinstance(one, ObjectQuery | Person | str)]


def _words_in(value: ObjectQuery | Person | str) -> set[str]:
    told = [value] if isinstance(value, str) else _texts(value)
    return {singular(word) for one in told for word in re.split(r"[\s_-]+", one.lower())}


def _texts(value: ObjectQuery | Person) -> list[str]:
    fields = (getattr(value, name) for name in value.__struct_fields__)
    return [one for one in fields if isinstance(one, str)]


def _names(said: str) -> set[str]:
    words = re.findall(r"\w+", said.lower())
    return {singular(word) for word in words} - _NO_NAMES
