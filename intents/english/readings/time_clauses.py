"""When: "before you go there, ...", "when you are in the lab, ...", "in ten seconds, ..."."""

from intents.english.clauses.messages import content_end
from intents.english.clauses.openings import begins_clause, skip_openings
from intents.english.clauses.verb_clauses import framed, read_verb
from intents.english.phrases.complements import Complement, ends_clause, read_complements
from intents.english.phrases.referents import to_place
from intents.english.phrases.times import ARRIVED
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import measure
from intents.english.words.verbs import verbs_at
from intents.goals import GoTo, Wait

_TOLD = lexicon.phrases(
    "until i,until we,until further notice,until you are told,until told,until you hear,"
    "until my signal,until my command,until my word,until someone tells you,"
    "until somebody tells you"
)
_GIVE_IT = lexicon.phrases(
    "give it,take,give me,give them,give him,give her,leave it,allow,allow it,let it be for"
)
_NOT = lexicon.phrases("do not,do not you,never,you do not,you must not,must not")
_IN_A_WHILE = lexicon.words("in after")


def one_before_the_other(sentence: Sentence, at: int) -> Found | None:
    """Before you go to the shelf, pick up the cup: the other way round."""
    text = sentence.text
    word = text.word(at)
    if word not in ("before", "after", "once", "when") or not begins_clause(text, at + 1):
        return None
    one, end = clause_by_itself(sentence, skip_openings(text, at + 1))
    for goal in one:
        sentence.scope.mention_goal(goal)
    other, end = clause_by_itself(sentence, skip_openings(text, end))
    return ([*other, *one] if word == "before" else [*one, *other]), end


def not_until(sentence: Sentence, at: int) -> Found | None:
    """Do not go there *until you have* closed the door: the other one first."""
    text = sentence.text
    start = text.phrase_end(_NOT, at)
    if start is None or not verbs_at(text.words, start):
        return None
    link = start
    while not (link >= len(text) or text.word(link) in ("until", "before", FULL_STOP)):
        link += 1
    if text.word(link + 1) != "you" or not verbs_at(text.words, link + 2):
        return None
    later, end = clause_by_itself(sentence, start)
    if end not in (link, link - 1):
        return None
    first, end = clause_by_itself(sentence, link + 2)
    return [*first, *later], end


def until_told(sentence: Sentence, at: int) -> Found | None:
    """Wait at the door *until I call you*: without an end of its own."""
    text = sentence.text
    first = next((end for sense, end in verbs_at(text.words, at) if sense == "wait"), None)
    until = first
    while until is not None and not ends_clause(text, until) and text.word(until) != "until":
        until += 1
    if first is None or until is None or not text.phrase_end(_TOLD, until):
        return None
    complements, _ = read_complements(text, first)
    complements = [c for c in complements if not c.phrases or c.phrase.start < until]
    verb = " ".join(text.words[at:first])
    return framed(sentence, "wait", verb, complements, first=first, end=content_end(text, until))


def arrived(sentence: Sentence, at: int) -> Found | None:
    """*When you are in the lab*, look for the pencil: first go there."""
    text = sentence.text
    start = text.phrase_end(ARRIVED, at)
    if start is None:
        return None
    complements, end = read_complements(text, start)
    there = complements[0] if len(complements) == 1 and complements[0].phrases else None
    if there is None or there.role not in ("at", "to", "into", "") or not there.phrase.is_spot:
        return None
    place = to_place(there.phrase, sentence.scope)
    return [GoTo(place=place)], end + (text.word(end) == COMMA)


def in_a_while(sentence: Sentence, at: int) -> Found | None:
    """In twenty seconds, ...; give it five seconds; for ten seconds, stand on one leg."""
    text = sentence.text
    if text.word(at) == "for":
        amount = measure(text.words, at + 1)
        start = amount.end + (text.word(amount.end) == COMMA) if amount else at
        timed = amount and amount.kind == "time" and verbs_at(text.words, start)
        return read_verb(sentence, start, [Complement(measure=amount)]) if timed else None
    start = at + 1 if text.word(at) in _IN_A_WHILE else text.phrase_end(_GIVE_IT, at)
    amount = measure(text.words, start) if start else None
    if amount is None or amount.kind != "time":
        return None
    goes_on = text.word(at) in _IN_A_WHILE
    if goes_on and amount.end >= len(text):
        return None
    end = amount.end + (goes_on and text.word(amount.end) == COMMA)
    return [Wait(duration_s=amount.value)], end
