"""The grammar's reading checked by the network, which did not make it: where it doubts, one asks.

The reading is put in the plain words that the network writes, and it tells how likely it finds
each of them; what that says of the reading was learnt (:mod:`intents.english.learnt.check`).
Nothing is done that would not have been done without it: it only turns doing into asking.
"""

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from intents.english.learnt.check import Said, Witness, check, is_unfamiliar
from intents.english.learnt.choice import Name, alone
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.plainness import is_plainly_put
from intents.english.learnt.sight import sight
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard, Paraphrase
from intents.english.paraphrase.source import units, words_of
from intents.english.trouble import Partly
from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.names import NameIndex
from intents.goals import (
    Cancel,
    Goal,
    GoTo,
    ObjectQuery,
    Pause,
    Person,
    Say,
    Stop,
    Tell,
    to_builtins,
)
from intents.outcomes import Goals
from intents.plain_words import plainly
from intents.sameness import same
from intents.second_look import LONGEST, Attempt, Grammar, is_plain, just_that
from intents.third_look import GREETING, STRANGE, Hearing, names_in, refers, side_of


class _Bounds(NamedTuple):
    """Below how much [0..1] a reading is doubted, by how plainly the sentence is put.

    Attributes:
        asked: By the check: it is asked about.
        checked: By itself: it is checked at all.
    """

    asked: float
    checked: float


_PLAIN, _NEARLY, _FREELY = _Bounds(0.25, 0.7), _Bounds(0.42, 0.7), _Bounds(0.55, 0.85)
"""For a sentence that is plainly put, but for one word, and else. Of 1,270 readings of worlds that
the check had not seen 320 are checked and 81 asked about, of which 50 were not meant."""
_HARMLESS = (Stop, Pause, Cancel)
_TAKEN_BACK = lexicon.words("no nope instead rather")
"""With these the grammar knows what takes whose place, and the network seldom."""
_QUOTED = re.compile(r"[\"“”]|(?<!\w)'\w[^']*'(?!\w)")
_FEWEST_TOLD, _LONGEST_FRAME, _TAIL = 3, 9, 3
"""So few words of a message, so many beside it, and fewer behind it ("..., pet") leave no doubt
what was to be said."""
_QUOTES, _YOU = "“”", lexicon.words("you your yours yourself 're 've are have do were don't")


class Hears:
    """Hears each sentence once, whoever asks."""

    def __init__(self) -> None:
        """Nothing is heard yet."""
        self._text, self._heard = "", dict[int, Heard]()

    def __call__(self, text: str, index: NameIndex) -> Heard:
        """A sentence as the network has read it."""
        if text != self._text or id(index) not in self._heard:
            self._text, self._heard = text, {id(index): Heard(text, index)}
        return self._heard[id(index)]


def checked(
    text: str,
    index: NameIndex,
    before: Attempt,
    read: Grammar,
    *,
    follows: bool = False,
    hear: Hearing = Heard,
    fields: Fields = LEARNT,
) -> Attempt:
    """A reading of the grammar, or a question whether it is meant.

    Args:
        text: What was said.
        index: The names of this world.
        before: What the grammar made of it.
        read: The grammar.
        follows: Whether something was said before, which the network has not heard.
        hear: What says it in plain words; by default the network that comes with the package.
        fields: What was learnt; by default what comes with the package.
    """
    said = to_check(text, index, before, read, follows=follows, hear=hear, fields=fields)
    if said is None or check(said, fields) >= _bounds(text, said.names).asked:
        return before
    doubt = Partly("I am not sure that I got that", before.goals)
    return before._replace(outcome=just_that(text, doubt))


def to_check(
    text: str,
    index: NameIndex,
    before: Attempt,
    read: Grammar,
    *,
    follows: bool = False,
    certain: float | None = None,
    hear: Hearing = Heard,
    fields: Fields = LEARNT,
) -> Said | None:
    """A reading with what the network thinks of it.

    Args:
        text: What was said; this and all else, see `checked`.
        index: See there.
        before: See there.
        read: See there.
        follows: See there.
        certain: What is likelier than this by itself is not checked [0..1]; by default as it is
            where the check is made.
        hear: See there.
        fields: See there.

    Returns:
        None where there is nothing to check, or the network cannot: of a few words it makes little,
        and it has not heard what they refer to.
    """
    harmless = all(isinstance(goal, _HARMLESS) for goal in before.goals)
    if not isinstance(before.outcome, Goals) or harmless or not _is_weighable(text):
        return None
    if is_unfamiliar(before.goals) or _only_repeats(text, before.goals):
        return None
    names, own = names_in(text, index), side_of(before, "whole", sight(text, index))
    by_itself = alone(text, names, own, fields)
    certain = _bounds(text, names).checked if certain is None else certain
    if by_itself >= certain or refers(text, follows=follows):
        return None
    heard = hear(text, index)
    if not heard.is_whole:
        return None
    said = heard.paraphrase()
    other = None if said.text in (ASK, NOTHING) else read(said.text)
    put = _told_there(own.goals)
    witness = _witness(said, other, put)
    found = _finds(heard, put, index)
    return Said(text, names, own.goals, own.told, by_itself, found, witness, said.likely)


def _is_weighable(text: str) -> bool:
    """Whether the network can tell anything of a sentence."""
    if len(text.split()) > LONGEST or is_plain(text) or _QUOTED.search(text):
        return False
    return _TAKEN_BACK.isdisjoint(words_in(text))


def _only_repeats(text: str, goals: tuple[Goal, ...]) -> bool:
    """Whether all is to repeat to somebody the last words of a sentence, where nothing is lost.

    Of words that are only repeated the network has nothing to tell.
    """
    match goals:
        case (Say(what=str(what), to=Person(name=str())),):
            said, told = words_in(text), words_in(what)
            size = len(told)
            last = (said[len(said) - size - n : len(said) - n] for n in range(_TAIL))
            same = any(len(one) == size and _differ(one, told) <= size // 2 for one in last)
            return size >= _FEWEST_TOLD and len(said) - size <= _LONGEST_FRAME and same
        case _:
            return False


def _differ(one: list[str], other: list[str]) -> int:
    """In how many places words differ, as "he is" and "you are" do."""
    return sum(a != b for a, b in zip(one, other, strict=True))


def _told_there(goals: tuple[Goal, ...]) -> tuple[Goal, ...]:
    """On the bar, which is largest: to go there and tell that is to tell it of what is there."""
    match goals:
        case (GoTo(place=str(place)), Tell(object=ObjectQuery(at=None) as thing) as tell, *rest):
            return (replace(tell, object=replace(thing, at=place)), *rest)
        case _:
            return goals


def _finds(
    heard: Heard, goals: tuple[Goal, ...], index: NameIndex
) -> list[tuple[float, float]] | None:
    plain = plainly(goals)
    found = heard.finds(plain, index)
    if found is None:
        return None
    taught = _is_taught(plain, index)
    return [one for one, is_taught in zip(found, taught, strict=True) if is_taught]


def _is_taught(plain: str, index: NameIndex) -> Iterator[bool]:
    """For each plain word, and the end, whether the network would put it so.

    In a message "you" stands where the sentence has "he" or "she"
    (:mod:`intents.english.words.reported`), which the network was not taught.
    """
    quoted = False
    for unit in units(words_of(plain), index):
        quoted = quoted != (unit.said in _QUOTES)
        yield not (quoted and unit.said in _YOU)
    yield True


def _witness(said: Paraphrase, other: Attempt | None, goals: tuple[Goal, ...]) -> Witness:
    if other is None:
        return "ask" if said.text == ASK else "nothing"
    if not isinstance(other.outcome, Goals):
        return "unread"
    alike = same(to_builtins(other.outcome.goals), to_builtins(goals))
    return "agree" if alike else "differ"


def _bounds(text: str, names: Sequence[Name]) -> _Bounds:
    said, bare = [name.said for name in names], GREETING.sub("", text)
    if is_plainly_put(bare, said):
        return _PLAIN
    return _NEARLY if is_plainly_put(bare, said, strange=STRANGE) else _FREELY
