"""Conditions: "the cup is not there", "you see a person", "the door is open"."""

from copy import copy

from msgspec.structs import replace

from intents.english.clauses.coordination import Joint, Link, combined, coordinated, link_at
from intents.english.phrases.bare_phrases import bare_phrase
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import NotUnderstood, Unclear
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.lexicon import LOCATIVES, phrases, words
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import (
    AnyOf,
    Bring,
    Condition,
    Find,
    Give,
    Goal,
    Holding,
    ObjectQuery,
    Person,
    Pick,
    Place,
    Present,
    State,
    simple_conditions,
)

IF = phrases(
    "if,in case,when,whenever,each time,every time,any time,unless,only if,only when,"
    "as long as,provided that,once,as soon as"
)
"""How a condition begins."""
_WHEN = phrases("when,once,as soon as,whenever,each time,every time,any time")
_EMPTY_HANDED = phrases(
    "your hands are empty,your hand is empty,your gripper is empty,you hold nothing,"
    "you are holding nothing,you have nothing in your hands,you have nothing in your hand,"
    "you carry nothing,you are carrying nothing,you are empty handed,both hands are empty"
)
_NONE = phrases(
    "there is none left,there are none left,there is not any left,there are not any left,"
    "there is none,there are none,there is not one,there is not any,it is not there"
)
_SO = phrases(
    "so,it is,they are,there is,there are,there is one,there is any,it is there,they are there,"
    "that is so,that is the case,that is true,you do,you can,he is,she is,yes"
)
_NOT_SO = phrases(
    "not,it is not,they are not,there is not,there are not,there is none,there are none,"
    "there is not one,there is not any,it is not there,they are not there,that is not the case,"
    "you do not,you can not,he is not,she is not,no"
)
"""How a condition takes up the question before it."""
_YET = ("yet", "already", "still", "anymore", "now")
IS = ("is", "are", "stands", "stand", "stays", "be")
_NO = ("no", "not", "never", "nothing", "any", "neither")
_THERE = ("there", "here", "present", "visible", "available", "around", "home", "left")
_THEREON = phrases("on it,on them,in it,in them,there,on top,on top of it,inside,inside it")
_BACK = ("back", "to", "for")
_GONE = ("missing", "gone", "absent", "away")
_IN_HAND = phrases("in your hand,in your hands,in the hand,in your gripper,in hand,with you")
_STATES = ("open", "closed", "shut", "on", "off", "empty", "full")
_BEING = words(
    "standing sitting lying hanging left switched turned set still wide half currently always "
    "plugged kept just"
)
"""What adds nothing to a state or a place behind it: "is *standing* open", "is *switched* on"."""
_OPPOSITES = {
    one: other
    for pair in (("open", "closed"), ("on", "off"), ("empty", "full"))
    for one, other in (pair, pair[::-1])
}
_SEE = ("see", "find", "spot", "locate", "notice", "detect", "recognize")
_HOLD = ("have", "hold", "holding", "carry", "carrying", "grasp")


def one_condition(text: Text, at: int, scope: Scope) -> tuple[Condition, int]:
    """The condition of one subject or of several that begins at a word, and where it ends.

    Raises:
        NotUnderstood: It is nothing the robot can check.
    """
    at += text.word(at) == "either"
    holds, end = _asked(text, at, scope) or _condition(text, at, scope)
    if text.word(end) == "there" and scope.place and isinstance(holds, Present) and holds.object:
        holds = replace(holds, object=replace(holds.object, at=holds.object.at or scope.place))
        end += 1
    return holds, end + (text.word(end) in _YET)


def mention(holds: Condition, scope: Scope, *, met: bool = True) -> None:
    """Remember what a condition speaks of, as it is where the condition is met or is not.

    If the cup is not on the table, put *it* there: then it is wherever it is. Of several things
    what is held is "it".
    """
    for one in sorted(simple_conditions(holds), key=lambda one: isinstance(one, Holding)):
        if isinstance(one, Present):
            spoken_of = one.object or one.person or Person()
            there = met != one.negated and not isinstance(holds, AnyOf)
            scope.mention(spoken_of if there else replace(spoken_of, at=None))
            scope.mention(spoken_of.at)
        elif isinstance(one, Holding) and one.object.name:
            scope.mention(one.object)
        elif isinstance(one, State) and {n.kind for n in scope.index.exact(one.what)} == {"place"}:
            scope.mention(one.what)  # if the drawer is open, put it in there


def is_complement(one: Condition, other: Condition) -> bool:
    """Whether one condition holds just where the other does not: on, off; there, gone."""
    if isinstance(one, State) and isinstance(other, State) and one.what == other.what:
        opposite = _OPPOSITES.get(one.state) == other.state and one.negated == other.negated
        return opposite or (one.state == other.state and one.negated != other.negated)
    if not isinstance(one, Present | Holding) or not isinstance(other, Present | Holding):
        return False
    return one.negated != other.negated and replace(one, negated=other.negated) == other


def _asked(text: Text, at: int, scope: Scope) -> tuple[Condition, int] | None:
    """Check whether the cup is there. If *so*; if *it is*; if *not*: what was asked before."""
    last = scope.last
    if not isinstance(last, Find):
        return None
    said = _taken_up(text, at)
    if said is None:
        return None
    return Present(object=last.object, person=last.person, negated=said[0]), said[1]


def _taken_up(text: Text, at: int) -> tuple[bool, int] | None:
    """Whether what was asked before is denied, and where that ends: if *it is not* (so)."""
    for table, negated in ((_SO, False), (_NOT_SO, True)):
        end = text.phrase_end(table, at)
        if end and (
            text.word(end) in (COMMA, FULL_STOP, "then")
            or text.word(end - 1) == "so"
            or _order_begins(text, end)
        ):
            return negated, end
    return None


def _order_begins(text: Text, at: int) -> bool:
    """... and if it is not *put it there*; "if it is *open*" goes on, and so does "clean"."""
    told = (*_STATES, *_GONE, *_THERE, *_BEING)
    if text.word(at) in told or text.lookup(LOCATIVES, at):
        return False
    return any(
        noun_phrase(text, end) or text.word(end) in _BACK for _, end in verbs_at(text.words, at)
    )


def _condition(text: Text, at: int, scope: Scope) -> tuple[Condition, int]:
    word = text.word(at)
    none = text.phrase_end(_NONE, at)
    if none and (scope.object or scope.person):
        sought = isinstance(scope.last, Bring | Give | Pick | Place) and word == "there"
        there = scope.object if sought or not scope.person_is_last else None
        person = None if there else scope.person
        return Present(object=there, person=person, negated=True), none
    if word == "there" and text.word(at + 1) in ("is", "are", "be"):
        negated, at = _negation(text, at + 2)
        return _present(text, at, scope, negated)
    empty = text.phrase_end(_EMPTY_HANDED, at)
    if empty:
        return Holding(object=ObjectQuery(), negated=True), empty
    if word == "you":
        return _of_robot(text, at + 1, scope)
    if word in ("nobody", "noone") or (word == "no" and text.word(at + 1) == "one"):
        phrase = NounPhrase(at, at + 2 if word == "no" else at + 1, noun="person", said="person")
        phrase.end += text.word(phrase.end) == "is"
        read_postmodifiers(text, phrase)
        return Present(person=to_person(phrase, scope), negated=True), phrase.end
    neither = word == "neither"
    negated, at = _negation(text, at)
    phrase = noun_phrase(text, at)
    has = _on_it(text, phrase, scope) if phrase else None
    if has:
        return has
    if phrase is None:
        raise NotUnderstood(f"I cannot check whether “{text.raw(at, len(text))}”")
    subjects, joint, end = coordinated(text, phrase, phrase.end, lambda link: _subject(text, link))
    if text.word(end) not in IS or (len(subjects) > 1 and negated and not neither):
        raise NotUnderstood(f"I cannot check whether “{text.raw(at, len(text))}”")
    if text.word(at) == "both" and len(subjects) > 1:
        phrase.count = None  # both the cup and the plate: one of each
    found: list[Condition] = []
    at = end
    for subject in subjects:
        subject.end = at
        holds, end = _of_thing(text, subject, scope, negated)
        found.append(holds)
    return combined(found, "and" if negated else joint), end


def _subject(text: Text, link: Link) -> tuple[NounPhrase, int] | None:
    """One more thing of which the same is said: the cup *and the box* are on the table."""
    phrase = noun_phrase(text, link.start)
    listed = phrase is not None and (text.word(phrase.end) in IS or link_at(text, phrase.end))
    return (phrase, phrase.end) if phrase is not None and listed else None


def _on_it(text: Text, spot: NounPhrase, scope: Scope) -> tuple[Condition, int] | None:
    """The table *has no cup on it*."""
    if text.word(spot.end) not in ("has", "have") or not spot.is_spot:
        return None
    negated, at = _negation(text, spot.end + 1)
    phrase = bare_phrase(text, at)
    end = text.phrase_end(_THEREON, phrase.end) if phrase else None
    if phrase is None or end is None:
        return None
    phrase.places.append(Locative("on", spot))
    return _is_present(phrase, scope, negated), end


def as_soon_as(text: Text, at: int, holds: Condition) -> list[Goal]:
    """When you find a guest, ...: first find one; empty if nothing is to be found.

    Raises:
        Unclear: It is one thing or another.
    """
    end = text.phrase_end(_WHEN, at)
    if end is None or text.word(end) != "you":
        return []
    if isinstance(holds, AnyOf):
        raise Unclear("The one or the other: which shall I look for?")
    found: list[Goal] = []
    for one in simple_conditions(holds):
        if not isinstance(one, Present) or one.negated:
            return []
        found.append(Find(object=one.object, person=one.person))
    return found


def _negation(text: Text, at: int) -> tuple[bool, int]:
    negated = False
    while text.word(at) in _NO or (text.word(at) in _YET and not text.name_at(at)):
        negated = negated or (text.word(at) in _NO and text.word(at) != "any")
        at += 1
    return negated, at


def _present(text: Text, at: int, scope: Scope, negated: bool) -> tuple[Condition, int]:
    """There is *a cup or a bottle on the table*."""
    phrases_, joint, end = _things(text, at, negated)
    for phrase, denied in phrases_:
        if denied and phrase.said == "one":
            phrase.noun, phrase.said = "person", "person"
    found = [_is_present(phrase, scope, denied) for phrase, denied in phrases_]
    return combined(found, joint), end


def _things(text: Text, at: int, negated: bool) -> tuple[list[tuple[NounPhrase, bool]], Joint, int]:
    """Things of which all or any are there, each with whether it is not, what joins them, the end.

    They are all where the last one is, if it is not said of the others: "a cup or a bottle on the
    table". What is denied once is denied of each: "no cup or bottle".

    Raises:
        NotUnderstood: There is none.
        Unclear: It is not said where the last one is, or what of them is denied.
    """
    at += text.word(at) == "either"
    phrase = noun_phrase(text, at)
    if phrase is None:
        raise NotUnderstood(f"I cannot check whether there is “{text.raw(at, len(text))}”")
    first = (phrase, negated)
    found, joint, end = coordinated(text, first, phrase.end, lambda link: _thing(text, link, first))
    if negated and joint == "and" and not all(denied for _, denied in found[1:]):
        raise Unclear("None of them, or not all of them? Please say it one by one.")
    if negated and joint in ("or", "nor"):
        found, joint = [(one, True) for one, _ in found], "and"
    if text.word(at) == "both" and len(found) > 1:
        phrase.count = None
    last = found[-1][0]
    if any(one.places for one, _ in found) and not last.places:
        raise Unclear(f"Where is {text.raw(last.start, last.end)} to be?")
    for one, _ in found:
        one.places = one.places or last.places
    return found, joint, end


def _thing(
    text: Text, link: Link, first: tuple[NounPhrase, bool]
) -> tuple[tuple[NounPhrase, bool], int] | None:
    """There is a cup *or a bottle*; you see a cup on the table *or on the shelf*."""
    negated, at = _negation(text, link.start)
    phrase = noun_phrase(text, at)
    before = first[0]
    spot = phrase is None or (phrase.is_spot and phrase.noun != "unknown")
    if spot and before.places:
        again = _elsewhere(text, at, before)
        return ((again, negated), again.end) if again else None
    if phrase is None or phrase.noun == "unknown" or text.word(phrase.end) in IS:
        return None
    if verbs_at(text.words, link.start) and not text.name_at(link.start):
        return None
    return (phrase, negated), phrase.end


def _elsewhere(text: Text, at: int, said: NounPhrase) -> NounPhrase | None:
    """What was said to be in one place as it is in another: "on the table *or (on) the shelf*"."""
    again = copy(said)
    again.places, again.end = [], at
    read_postmodifiers(text, again)
    if again.end > at:
        return again
    spot = noun_phrase(text, at)
    if spot is None or spot.noun == "unknown" or text.word(spot.end) in IS or not said.places:
        return None
    if spot.places and not spot.is_spot:
        return None  # ... and the bottle on the chair
    again.places, again.end = [Locative(said.places[-1].how, spot)], spot.end
    return again


def _is_present(phrase: NounPhrase, scope: Scope, negated: bool) -> Condition:
    if is_person(phrase, scope):
        return Present(person=to_person(phrase, scope), negated=negated)
    return Present(object=to_object(phrase, scope), negated=negated)


def _of_robot(text: Text, at: int, scope: Scope) -> tuple[Condition, int]:
    """You can see a cup; you are not holding anything."""
    negated = False
    while text.word(at) in ("can", "do", "are", "is", "not", "could", "already", "still"):
        negated = negated or text.word(at) == "not"
        at += 1
    if text.word(at) in _HOLD:
        denied, at = _negation(text, at + 1)
        things, joint, end = _things(text, at, negated != denied)
        end = text.phrase_end(_IN_HAND, end) or end
        held: list[Condition] = [
            Holding(object=to_object(phrase, scope), negated=no) for phrase, no in things
        ]
        return combined(held, joint), end
    if text.word(at) in _SEE:
        found = noun_phrase(text, at + 1)
        if found and text.word(found.end) in _STATES and not found.name("object"):
            return _of_thing(text, _until(found), scope, negated)
        return _present(text, at + 1, scope, negated)
    raise NotUnderstood("I can only check what I see and what I hold")


def _until(phrase: NounPhrase) -> NounPhrase:
    """The phrase, as if "is" stood after it."""
    phrase.end -= 1
    return phrase


def _of_thing(text: Text, phrase: NounPhrase, scope: Scope, negated: bool) -> tuple[Condition, int]:
    """The cup is on the table or the shelf; the door is not open; Julia is in the kitchen."""
    at = phrase.end + 1
    neither = text.word(at) == "neither"
    at += text.word(at) in ("either", "both")
    denied, at = _negation(text, at)
    negated = negated != denied
    if phrase.noun == "place" and phrase.places:
        to_place(phrase, scope)
    first, end = _predicate(text, at, phrase, scope, negated)
    said, own = [phrase], [negated]

    def another(link: Link) -> tuple[Condition, int] | None:
        at = link.start + (text.word(link.start) in IS)
        no, at = _negation(text, at)
        own.append(no)
        if text.word(at + 1) in IS:
            return None  # ... and there is a cup
        if text.word(at) in (*_STATES, *_GONE) or _there_end(text, at):
            return _predicate(text, at, _nowhere(phrase), scope, no or negated)
        again = _elsewhere(text, at, said[-1])
        if again is None:
            return None
        said.append(again)
        return _is_present(again, scope, no or negated), again.end

    found, joint, end = coordinated(text, first, end, another)
    no = own[1 : len(found)]
    if negated and joint == "and" and not all(no):
        raise Unclear("Is that denied of all of it? Please say it one by one.")
    if negated and (neither or not any(no)):
        joint = "and"
    return combined(found, joint), end


def _predicate(
    text: Text, at: int, phrase: NounPhrase, scope: Scope, negated: bool
) -> tuple[Condition, int]:
    """What is said of a thing behind "is": *on the table*; *open*; *there*; *gone*."""
    at += text.word(at) in _BEING and _is_said_of(text, at + 1)
    word = text.word(at)
    if word in ("there", "here") and scope.place and not phrase.places:
        phrase.places.append(Locative(None, NounPhrase(at, at + 1, noun="there", said="there")))
    there = _there_end(text, at)
    if there:
        return _is_present(phrase, scope, negated), there
    if word in _GONE:
        return _is_present(phrase, scope, not negated), at + 1
    if word in _STATES and not (word == "on" and noun_phrase(text, at + 1)):
        what = phrase.name("object", "place", "room") or singular(phrase.said)
        if phrase.noun == "pronoun":
            what = scope.device or (scope.object and scope.object.name) or scope.place or "it"
        scope.device = what
        state = "closed" if word == "shut" else word
        return State(what=what, state=state, negated=negated), at + 1
    phrase.end = at
    read_postmodifiers(text, phrase)
    if phrase.end == at:
        raise NotUnderstood(f"I cannot check whether something is “{word}”")
    return _is_present(phrase, scope, negated), phrase.end


def _is_said_of(text: Text, at: int) -> bool:
    """Whether a state, or where something is, begins at a word: standing *open*."""
    return text.word(at) in (*_STATES, *_THERE) or text.lookup(LOCATIVES, at) is not None


def _there_end(text: Text, at: int) -> int | None:
    there = text.word(at) in _THERE and not text.lookup(LOCATIVES, at + 1)
    return at + 1 if there else None


def _nowhere(phrase: NounPhrase) -> NounPhrase:
    """The phrase without where it is."""
    bare = copy(phrase)
    bare.places = []
    return bare
