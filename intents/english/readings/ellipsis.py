"""What is left out because it was said before: "and the plate too", "the other one"."""

from msgspec.structs import replace

from intents.english.clauses.verb_clauses import SPEECH, first_that_fits, framed, goes_on
from intents.english.frames.devices import device_names
from intents.english.phrases.complements import Complement, ends_clause, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import ME, Scope, is_person, to_object, to_person
from intents.english.reading import Found, SaidVerb, Sentence
from intents.english.substitution import substitute
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import number
from intents.english.words.verbs import verbs_at
from intents.goals import (
    Balance,
    Bring,
    Close,
    Displacement,
    Find,
    Follow,
    ForEach,
    Give,
    Goal,
    GoTo,
    Greet,
    Guide,
    LookAt,
    Meet,
    ObjectQuery,
    Open,
    Person,
    Pick,
    Place,
    Switch,
    Wait,
)

_TOO = lexicon.phrases("too,also,as well,likewise")
_SERVES = lexicon.phrases(
    "will do,would do,will do me,will do fine,will do me fine,will do nicely,will do just fine,"
    "will do me nicely,is fine,is okay,is good,is good enough,will be fine,would be fine,"
    "is fine too,will do too,does it,will have to do,is fine by me,is fine with me,works,works too,"
    "will serve,is also fine,would also do,is all right,will be all right,would be okay"
)
"""How it is said that another thing is as good."""
_MORE = lexicon.phrases("more,some more,further,again more")
_A_BIT_MORE = lexicon.phrases(
    "a bit more,a little more,a bit further,a little further,a bit farther,a little farther,"
    "a touch more,a tad more,slightly more,slightly further,a little bit more,a bit longer,"
    "a little longer,just a bit more,just a little more"
)
_BIT = 0.25
"""Of the last amount: after two metres half a metre, after a quarter turn a quarter of that."""
_LEAST_BIT_M, _LEAST_BIT_RAD, _LEAST_BIT_S = 0.1, 0.17, 1.0
"""Of what a robot does and people see; never more than the last amount."""
_SIDES = lexicon.words("left right up down ahead behind")
_TELLERS = lexicon.words("i we he she they")
"""What begins a statement, and no second object: "come with me, *I am afraid*"."""
_LINKING = ("and", "also", "then", "plus", "next", "about")


def likewise(sentence: Sentence, at: int) -> Found | None:
    """Put the cup on the shelf, *and the plate too*: the same with another."""
    text, before = sentence.text, sentence.before or list(sentence.history)
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    end = text.phrase_end(_TOO, phrase.end) if phrase else None
    linked = text.word(at - 1) == "then" or (
        text.word(at - 1) == "and" and text.word(at - 2) in (FULL_STOP, "oh")
    )
    if phrase and end is None and linked and _is_put(before, phrase):
        end = phrase.end  # put the cup in the sink, then the bowl
    if phrase is None or end is None or not before or not ends_clause(text, end):
        return None
    found = _with_another(_inner(before[-1]), phrase, sentence.scope)
    return (found, end) if found else None


def served(sentence: Sentence, at: int) -> Found | None:
    """If there is none, *the bread will do*: the same with another."""
    text, last = sentence.text, sentence.scope.last
    at += text.word(at) in ("just", "then", "only")
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    end = text.phrase_end(_SERVES, phrase.end) if phrase else None
    if phrase is None or end is None or last is None or not phrase.name("object", "category"):
        return None
    if not (sentence.depth and ends_clause(text, end)):
        return None
    found = _with_another(_inner(last), phrase, sentence.scope)
    return (found, end) if found else None


def _inner(goal: Goal) -> Goal:
    """What is done with each of several."""
    return goal.goals[0] if isinstance(goal, ForEach) and len(goal.goals) == 1 else goal


def _is_put(before: list[Goal], phrase: NounPhrase) -> bool:
    """Whether things are put somewhere, and another is named and nothing else."""
    where = _inner(before[-1]) if before else None
    placed = isinstance(where, Place) and (where.on or where.in_)
    return bool(placed and phrase.name("object") and not phrase.places)


def follow_up(sentence: Sentence, at: int) -> Found | None:
    """*And the plate on the table*, *the other one*, *a bit more*: the last goal anew."""
    text, last = sentence.text, sentence.history[-1] if sentence.history else None
    if sentence.before or last is None or verbs_at(text.words, at):
        return None
    more = text.phrase_end(_MORE, at)
    if more is not None and more == len(text) and isinstance(last, GoTo) and last.by:
        return [last], more
    bit = text.phrase_end(_A_BIT_MORE, at)
    if bit is not None and bit == len(text) and (part := _bit_of(last)):
        return [part], bit
    phrase = noun_phrase(text, at)
    linked = at > 0 and text.word(at - 1) in _LINKING
    if phrase is None or phrase.end < len(text) or not (linked or phrase.other):
        return None
    if isinstance(last, Place) and phrase.places:
        thing = Complement(phrases=[phrase])
        return framed(sentence, "put", text.word(at), [thing], first=at + 1, end=phrase.end)
    found = _with_another(last, phrase, sentence.scope)
    return (found, phrase.end) if found else None


def _bit_of(last: Goal) -> Goal | None:
    """A part of what the last goal was an amount of; None if it was none."""
    if isinstance(last, GoTo) and last.by:
        by = Displacement(
            forward_m=_bit(last.by.forward_m, _LEAST_BIT_M),
            left_m=_bit(last.by.left_m, _LEAST_BIT_M),
            turn_rad=_bit(last.by.turn_rad, _LEAST_BIT_RAD),
        )
        return replace(last, by=by)
    if isinstance(last, Wait | Balance) and last.duration_s:
        return replace(last, duration_s=_bit(last.duration_s, _LEAST_BIT_S))
    return None


def _bit(amount: float | None, least: float) -> float | None:
    if not amount:
        return amount
    size = min(abs(amount), max(_BIT * abs(amount), least))
    return round(size if amount > 0 else -size, 4)


def _with_another(last: Goal, phrase: NounPhrase, scope: Scope) -> list[Goal]:
    """A goal with another thing, device or person; none if it has nothing of the kind."""
    if isinstance(last, Open | Close | Switch):
        act = "switch" if isinstance(last, Switch) else "open"
        names = device_names(Complement(phrases=[phrase]), scope, act)
        return [replace(last, what=name) for name in names]
    if is_person(phrase, scope):
        person = to_person(phrase, scope)
        alike = isinstance(last, Find | Follow | Greet | Guide | Meet)
        return [replace(last, person=person)] if alike else []
    if isinstance(last, Pick | Place | Bring | Give | Find | LookAt):
        return [replace(last, object=to_object(phrase, scope))]
    return []


def counted_out(sentence: Sentence, at: int) -> Found | None:
    """A bun for Ada, *two for Leo*: so many of the same for somebody else."""
    text, last = sentence.text, sentence.scope.last
    amount = number(text.words, at)
    linked = text.word(at - 1) in (COMMA, "and")
    if amount is None or not linked or not isinstance(last, Bring | Give):
        return None
    phrase = noun_phrase(text, amount.end + 1) if text.word(amount.end) in ("for", "to") else None
    if phrase is None or not (phrase.is_person or phrase.noun == "operator"):
        return None
    if amount.value != int(amount.value) or amount.value < 1 or last.object.held:
        return None
    some = replace(last.object, count=int(amount.value))
    return [Bring(object=some, to=to_person(phrase, sentence.scope))], phrase.end


def also_for(sentence: Sentence, at: int) -> Found | None:
    """A bun to Ada *and Leo*: the same for another."""
    text, last = sentence.text, sentence.before[-1] if sentence.before else None
    goal = _inner(last) if last is not None else None
    if not isinstance(goal, Bring | Give) or not isinstance(goal.to, Person):
        return None
    phrase = noun_phrase(text, at) if text.word(at - 1) in (COMMA, "and") else None
    if phrase is None or not (phrase.name("person") or phrase.noun == "operator"):
        return None
    listed = text.word(phrase.end) == "and" and noun_phrase(text, phrase.end + 1)
    if not (ends_clause(text, phrase.end) or listed) or text.word(phrase.end - 1) == "i":
        return None
    to = to_person(phrase, sentence.scope)
    again = replace(goal, to=to)
    who = replace(goal.to, at=None)
    if who in (Person(), Person(gender=who.gender)) and text.word(at - 1) == COMMA:
        sentence.before.pop()  # to the guest, Ada: that is the guest
    return [replace(last, goals=(again,)) if isinstance(last, ForEach) else again], phrase.end


def gapped(sentence: Sentence, at: int) -> Found | None:
    """Put the cup on the table and *the plate on the shelf*: the verb is the one before."""
    said = sentence.notes.verb
    if said is None or sentence.text.word(at) in _TELLERS:
        return None
    complements, end = read_complements(sentence.text, at)
    again = bool(sentence.before) and _has_direction(sentence.before[-1])  # "left and then right"
    told = any(c.phrases or (c.direction and again) for c in complements)
    if len(complements) == 1 and complements[0].role == "" and _tells_which(sentence, at, end):
        return [], end
    if not told or not goes_on(sentence.text, end):
        return None
    if said.at == said.first and (jotted := _jotted_away(sentence, at, complements, end)):
        return jotted
    if "turn" in said.senses and _goes_back(sentence, at, complements):
        return framed(sentence, "go", "go", complements, first=at, end=end)
    kept = [(s, said.first) for s in said.senses if s not in SPEECH and s != "count"]
    found = first_that_fits(sentence, kept, said.at, list(sentence.notes.particles), resumed=at)
    me = any(p.noun in ("operator", "here") for c in complements for p in c.phrases)
    if found is None or me:
        return found
    _share(sentence, said, at, found[0])
    return _to_the_same(sentence, found[0]), found[1]


def _jotted_away(
    sentence: Sentence, at: int, complements: list[Complement], end: int
) -> Found | None:
    """Ball to Leo, then *milk in the fridge*: where it goes, for no verb was said."""
    things = complements[0]
    last = things.phrases[-1] if len(complements) == 1 and things.phrases else None
    where = last.places[-1] if last is not None and last.places and not things.role else None
    if last is None or where is None or where.how not in ("on", "in"):
        return None
    if last.determiner or not (where.of.name("place") and last.name("object", "category")):
        return None
    last.places.pop()
    to = Complement(role="at", how=where.how, phrases=[where.of])
    return framed(sentence, "put", "put", [things, to], first=at, end=end)


def _goes_back(sentence: Sentence, at: int, complements: list[Complement]) -> bool:
    """Turn round and *back to the door*: that is to walk there."""
    somewhere = any(c.phrases and c.role == "to" and c.phrase.is_spot for c in complements)
    return sentence.text.word(at) == "back" and somewhere


def _tells_which(sentence: Sentence, at: int, end: int) -> bool:
    """Put the cup on the tray, *the one that is on the desk*: what is told of the cup."""
    text, last = sentence.text, sentence.before[-1] if sentence.before else None
    phrase = noun_phrase(text, at)
    if phrase is None or phrase.noun != "one" or phrase.determiner != "the" or phrase.other:
        return False
    thing = getattr(last, "object", None) if last is not None else None
    apart = text.word(at - 1) in (COMMA, FULL_STOP) and ends_clause(text, end)
    if not (apart and phrase.places and isinstance(thing, ObjectQuery)) or thing.at or thing.held:
        return False
    told = to_object(phrase, sentence.scope)
    color = told.color or thing.color
    now = replace(thing, at=told.at, relation=told.relation or thing.relation, color=color)
    sentence.before[:] = [substitute(goal, thing, now) for goal in sentence.before]
    return True


_OF_SPEAKER = lexicon.OPERATOR_WORDS | lexicon.words("here back over i for")


def _share(sentence: Sentence, said: SaidVerb, at: int, goals: list[Goal]) -> None:
    """Bring the cup and then *the bowl to Ada*: where to is told once, and is for both."""
    before, goal = sentence.before, goals[0] if goals else None
    last = before[-1] if before else None
    between = sentence.text.words[said.first : at]
    untold = _OF_SPEAKER.isdisjoint(between) and FULL_STOP not in between
    if untold and isinstance(last, Guide) and isinstance(goal, Guide) and last.to is None:
        before[-1] = replace(last, to=goal.to)  # Ada and Leo to the door
    if not untold or not isinstance(last, Bring) or last.to != ME:
        return
    if isinstance(goal, Bring) and goal.to != ME:
        before[-1] = replace(last, to=goal.to)
    elif isinstance(goal, Place) and (goal.on or goal.in_):
        before[-1] = replace(goal, object=last.object)


def _to_the_same(sentence: Sentence, goals: list[Goal]) -> list[Goal]:
    """Bring Ada the cup, then *the bottle*: to her as well."""
    last = sentence.scope.last
    if isinstance(last, Guide) and last.to and len(goals) == 1 and isinstance(goals[0], Guide):
        return [replace(goals[0], to=goals[0].to or last.to)]  # Ada to the door, then Leo
    if not isinstance(last, Bring | Give) or not isinstance(last.to, Person):
        return goals
    to = last.to
    return [_brought_to(goal, to) for goal in goals]


def _brought_to(goal: Goal, to: Person) -> Goal:
    if isinstance(goal, Pick):
        return Bring(object=goal.object, to=to)
    return replace(goal, to=to) if isinstance(goal, Bring) and goal.to == ME else goal


def _has_direction(goal: Goal) -> bool:
    """Whether another direction could stand in it: "to the table and back" is another matter."""
    if isinstance(goal, GoTo):
        return goal.by is not None
    return isinstance(goal, LookAt) and goal.place in _SIDES


def gapped_after_and(sentence: Sentence, at: int) -> Found | None:
    """The same where "and" or "then" stands before it."""
    linked = sentence.text.word(at - 1) in ("then", "and")
    return gapped(sentence, at) if linked else None
