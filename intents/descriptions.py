"""What tells which thing is meant, and is lost: "cups *that are not full*", "door *of the side*".

A description that comes back in no goal leaves any of them, and another one is as likely meant. It
is asked about, whatever reading passed it over.
"""

import re
from collections.abc import Iterable, Iterator

from intents.english.faithfulness import strings
from intents.english.words import lexicon
from intents.english.words.lexer import singular, words_in
from intents.english.words.names import NameIndex
from intents.goals import (
    Answer,
    Ask,
    Close,
    Goal,
    Open,
    Say,
    Switch,
    each,
    simple_conditions,
    to_builtins,
)  # fmt: skip
from intents.goals import If as Conditional

_SIGNS_OF_ONE = re.compile(r"\b(?:that|which|who|nobody|noone|of|o)\b")
_RELATIVE = lexicon.words("that which who")
_BEING = lexicon.words("is are was were has have had does do did can could will 's")
_NOBODY = lexicon.words("nobody noone")
_THINGS = lexicon.words(
    "one ones thing things something anything everything somebody someone anybody anyone everybody "
    "everyone person people"
)
_PLACED = lexicon.words(
    "there here left lying standing sitting hanging over still now just right straight back around "
    "about me you us them it him her ready nearest closest called named marked labelled"
)
"""What says where a thing is, or adds nothing."""
_PARTS = lexicon.words("door gate drawer window light lamp shelf cupboard cabinet curtain switch")
"""Of what there are several in most homes, so that "of the" tells which."""
_THOSE = lexicon.words("them those these the")
_ON = lexicon.words("on in at from by near behind under off")
_LINKS = lexicon.words("and but then so or because if when while , .")


def lost_description(text: str, goals: Iterable[Goal], index: NameIndex) -> str:
    """The description in a text that none of the goals carries; empty if there is none."""
    lower = text.lower()
    if _SIGNS_OF_ONE.search(lower) is None:
        return ""
    every = list(each(tuple(goals)))
    if any(isinstance(goal, Say | Ask | Answer) for goal in every):
        return ""
    plain = re.sub(r"n['’]t\b", " not", lower.replace("can't", "cannot"))
    words = [w for part in re.split(r"([,.;:!?—–]+)", plain) for w in (words_in(part) or [","])]
    told = {w for said in strings(every) for w in re.split(r"[\s_-]+", said)}
    told |= {singular(word) for word in told}
    denied = "'except':" in str(to_builtins(every)) or any(
        one.negated
        for goal in every
        if isinstance(goal, Conditional)
        for one in simple_conditions(goal.condition)
    )
    lost = [*_relatives(words, told, index, denied=denied), *_partitives(words, told, index)]
    if any(isinstance(goal, Open | Close | Switch) for goal in every):
        lost += _owners(words, told)
    return next(iter(lost), "")


def _relatives(
    words: list[str], told: set[str], index: NameIndex, *, denied: bool
) -> Iterator[str]:
    """Cups *that are not full*; somebody *who is not Ada*."""
    for at in range(1, len(words) - 1):
        begin = at + (words[at] in _RELATIVE)
        known = words[at - 1] in _THINGS or _ends_name(words, at, index)
        if not known or (
            words[begin] not in (_BEING if begin > at else ()) and (words[begin] not in _NOBODY)
        ):
            continue
        end = begin
        while end < len(words) and words[end] not in _LINKS:
            end += 1
        no = "not" in words[begin : begin + 2] or words[begin] in _NOBODY
        said = [w for w in words[begin + 1 : end] if w not in lexicon.FUNCTION_WORDS | _PLACED]
        kept = any(word in told or singular(word) in told for word in said)
        if said and not ((kept and not no) or (no and denied)):
            yield " ".join(words[at:end])


def _ends_name(words: list[str], at: int, index: NameIndex) -> bool:
    """Whether the name of a thing, or the last word of one, ends before a word."""
    if any(name.kind in ("object", "category") for name in index.partial(words[at - 1])):
        return True
    found = (index.match(words, begin) for begin in range(max(0, at - 4), at))
    return any(
        match is not None and match.end == at and match.of("object", "category") for match in found
    )


def _partitives(words: list[str], told: set[str], index: NameIndex) -> Iterator[str]:
    """A bowl, one *of those on the worktop*, where no goal says "worktop"."""
    for at in range(len(words) - 4):
        if words[at] not in lexicon.ONES or words[at + 1] not in ("of", "o", "o'"):
            continue
        if words[at + 2] not in _THOSE or words[at + 3] not in _ON:
            continue
        begin = at + 4 + (words[at + 4] in lexicon.DETERMINERS)
        match = index.match(words, begin)
        names = match.names if match else ()
        if names and not any(told.issuperset(name.name.lower().split()) for name in names):
            yield " ".join(words[at + 1 : match.end if match else begin])


def _owners(words: list[str], told: set[str]) -> Iterator[str]:
    """The door *of the side*, where no goal says "side"."""
    for at in range(1, len(words) - 1):
        if words[at] != "of" or singular(words[at - 1]) not in _PARTS:
            continue
        begin = at + 1 + (words[at + 1] in lexicon.DETERMINERS)
        said = words[begin] if begin < len(words) else ","
        if said.isalpha() and said not in told and said not in lexicon.FUNCTION_WORDS:
            yield " ".join(words[at : begin + 1])
