"""Pieces: what is said of things without a verb, bit by bit.

"Two saucers, blue, from the trolley, to the suite": each piece names the things, tells more of
them, or says where from, where to or for whom. A comma, a colon or a full stop stands between.
"""

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Literal

from intents.english.phrases.complements import Complement, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.measures import number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_SIGNS = (COMMA, FULL_STOP)
_URGES = lexicon.phrases(
    "now,stat,pronto,urgently,urgent,quick,quickly,go,now now,go go go,chop chop,quick quick,"
    "sharpish,at the double,forthwith,this instant,this minute,this second,right now,na,"
    "straight away,first thing"
)
"""How one urges; the robot hurries for nobody."""
_WITHOUT_SENSE = ("away", "back", "over", "up", "down", "out", "off")
_STANDS = lexicon.words("is are lies lie stands stand sits sit stays stay hangs hang")
_ALL_OF_THEM = lexicon.phrases(
    "all,all of them,all of it,both,both of them,the lot,the lot of them,every one,"
    "every one of them,every last one,every single one,all the lot,them all,them both,each one"
)
_OF_THEM = lexicon.phrases(
    "of them,of those,of these,numbers,number,nos,pieces,pcs,units,packs,packets,off,of each,pieces"
)
"""What counts and names nothing: "four numbers"."""


@dataclass(slots=True)
class Pieces:
    """What was said of things, from one word to another.

    Attributes:
        things: The things; None until they are named.
        said: What was said of them, in that order, apart from what tells which they are.
        apart: Those of what was said that a sign stands before.
        told: It is told where they are: "the torch, it is on the bar".
        end: Where the pieces end.
    """

    things: Complement | None = None
    said: list[Complement] = field(default_factory=list[Complement])
    apart: list[Complement] = field(default_factory=list[Complement])
    told: bool = False
    end: int = 0

    def with_role(self, *roles: str) -> list[Complement]:
        """What was said with one of these roles."""
        return [c for c in self.said if c.role in roles]


def read_pieces(text: Text, at: int) -> Pieces | None:
    """The pieces from a word on, as many as there are; None if none begins here."""
    first, pieces = at, Pieces(end=at)
    while at < len(text):
        end = _read_piece(text, at, pieces, apart=at > first)
        if end is None:
            break
        pieces.end = at = end
        link = text.word(at) == "and" and text.phrase_end(lexicon.GOALWARDS, at + 1)
        if text.word(at) not in _SIGNS and not link:
            break
        at += 1
    return pieces if pieces.things else None


def _read_piece(text: Text, at: int, pieces: Pieces, *, apart: bool) -> int | None:
    """Read one piece up to a sign or a connector; None if it is none."""
    if pieces.things and text.word(at) in ("it", "they") and text.word(at + 1) in _STANDS:
        at, pieces.told = at + 2, True
    aside = _aside(text, at, pieces)
    if aside:
        return aside
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    complements, end = read_complements(text, at)
    urged = text.phrase_end(_URGES, end) or end
    if not complements or not (_closes(text, urged) or text.word(urged) == "and"):
        return None
    return urged if _sorted_out(complements, pieces, apart=apart) else None


def _aside(text: Text, at: int, pieces: Pieces) -> int | None:
    """Where what urges, or tells more of the things, ends."""
    urged = text.phrase_end(_URGES, at)
    if urged and _closes(text, urged):
        return urged
    if pieces.things is None:
        return None
    first = pieces.things.phrase.start
    placed = any(c.phrase.start > first for c in pieces.said)
    another = placed and text.word(_plain(text, at)) in lexicon.ONES  # cup, sink, clean one, rack
    return None if another else description(text, at, pieces.things)


def _sorted_out(complements: list[Complement], pieces: Pieces, *, apart: bool) -> bool:
    """Whether each complement is one of things or says where, or for whom; keep them so."""
    found: list[Complement] = []
    things = pieces.things
    for one in _one_by_one(complements):
        if (one.particle in _WITHOUT_SENSE or one.direction == "backward") and not one.phrases:
            apart = True  # scarf away *on the shelf*: that is where it goes
            continue
        if not one.phrases:
            return False
        if things and one.role == "with" and one.phrase.noun == "pronoun":
            continue  # the cups, into the sink *with them*
        if things and one.role == "" and (one.phrase.said,) in _OF_THEM and one.phrase.count:
            things.phrases[-1].count = one.phrase.count
        elif (
            things is None and _are_things(one) and (one.role == "" or _serves(one, pieces, found))
        ):
            one.role, things = "", one
        elif one.role in ("of", "about", "through", "with") or _are_things(one):
            return False
        else:
            found.append(one)
    if pieces.things is None:
        pieces.things = things
    pieces.said += found
    pieces.apart += found if apart else []
    return True


def _one_by_one(complements: list[Complement]) -> Iterator[Complement]:
    """Ada, the bar: a list only where it is one of things."""
    for one in complements:
        if len(one.phrases) > 1 and not _are_things(one):
            yield from (Complement(role=one.role, how=one.how, phrases=[p]) for p in one.phrases)
        else:
            yield one


def _serves(one: Complement, pieces: Pieces, found: list[Complement]) -> bool:
    """Back to the counter *with the saucer*; the bin *for that bottle*."""
    return one.role in ("with", "for") and bool(pieces.said or found)


def _closes(text: Text, at: int) -> bool:
    return at >= len(text) or text.word(at) in _SIGNS


def _are_things(complement: Complement) -> bool:
    return all(p.name("object", "category") and not p.is_spot for p in complement.phrases)


def description(text: Text, at: int, things: Complement | None) -> int | None:
    """Which of the things, or how many: *blue*; *the big one*; *all of them*; *four*."""
    if things is None or text.name_at(at) or len(things.phrases) != 1:
        return None
    thing, color = things.phrases[0], text.index.colors.get(text.word(at))
    if _closes(text, at + 1) and (color or text.word(at) in lexicon.EMPTY_ADJECTIVES):
        thing.color = color or thing.color
        return at + 1
    plain = _plain(text, at)
    if plain > at and text.word(plain) in lexicon.ONES and _closes(text, plain + 1):
        return plain + 1  # a clean one
    counted = _count(text, at)
    if counted:
        thing.count = counted[0]
        return counted[1]
    said = noun_phrase(text, at)
    if said is None or not _closes(text, said.end) or said.places or said.names:
        return None
    return said.end if _tells_which(said, thing) else None


def _plain(text: Text, at: int) -> int:
    """Past what tells nothing: *a clean* one."""
    while text.word(at) in lexicon.EMPTY_ADJECTIVES | lexicon.DETERMINERS:
        at += 1
    return at


def behind_commas(
    text: Text, complements: list[Complement], end: int, *, put: bool
) -> tuple[list[Complement], int]:
    """Put the saucers, *all of them, into the box*; bring a scarf, *red, from the rack*.

    Args:
        text: What was said.
        complements: Those before the comma.
        end: Where the comma stands, if there is one.
        put: On or in a place says where the thing is to be put.
    """
    thing = next((c for c in complements if c.phrases and _are_things(c)), None)
    if thing is None or thing.role or text.word(end) != COMMA:
        return complements, end
    described, more, at = deepcopy(thing), list[Complement](), end
    roles = {c.role for c in complements if c.phrases}
    free = put and not (roles & {"to", "into", "at"}) and not thing.phrases[-1].places
    while text.word(at) == COMMA:
        told = description(text, at + 1, described)
        if told:
            at = told
            continue
        found, stop = read_complements(text, at + 1)
        if not found or not _closes(text, stop) or not all(c.phrases for c in found):
            break
        new = [c.role for c in found]
        known = roles | {c.role for c in more}
        if known.intersection(new) or not {*new} <= {"to", "into", "from", *(["at"] * free)}:
            break
        more, at = more + found, stop
    if not more:
        return complements, end
    return [*(described if c is thing else c for c in complements), *more], at


def _count(text: Text, at: int) -> tuple[int | Literal["all"], int] | None:
    """All of them; both; the lot; four; four numbers; two of them."""
    everything = text.phrase_end(_ALL_OF_THEM, at)
    if everything and _closes(text, everything):
        return ("all" if text.word(at) != "both" else 2), everything
    amount = number(text.words, at)
    if amount is None or amount.value != int(amount.value) or amount.value < 1:
        return None
    end = text.phrase_end(_OF_THEM, amount.end) or amount.end
    return (int(amount.value), end) if _closes(text, end) else None


def _tells_which(said: NounPhrase, thing: NounPhrase) -> bool:
    if said.noun not in ("one", "pronoun") and said.said:
        return False
    if not (said.color or said.size or said.superlative or said.count or said.determiner):
        return False
    thing.color, thing.size = said.color or thing.color, said.size or thing.size
    thing.superlative = said.superlative or thing.superlative
    thing.count = said.count or thing.count
    return True


def all_of_them(things: Complement) -> None:
    """Tools to the shed: what is named in the plural, without a word before it, is all of it."""
    for phrase in things.phrases:
        said, name = phrase.said.split(), phrase.name("object", "category").split()
        chosen = phrase.determiner or phrase.count or phrase.superlative
        chosen = chosen or phrase.color or phrase.size
        several = said and singular(said[-1]) != said[-1] and name and name[-1] != said[-1]
        if several and not chosen:
            phrase.count = "all"
