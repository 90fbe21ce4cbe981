"""What is not meant, of what was said: "all cups *but the red one*", "a drink, *not the milk*"."""

from msgspec.structs import replace

from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope, to_object
from intents.english.reading import Found, Sentence
from intents.english.substitution import substitute
from intents.english.words import lexicon
from intents.english.words.excluding import excluding_end
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.verbs import verbs_at
from intents.goals import ForEach, Goal, ObjectQuery

_BUT = ("but",)
_LINKS = ("but", "and", "only", "just", "though")


_STAYS = lexicon.phrases(
    "stays,stay,remains,remain,can stay,may stay,should stay,must stay,is to stay,are to stay,"
    "has to stay,have to stay,is staying,are staying,should remain,is to remain"
)
_KEEPS = lexicon.phrases("keep,leave,please keep,please leave,do leave,do keep,you can leave")
_THERE = lexicon.phrases(
    "put,here,there,behind,out,alone,be,where it is,where they are,as it is,as they are,"
    "out of it,right there,right here,out of there,in its place"
)


def kept_out(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Put the toys in the box, but *the ball stays*, or *keep the ball out*: all but the ball."""
    text = sentence.text
    if not any(map(_is_of_all, last)) or text.word(at - 1) not in (COMMA, FULL_STOP, *_LINKS):
        return None
    kept = text.phrase_end(_KEEPS, at)
    phrase = noun_phrase(text, kept or at)
    about = next((query for goal in last if (query := _about(goal))), None)
    if phrase is None or about is None or phrase.noun not in ("name", "one") or phrase.is_person:
        return None
    if kept and phrase.places and text.word(kept - 1) == "leave":
        return _left_there(sentence, about, phrase, last)
    end = phrase.end if kept else text.phrase_end(_STAYS, phrase.end)
    there = text.phrase_end(_THERE, end) if end else None
    end = there or end
    if end is None or phrase.places or (kept and not there and text.word(at - 1) not in _BUT):
        return None
    if not (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)):
        return None
    without = narrowed(about, to_object(phrase, sentence.scope), phrase, sentence.scope)
    return [substitute(goal, about, without) for goal in last], end


def _left_there(
    sentence: Sentence, about: ObjectQuery, phrase: NounPhrase, last: list[Goal]
) -> Found | None:
    """Put all toys in the box, *leave the ball on the bed*: all but the ball, which stays there.

    What is none of them is put there.
    """
    text, index = sentence.text, sentence.scope.index
    closed = phrase.end >= len(text) or text.word(phrase.end) in (COMMA, FULL_STOP)
    name = phrase.name("object")
    one_of_them = phrase.noun == "one" or (
        name and (name == about.name or index.is_of(name, about.category))
    )
    if not closed or not one_of_them:
        return None
    sentence.notes.passed.append((phrase.start, phrase.end))
    if phrase.noun == "name":
        phrase.places.clear()  # it is left wherever it is
    without = narrowed(about, to_object(phrase, sentence.scope), phrase, sentence.scope)
    return [substitute(goal, about, without) for goal in last], phrase.end


def excluded(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Bring me a drink, *not the milk*; put all toys in the box *except the ball*."""
    text, scope = sentence.text, sentence.scope
    start = excluding_end(text, at)
    if start is None and text.word(at - 1) in _BUT and any(map(_is_of_all, last)):
        start = at
    if start is None and text.word(at) == "only" and any(map(_is_of_all, last)):
        named = noun_phrase(text, at + 1)
        start = at + 1 if named and text.word(named.end) in ("no", "not") else None
    if start is None or (verbs_at(text.words, start) and not text.name_at(start)):
        return None
    phrase = noun_phrase(text, start)
    about = next((query for goal in last if (query := _about(goal))), None)
    end = phrase.end + (text.word(phrase.end) in ("no", "not")) if phrase else at
    closed = phrase and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP))
    if phrase is None or about is None or not closed or phrase.is_spot or phrase.is_person:
        return None
    other = to_object(phrase, scope)
    if about.name and other.name and about.name != other.name:
        sentence.notes.passed.append((at, end))
        return last, end  # all pens, but the markers no: no pen is a marker
    without = narrowed(about, other, phrase, scope)
    if without.except_ is None:
        sentence.notes.passed.append((at, end))  # of two colours the other one comes back
    return [substitute(goal, about, without) for goal in last], end


def _about(goal: Goal) -> ObjectQuery | None:
    query = getattr(goal, "object", None)
    return query if isinstance(query, ObjectQuery) and not query.held else None


def _is_of_all(goal: Goal) -> bool:
    query = _about(goal)
    return isinstance(goal, ForEach) or (query is not None and query.count == "all")


def narrowed(
    about: ObjectQuery, other: ObjectQuery, phrase: NounPhrase, scope: Scope
) -> ObjectQuery:
    """The description without the other thing; of two colours it is the second that is left."""
    marks = scope.index.variants(about.name or "")
    alone = about.count in (None, 1) and len(marks) == 2 and other.color in marks
    if alone and not about.color:
        left = next(mark for mark in marks if mark != other.color)
        return replace(about, color=left)
    if phrase.noun == "one" and phrase.count is None:
        other = replace(other, name=None, category=None)
    return replace(about, except_=replace(other, count=None))
