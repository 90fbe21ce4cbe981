"""Conditions: "the cup is not there", "you see a person", "the door is open"."""

from msgspec.structs import replace

from intents.english.phrases.bare_phrases import bare_phrase
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import NotUnderstood
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.lexicon import LOCATIVES, phrases
from intents.english.words.text import Text
from intents.goals import (
    Bring,
    Condition,
    Find,
    Give,
    Holding,
    ObjectQuery,
    Person,
    Pick,
    Place,
    Present,
    State,
)

IF = phrases(
    "if,in case,when,whenever,unless,only if,only when,as long as,provided that,once,as soon as"
)
"""How a condition begins."""
_WHEN = phrases("when,once,as soon as,whenever")
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
_IS = ("is", "are", "stands", "stand", "stays", "be")
_NO = ("no", "not", "never", "nothing", "any")
_THERE = ("there", "here", "present", "visible", "available", "around", "home", "left")
_THEREON = phrases("on it,on them,in it,in them,there,on top,on top of it,inside,inside it")
_GONE = ("missing", "gone", "absent", "away")
_IN_HAND = phrases("in your hand,in your hands,in the hand,in your gripper,in hand,with you")
_STATES = ("open", "closed", "on", "off", "empty", "full")
_SEE = ("see", "find", "spot", "locate", "notice", "detect", "recognize")
_HOLD = ("have", "hold", "holding", "carry", "carrying", "grasp")


def condition(text: Text, at: int, scope: Scope) -> tuple[Condition, int]:
    """The condition that begins at a word, and where it ends.

    Raises:
        NotUnderstood: It is nothing the robot can check.
    """
    holds, end = _asked(text, at, scope) or _condition(text, at, scope)
    if text.word(end) == "there" and scope.place and isinstance(holds, Present) and holds.object:
        holds = replace(holds, object=replace(holds.object, at=holds.object.at or scope.place))
        end += 1
    return holds, end + (text.word(end) in _YET)


def mention(holds: Condition, scope: Scope, *, met: bool = True) -> None:
    """Remember what a condition speaks of, as it is where the condition is met or is not.

    If the cup is not on the table, put *it* there: then it is wherever it is.
    """
    if isinstance(holds, Present):
        spoken_of = holds.object or holds.person or Person()
        scope.mention(spoken_of if met != holds.negated else replace(spoken_of, at=None))
        scope.mention(spoken_of.at)
    elif isinstance(holds, Holding) and holds.object.name:
        scope.mention(holds.object)


def _asked(text: Text, at: int, scope: Scope) -> tuple[Condition, int] | None:
    """Check whether the cup is there. If *so*; if *it is*; if *not*: what was asked before."""
    last = scope.last
    if not isinstance(last, Find):
        return None
    for table, negated in ((_SO, False), (_NOT_SO, True)):
        end = text.phrase_end(table, at)
        ends = end and (text.word(end) in (COMMA, FULL_STOP, "then") or text.word(end - 1) == "so")
        if end and ends:
            return Present(object=last.object, person=last.person, negated=negated), end
    return None


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
    negated, at = _negation(text, at)
    phrase = noun_phrase(text, at)
    has = _on_it(text, phrase, scope) if phrase else None
    if has:
        return has
    if phrase is None or text.word(phrase.end) not in _IS:
        raise NotUnderstood(f"I cannot check whether “{text.raw(at, len(text))}”")
    return _of_thing(text, phrase, scope, negated)


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


def as_soon_as(text: Text, at: int, holds: Condition) -> Find | None:
    """When you find a guest, ...: first find one."""
    end = text.phrase_end(_WHEN, at)
    when = end is not None and text.word(end) == "you"
    if not when or not isinstance(holds, Present) or holds.negated:
        return None
    return Find(object=holds.object, person=holds.person)


def _negation(text: Text, at: int) -> tuple[bool, int]:
    negated = False
    while text.word(at) in _NO or (text.word(at) in _YET and not text.name_at(at)):
        negated = negated or (text.word(at) in _NO and text.word(at) != "any")
        at += 1
    return negated, at


def _present(text: Text, at: int, scope: Scope, negated: bool) -> tuple[Condition, int]:
    phrase = noun_phrase(text, at)
    if phrase is not None and negated and phrase.said == "one":
        phrase.noun, phrase.said = "person", "person"
    if phrase is None:
        raise NotUnderstood(f"I cannot check whether there is “{text.raw(at, len(text))}”")
    return _is_present(phrase, scope, negated), phrase.end


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
        phrase = noun_phrase(text, at + 1)
        if phrase:
            phrase.end = text.phrase_end(_IN_HAND, phrase.end) or phrase.end
            return Holding(object=to_object(phrase, scope), negated=negated), phrase.end
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
    """The cup is not on the table; the door is open; Julia is in the kitchen."""
    denied, at = _negation(text, phrase.end + 1)
    negated = negated != denied
    word = text.word(at)
    if word in ("there", "here") and scope.place and not phrase.places:
        phrase.places.append(Locative(None, NounPhrase(at, at + 1, noun="there", said="there")))
    if word in _THERE and not text.lookup(LOCATIVES, at + 1):
        return _is_present(phrase, scope, negated), at + 1
    if word in _GONE:
        return _is_present(phrase, scope, not negated), at + 1
    if word in _STATES and not (word == "on" and noun_phrase(text, at + 1)):
        what = phrase.name("object", "place", "room") or singular(phrase.said)
        if phrase.noun == "pronoun":
            what = scope.device or (scope.object and scope.object.name) or scope.place or "it"
        scope.device = what
        return State(what=what, state=word, negated=negated), at + 1
    if phrase.noun == "place" and phrase.places:
        to_place(phrase, scope)
    phrase.end = at
    read_postmodifiers(text, phrase)
    if phrase.end == at:
        raise NotUnderstood(f"I cannot check whether something is “{word}”")
    return _is_present(phrase, scope, negated), phrase.end
