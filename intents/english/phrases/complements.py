"""What follows a verb: noun phrases with their prepositions, quantities, directions, particles."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

from intents.english.phrases.noun_phrases import (
    noun_phrase,
    read_postmodifiers,
    weight_at,
)
from intents.english.phrases.phrase import Locative, NounPhrase, is_content
from intents.english.phrases.times import tells_when
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE
from intents.english.words.lexicon import (
    CONNECTORS,
    GOALWARDS,
    LOCATIVES,
    OTHER_PREPOSITIONS,
    phrases,
)
from intents.english.words.measures import Measure, measure, number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import How

Role = Literal["", "to", "into", "from", "at", "for", "with", "of", "about", "through"]
Direction = Literal["forward", "backward", "left", "right", "around", "up", "down", "cw", "ccw"]

_DIRECTIONS: dict[tuple[str, ...], Direction] = {
    words: direction
    for direction, text in (
        ("forward", "forward,forwards,ahead,straight,straight ahead,straight on,straight forward,"
                    "to the front,onward,onwards,closer,further"),
        ("backward", "backward,backwards,back,to the back,rearwards,in reverse,"
                     "behind you,over your shoulder,behind yourself,behind your back"),
        ("left", "left,to the left,to your left,leftwards,leftward,sideways left,to my left,"
                 "to the left side,left side,to left,to left side,sideways to the left,"
                 "towards the left"),
        ("right", "right,to the right,to your right,rightwards,rightward,sideways right,"
                  "to my right,to the right side,to right,to right side,sideways to the right,"
                  "towards the right"),
        ("around", "around,all the way around,all around,round,the other way,the other way around,"
                   "the other direction"),
        ("up", "up,upwards,upward"),
        ("down", "down,downwards,downward"),
        ("cw", "clockwise"),
        ("ccw", "counterclockwise,anticlockwise,counter clockwise,anti clockwise"),
    )
    for words in phrases(text)
}  # fmt: skip  # pyright: ignore[reportAssignmentType]
_PARTICLES = lexicon.words("up down on off over back away out along together again in around too "
                           "also aside apart instead as well inside outside somewhere anywhere "
                           "indoors outdoors")  # fmt: skip
_FIXED = 3
"""So many words make a direction a set phrase: "over your shoulder"."""
_A_WHILE = phrases(
    "for a while,for a moment,for a bit,for a little while,a moment,a while,a second,a minute,"
    "for some time,a bit,a little,a little bit,a tiny bit,slightly,some more,a little more"
)
_SUBJECTS = ("it", "they", "he", "she")
_SPEAKERS = ("i", "we", "he", "she", "they")
_ON_IT = lexicon.words("wearing holding reading using carrying drinking eating watching")
"""The cap *she is wearing* is that one."""
_HOW_ONE_IS = lexicon.words(
    "dripping freezing soaking starving dying boiling sweating shivering bleeding melting leaving "
    "going coming waiting hurrying rushing crying choking sneezing burning roasting baking running"
)
"""What one is doing that takes no object: *the book I am reading* tells which book it is."""
_LINKS = (["in", "case"], ["as", "soon"], ["once", "you"])
"""How a clause begins that says when or whether."""
_STRICT = ("left", "right", "behind", "under", "above", "in_front", "between")
_IGNORED = lexicon.words("there's exactly about approximately roughly around almost another more "
                         "further both yourself itself only sideways")  # fmt: skip


@dataclass(slots=True)
class Complement:
    """One thing said after a verb; which of the slots are set says what it is.

    Attributes:
        role: What its preposition makes of it; empty without one.
        how: For a place with role "at", the preposition's meaning.
        phrases: Coordinated noun phrases, "the cup and the plate" being two.
        vague: A quantity without a figure, "a bit".
    """

    role: Role = ""
    how: How | None = None
    phrases: list[NounPhrase] = field(default_factory=list[NounPhrase])
    measure: Measure | None = None
    direction: Direction | None = None
    particle: str = ""
    vague: bool = False

    @property
    def phrase(self) -> NounPhrase:
        """The first noun phrase; only where there is one."""
        return self.phrases[0]


def first_with(complements: Iterable[Complement], *roles: str) -> Complement | None:
    """The first complement with one of these roles; "" is a bare noun phrase."""
    return next((c for c in complements if c.phrases and c.role in roles), None)


@dataclass(slots=True)
class Clause:
    """A verb in one of its senses with its complements, up to word ``end``.

    Attributes:
        verb: The verb as it was said.
        first: The first word after the verb.
    """

    text: Text
    sense: str
    verb: str
    first: int
    end: int
    complements: list[Complement]

    def with_role(self, *roles: str) -> list[Complement]:
        """The complements with noun phrases that have one of these roles."""
        return [c for c in self.complements if c.phrases and c.role in roles]

    def particles(self) -> set[str]:
        """The particles said: up, down, on, off."""
        return {c.particle for c in self.complements if c.particle}

    def directions(self) -> list[str]:
        """The directions said."""
        return [c.direction for c in self.complements if c.direction]

    def measure(self, kind: str) -> float | None:
        """The quantity of a kind, in SI."""
        found = [c.measure.value for c in self.complements if c.measure and c.measure.kind == kind]
        return found[0] if found else None

    def vague(self) -> bool:
        """Whether "a bit" or the like was said."""
        return any(c.vague for c in self.complements)


def ends_clause(text: Text, at: int) -> bool:
    """Whether nothing more of a clause can begin here."""
    word = text.word(at)
    if at >= len(text) or word in (COMMA, FULL_STOP):
        return True
    if word in _SUBJECTS and text.word(at + 1) in ("is", "are"):
        return text.word(at + 2) not in _ON_IT
    if word in _SPEAKERS and _tells_something(text, at + 1):
        return True
    if tells_when(text, at) or _orders_steps(text, at):
        return True
    if told_later(text, at):
        return True
    if word == "without" and text.word(at + 1).endswith("ing"):
        return True
    return text.words[at : at + 2] in _LINKS or bool(connector_end(text, at))


def told_later(text: Text, at: int) -> Measure | None:
    """Switch it off *in ten minutes*: how long to wait before, at the end of a clause."""
    amount = measure(text.words, at + 1) if text.word(at) == "in" and at else None
    if amount is None or amount.kind != "time" or text.name_at(at + 1):
        return None
    closes = amount.end >= len(text) or text.word(amount.end) in (COMMA, FULL_STOP)
    return amount if closes else None


def _orders_steps(text: Text, at: int) -> bool:
    """Whether "before" or "after" stands before another step: "before *you go*, after *waving*"."""
    if text.word(at) not in ("before", "after"):
        return False
    doing = text.word(at + 1).endswith("ing") and not text.name_at(at + 1)
    start = at + 1 + (text.word(at + 1) == "you")
    return (doing or start > at + 1) and bool(verbs_at(text.words, start))


def _tells_something(text: Text, at: int) -> bool:
    """Fetch a towel *I am dripping*; ... *I need it*: no words that describe the towel."""
    if text.word(at) in ("am", "are"):
        said = at + 1
        while text.word(said) in ("so", "very", "really", "too", "just", "still", "all", "not"):
            said += 1
        predicate = text.word(said)
        return said > at + 1 or not predicate.endswith("ing") or predicate in _HOW_ONE_IS
    return text.word(at).isalpha() and text.word(at + 1) in ("it", "them")


def connector_end(text: Text, at: int) -> int | None:
    """Where "and then" and the like end, if they begin here and are no part of a name."""
    end = text.phrase_end(CONNECTORS, at)
    if end and text.words[at:end] == ["next"] and text.word(end) == "to":
        return None
    if end and text.word(end - 1) == "arrive" and text.word(end) in ("at", "in", "by", "on"):
        return None  # when you arrive at the counter: that says where to go
    return None if end and text.name_at(at) else end


def read_complements(text: Text, start: int) -> tuple[list[Complement], int]:
    """The complements from a word on, and where they end."""
    complements: list[Complement] = []
    at = start
    while not ends_clause(text, at):
        found = _read_one(text, at)
        attached = _attach(text, complements, at, found)
        if attached:
            at = attached
            continue
        if found is None:
            if text.word(at) not in _IGNORED:
                break
            at += 1
            continue
        complement, at = _without_next_theme(text, complements, *found)
        complements.append(complement)
    return complements, at


def _without_next_theme(
    text: Text, before: list[Complement], complement: Complement, end: int
) -> tuple[Complement, int]:
    """Put the fork into the drawer and *the plate on the table*: that is to be put, too."""
    apart = complement.role in ("to", "into", "at") and complement.how != "between"
    themed = any(c.role == "" and c.phrases for c in before)
    if not (apart and themed and len(complement.phrases) > 1):
        return complement, end
    *stay, last = complement.phrases
    goes_on = last.places or _preposition(text, end)[0] in ("to", "into", "at")
    if not goes_on or not last.name("object", "category"):
        return complement, end
    complement.phrases = stay
    return complement, stay[-1].end


def _attach(
    text: Text,
    complements: list[Complement],
    at: int,
    found: tuple[Complement, int] | None,
) -> int | None:
    """What belongs to a noun further back: the object [from the desk] *that weighs least*."""
    nouns = [c for c in complements if c.phrases and c.role == "" and not c.phrase.is_person]
    bare = nouns[-1] if nouns else None
    if bare is None or bare is complements[-1] or bare.phrase.noun == "pronoun":
        return None
    weighed = weight_at(text, at + 1) if text.word(at) in ("that", "which") else None
    if weighed:
        bare.phrase.superlative = weighed[0]
        return weighed[1]
    if found and found[0].how in _STRICT and found[0].phrase.name("object"):
        bare.phrase.places.append(Locative(found[0].how, found[0].phrase))
        return found[1]
    if found is None:
        kept, bare.phrase.end = bare.phrase.end, at
        read_postmodifiers(text, bare.phrase)
        end, bare.phrase.end = bare.phrase.end, kept
        return end if end > at else None
    return None


def _read_one(text: Text, at: int) -> tuple[Complement, int] | None:
    return (
        _quantity(text, at) or _direction(text, at) or _prepositional(text, at) or _bare(text, at)
    )


def _quantity(text: Text, at: int) -> tuple[Complement, int] | None:
    vague = text.phrase_end(_A_WHILE, at)
    if vague and not measure(text.words, at):
        return Complement(vague=True), vague
    start = at + (text.word(at) in ("for", "by", "about"))
    amount = measure(text.words, start) or _plain_number(text, start)
    if amount is None or (text.name_at(start) and start == at):
        return None
    return Complement(measure=amount), amount.end


def _plain_number(text: Text, at: int) -> Measure | None:
    """A number that counts nothing: turn left 90."""
    amount = number(text.words, at)
    if text.word(at) == "one":
        return None  # two cups, bring one
    if amount is None or not (ends_clause(text, amount.end) or text.word(amount.end) == "to"):
        return None
    return Measure("plain", amount.value, amount.end)


def _direction(text: Text, at: int) -> tuple[Complement, int] | None:
    """Left, to the right, ahead - where nothing follows that it could describe."""
    found = text.lookup(_DIRECTIONS, at)
    if found is None:
        return None
    direction, end = found
    if text.word(at) in ("over", "right") and text.word(at + 1) in ("here", "there"):
        return None
    named = text.name_at(at)
    if named and named.end > end:
        return None  # the back door
    if end - at < _FIXED and text.lookup(LOCATIVES, at) and _prepositional(text, at):
        return None
    if text.word(end) == "of":
        return None
    described = is_content(text, end) and not verbs_at(text.words, end)
    if end > at + 1 and described and text.word(end - 1) in ("left", "right", "front", "back"):
        return None
    single = end == at + 1 and direction not in ("forward", "around")
    if single and (_particle_goes_on(text, end) or text.phrase_end(GOALWARDS, at)):
        return None
    return Complement(direction=direction, particle=text.word(at)), end


def _particle_goes_on(text: Text, end: int) -> bool:
    """Whether a noun phrase follows that "left" or "back" belongs to: "left arm"."""
    return text.word(end - 1) in ("left", "right") and text.word(end) in lexicon.BODY_NOUNS


def _prepositional(text: Text, at: int) -> tuple[Complement, int] | None:
    role, how, end = _preposition(text, at)
    if not role:
        return None
    items, end_of_list = read_list(text, end)
    if not items:
        return None
    return Complement(role=role, how=how, phrases=items), end_of_list


def _preposition(text: Text, at: int) -> tuple[Role, How | None, int]:
    """What the longest preposition at a word means, and where it ends."""
    best: tuple[Role, How | None, int] = ("", None, at)
    if text.word(at) in ("over", "right") and text.word(at + 1) in ("here", "there"):
        return best
    goal = text.phrase_end(GOALWARDS, at)
    if goal:
        inward = text.word(goal - 1) in ("into", "in") or text.words[at:goal] == ["in", "to"]
        best = ("into" if inward else "to", None, goal)
    place = text.lookup(LOCATIVES, at)
    if place and place[1] > best[2]:
        best = ("at", place[0], place[1])
    source = text.phrase_end(lexicon.SOURCEWARDS, at) or _out_the(text, at)
    if source and source > best[2]:
        best = ("from", None, source)
    other = text.phrase_end(OTHER_PREPOSITIONS, at)
    if other and other > best[2]:
        roles: dict[str, Role] = {"for": "for", "with": "with", "of": "of", "after": "at",
                                  "about": "about", "regarding": "about"}  # fmt: skip
        best = (roles.get(text.word(at), "through"), None, other)
    return best


def _out_the(text: Text, at: int) -> int | None:
    """Get a cup *out the cupboard*: out of it; but one goes out the door."""
    named = text.name_at(at + 2) if text.word(at) == "out" else None
    if named is None and text.word(at) == "out" and text.index.partial(text.word(at + 2)):
        return at + 1 if text.word(at + 1) in ("the", "that", "my", "your") else None
    if named is None or text.word(at + 1) not in ("the", "that", "my", "your"):
        return None
    return None if text.word(named.end - 1) in ("door", "window", "gate") else at + 1


def _bare(text: Text, at: int) -> tuple[Complement, int] | None:
    if text.word(at) == QUOTE:
        return None
    particle = text.word(at) in _PARTICLES and not text.name_at(at)
    if not particle:
        items, end = read_list(text, at)
        return (Complement(phrases=items), end) if items else None
    return Complement(particle=text.word(at)), at + 1


def read_list(text: Text, at: int) -> tuple[list[NounPhrase], int]:
    """Noun phrases joined by commas and "and"; empty if none begins here."""
    first = noun_phrase(text, at)
    if first is None:
        return [], at
    items, end = [first], first.end
    while True:
        following = _next_in_list(text, end, items[-1])
        if following is None:
            if len(items) > 1 and text.word(at) == "both":
                first.count = None  # both the cup and the plate: one of each
            return items, end
        again = text.word(end) == COMMA and following.start == end + 1
        if again and following.said == items[-1].said and following.color == items[-1].color:
            items[-1].places += following.places  # the lamp, the lamp in the hall
        else:
            items.append(following)
        end = following.end


def _likened(text: Text, item: NounPhrase, last: NounPhrase) -> NounPhrase | None:
    """The red cup and *the blue one*: another of what stands before it."""
    told = item.color or item.size
    closed = ends_clause(text, item.end) or _preposition(text, item.end)[0]
    known = last.name("object", "category")
    other = text.index.sibling(known, color=item.color, size=item.size)
    if not told or item.other or not closed:
        return None
    if not other:
        item.noun, item.said = "unknown", f"{told} one"
        return item
    item.noun, item.said, item.exact, item.names = "name", last.said, last.exact, last.names
    if other != known:
        item.said, item.names, item.color, item.size = other, text.index.exact(other), None, None
    return item


def _next_in_list(text: Text, at: int, last: NounPhrase) -> NounPhrase | None:
    """The noun phrase after "and" - not the beginning of another clause."""
    start = at + (text.word(at) == COMMA)
    start += text.word(start) in ("and", "or", "plus")
    start += start > at and text.word(start) == "also"
    if start == at or ends_clause(text, start) or last.noun in ("here", "there", "operator"):
        return None
    if text.word(start) in ("any", "anything") and text.word(start + 1) == "but":
        return None  # a cup, anything but the red one: that is one cup
    named = text.name_at(start)
    if verbs_at(text.words, start) and not named:
        return None
    item = noun_phrase(text, start)
    linked = text.word(start - 1) != COMMA  # a cup, the red one: that is which
    if item is not None and item.noun == "one" and last.name("object", "category") and linked:
        return _likened(text, item, last)
    if item is None or item.noun not in ("name", "object", "unknown") or item.is_person:
        return None
    if item.noun == "unknown" and not item.determiner:
        return None
    if text.word(item.end) in lexicon.ONES:
        return None  # a saucer, a clean one
    alike = bool(item.name("object", "category")) == bool(last.name("object", "category"))
    goes_on = text.word(item.end) in ("is", "are")
    starts_clause = bool(verbs_at(text.words, item.end)) and text.word(at) == COMMA
    return item if (alike or item.noun != "name") and not goes_on and not starts_clause else None
