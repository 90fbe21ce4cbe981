"""Conditions of several clauses: "the cup is on the table and the bottle is not"."""

from msgspec.structs import replace

from intents.english.clauses.conditions import IS, mention, one_condition
from intents.english.clauses.coordination import Link, combined, coordinated, link_at
from intents.english.clauses.openings import skip_openings
from intents.english.phrases.complements import ends_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person
from intents.english.trouble import NotUnderstood, ReadingError
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import Condition, Present, Simple, State, simple_conditions

_TOO = ("too", "also", "either", "neither")
_NOT = ("not", "never")


def condition(text: Text, at: int, scope: Scope) -> tuple[Condition, int]:
    """The whole condition that begins at a word, and where it ends.

    Raises:
        NotUnderstood: Some of it is nothing the robot can check.
        Unclear: What belongs together is not clear.
    """
    first, end = one_condition(text, at, scope)
    last = [first]

    def another(link: Link) -> tuple[Condition, int] | None:
        mention(last[-1], scope)
        found = _another(text, link, last[-1], scope)
        if found is not None:
            last.append(found[0])
        return found

    found, joint, end = coordinated(text, first, end, another)
    return combined(found, joint), end


def acts_at(text: Text, at: int) -> int | None:
    """Where the command begins that "and" joins to a condition: "if it is there *and nod*"."""
    link = link_at(text, at)
    start = skip_openings(text, link.start) if link and link.joint != "," else at
    return start if start > at and _commands(text, start) else None


def _commands(text: Text, at: int) -> bool:
    """Whether a command begins at a word."""
    bare = bool(verbs_at(text.words, at)) and base_form(text.word(at)) == text.word(at)
    return bare and not text.name_at(at)


def _another(
    text: Text, link: Link, before: Condition, scope: Scope
) -> tuple[Condition, int] | None:
    """One more clause of a condition; None if what is joined is a command.

    Raises:
        NotUnderstood: It is nothing the robot can check.
    """
    if link.joint == "," and _commands(text, link.start):
        return None
    shortened = _shortened(text, link.start, before, scope)
    if shortened:
        return shortened
    try:
        return one_condition(text, link.start, scope)
    except ReadingError as error:
        if link.joint == "," or _commands(text, skip_openings(text, link.start)):
            return None
        end = link.start
        while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
            end += 1
        said = text.raw(link.start, end)
        raise NotUnderstood(f"I cannot check whether “{said}”") from error


def _shortened(
    text: Text, at: int, before: Condition, scope: Scope
) -> tuple[Condition, int] | None:
    """... but *the blue one is not*; ... and *so is the bottle*; ... and *the box on the chair*."""
    same = next(iter(simple_conditions(before)))
    inverted = text.word(at) in ("so", "neither", "nor") and text.word(at + 1) in IS
    phrase = noun_phrase(text, at + 2 if inverted else at)
    if phrase is None or phrase.noun == "unknown" or verbs_at(text.words, at):
        return None
    if inverted:
        return _likewise(phrase, same, scope, negated=text.word(at) != "so"), phrase.end
    end = phrase.end
    if text.word(end) not in IS:
        gapped = phrase.places and isinstance(same, Present)
        closed = ends_clause(text, end) or _commands(text, end)
        if not (gapped and closed):
            return None
        return _present(phrase, scope, negated=False), end
    negated = text.word(end + 1) in _NOT
    end += 1 + negated
    end += text.word(end) in _TOO
    if not (ends_clause(text, end) or _commands(text, end)):
        return None
    return _likewise(phrase, same, scope, negated=negated), end


def _likewise(phrase: NounPhrase, same: Simple, scope: Scope, *, negated: bool) -> Condition:
    """What was said of one thing, of another: where it is, or whether it is open."""
    if isinstance(same, State):
        what = phrase.name("object", "place", "room") or singular(phrase.said)
        return State(what=what, state=same.state, negated=negated)
    there = _present(phrase, scope, negated=negated)
    if not isinstance(same, Present):
        raise NotUnderstood(f"I cannot check what “{phrase.said}” is to be")
    where = same.object or same.person
    if there.object is not None:
        thing = replace(
            there.object,
            at=there.object.at or (where.at if where else None),
            relation=there.object.relation or (same.object.relation if same.object else None),
        )
        return replace(there, object=thing)
    someone = there.person and replace(there.person, at=there.person.at or (where and where.at))
    return replace(there, person=someone)


def _present(phrase: NounPhrase, scope: Scope, *, negated: bool) -> Present:
    if is_person(phrase, scope):
        return Present(person=to_person(phrase, scope), negated=negated)
    return Present(object=to_object(phrase, scope), negated=negated)
