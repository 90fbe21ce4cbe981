"""Saying, telling and answering: verbs whose complement is words, not things."""

from msgspec.structs import replace

from intents.english.clauses.asking import answer_told, asking
from intents.english.clauses.listeners import (
    QUESTION_WORDS,
    TO,
    addressed_end,
    last_listener,
    listener_at,
    listeners,
    listening_place,
    meant_listener,
    refuse_more,
    refuse_unknown,
)
from intents.english.clauses.markers import marker_end
from intents.english.clauses.messages import (
    before_condition,
    before_times,
    content_end,
    message_start,
)
from intents.english.clauses.openings import skip_openings
from intents.english.clauses.questions import property_question, question
from intents.english.clauses.self_talk import about_robot, small_talk
from intents.english.phrases.complements import connector_end, ends_clause
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import ME, Scope, is_person, to_object, to_person, to_place
from intents.english.reading import Found
from intents.english.trouble import Misfit, NotUnderstood, ReadingError, Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE
from intents.english.words.reported import as_said
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Answer, Count, Find, Goal, Person, Say, Tell

_ABOUT = lexicon.phrases(
    "about,of,know,know about,as to,regarding,that,on,to know,with,out,me with"
)
_SINGS = lexicon.words("sing chant hum")
_WONDERED = lexicon.WH | lexicon.words("if whether about")
_KNOWS = lexicon.phrases("know,in on")
"""Let Ada *know*, let her *in on it*: the rest is hers to do."""
_SEVERAL = 2
_LETTERS = lexicon.words(
    "message messages mail mails email emails letter phone phones telephone telephones call calls "
    "tweet chat door doors doorbell bell intercom buzzer"
)


def _is_broken_off(text: Text, at: int) -> bool:
    """Say to Ada, *no, say to Leo ...*: what was begun is taken back, and not to be said."""
    marked = marker_end(text, at + 1) if text.word(at) == COMMA else None
    if marked is None:
        return False
    begun = [sense for sense, _ in verbs_at(text.words, marked)]
    denied = text.words[marked : marked + 2] == ["do", "not"] or text.word(marked) == "leave"
    return denied or not _SPEAKING.isdisjoint(begun)


_TOLD = {"him": "male", "her": "female"}
"""Tell *him* she is late: who is told is not she."""
_SPEAKING = {"say", "tell", "answer", "inform"}


def say(text: Text, at: int, scope: Scope) -> Found:
    """Say good night to Emil; say "dinner is served"."""
    if text.word(at - 1) in _SINGS and text.word(at) not in (QUOTE, "happy"):
        raise NotUnderstood("I cannot sing")
    if text.word(at) == QUOTE:
        return _quotes(text, at, scope)
    if text.word(at) == COMMA and text.word(at - 1).endswith("ing"):
        raise Misfit("that is to say nothing")  # we are not speaking, though we nod
    itself = about_robot(text, at) if text.word(at - 1) in ("state", "declare") else None
    if itself:
        return itself  # state your position
    to, at = _addressed(text, at, scope) if text.word(at) in TO else (None, at)
    if to is not None and _is_broken_off(text, at):
        return [Find(person=to)], at
    at = message_start(text, at) if to is not None else at
    asked = _asked(text, at, scope)
    if asked and isinstance(asked[0][0], Count):
        return _to_listener(text, asked, scope)
    if to is not None and text.word(at) == COMMA and verbs_at(text.words, at + 1):
        return [Find(person=to)], at
    at += text.word(at) == "that"
    end = before_times(text, at, content_end(text, at))
    stop = end = before_condition(text, at, end, scope)
    addressed = addressed_end(text, at, end, scope) if to is None else None
    if to is None:
        named, end = addressed or (end, end)
        to, stop = last_listener(text, at, named, scope)
    stop, here = _place_of_speech(text, at, stop, scope)
    if stop <= at and text.word(at) != QUOTE:
        if to is None and text.word(at - 1) not in ("speak", "talk", "joke"):
            raise Unclear("What shall I say?")
        return [Say(what="something", to=to)], end
    if here and to is None:
        to = Person(at=here)
    if to is None:
        refuse_unknown(text, at, stop)
    return [Say(what=_words_for(text, at, stop, to), to=to)], end


def _addressed(text: Text, at: int, scope: Scope) -> tuple[Person | None, int]:
    """To whom something is said behind "to", and where the words begin."""
    first = listener_at(text, at + 1, scope)
    if first:
        first = meant_listener(text, first, scope)
        return to_person(first, scope), first.end
    return listening_place(text, at + 1, scope) or (None, at)


def _quotes(text: Text, at: int, scope: Scope) -> Found:
    """Say "hello" to Ada, and then "goodbye" to Emil: one after the other."""
    goals: list[Goal] = []
    end = at
    while text.word(at) == QUOTE:
        stop = next(
            (n for n in range(at + 1, len(text)) if text.word(n) in (QUOTE, FULL_STOP)), len(text)
        )
        end = min(content_end(text, at), stop)
        while end > at + 1 and (text.word(end - 1) == COMMA or connector_end(text, end - 1)):
            end -= 1
        to, _ = last_listener(text, at + 1, end, scope)
        goals.append(Say(what=text.tokens[at].raw, to=to))
        end = end if to else at + 1
        at = skip_openings(text, end)
    return goals, end


def _asked(text: Text, at: int, scope: Scope) -> Found | None:
    """What is to be said as a question to be answered, if it is one."""
    try:
        return question(text, at, scope, told=True)
    except ReadingError:
        return None


def _place_of_speech(text: Text, at: int, end: int, scope: Scope) -> tuple[int, str | None]:
    """Say the time *in the kitchen*: the place where it is to be said."""
    for start in range(at + 1, end):
        place = text.lookup(lexicon.LOCATIVES, start)
        doing = text.word(start - 1).endswith("ing")  # he is waiting in the hall
        stated = text.word(start - 1 - doing) in ("am", "is", "are", "was", "were", "be", "'s")
        if stated and text.word(at) not in lexicon.WH:
            continue
        if place and place[0] in (None, "in"):
            phrase = noun_phrase(text, place[1])
            if phrase and phrase.end == end and phrase.name("room", "place"):
                return start, to_place(phrase, scope)
    return end, None


def _to_listener(text: Text, reading: Found, scope: Scope) -> Found:
    """Read on after a question: ... to the person at the sofa."""
    goals, end = reading
    if text.word(end) == "to":
        phrase = listener_at(text, end + 1, scope)
        if phrase:
            person = to_person(phrase, scope)
            return [_with_listener(g, person) for g in goals], phrase.end
    return reading


def _with_listener(goal: Goal, person: Person) -> Goal:
    return replace(goal, to=person) if isinstance(goal, Count | Tell | Say) else goal


def tell(text: Text, at: int, scope: Scope) -> Found:
    """Tell Ada and Emil that lunch is ready: first the one, then the other."""
    begin = at + (text.word(at) in TO)
    room = listening_place(text, begin, scope)
    if room is not None:
        return _tell(text, room[1], room[0], scope)
    everyone = listeners(text, begin, scope)
    if len(everyone) < _SEVERAL:
        return _tell(text, at, None, scope)
    end = everyone[-1].end
    told = [_tell(text, end, to_person(one, scope), scope) for one in everyone]
    return [goal for goals, _ in told for goal in goals], told[0][1]


def _refuse_no_message(text: Text, at: int, scope: Scope) -> None:
    """Refuse "I wonder *if you could wrap it*", and "let Ada *sleep*".

    Raises:
        Misfit: It is that.
    """
    if text.words[at - 2 : at] == ["i", "wonder"] and text.word(at) not in _WONDERED:
        raise Misfit("that is to tell nothing")
    allowed = listener_at(text, at, scope) if text.word(at - 1) == "let" else None
    if allowed is not None and not text.phrase_end(_KNOWS, allowed.end):
        raise Misfit("that is to let somebody do something")


def _tell(text: Text, at: int, listener: Person | None, scope: Scope) -> Found:
    """Tell me how many cups there are; tell Julia a joke; inform them of the time."""
    _refuse_no_message(text, at, scope)
    to = listener
    at += text.word(at) == "back" and text.word(at - 1) in ("report", "get")
    if text.word(at) in TO and text.word(at) != "for":
        at += 1
    first = None if listener else listener_at(text, at, scope)
    if first and text.word(first.end) != "'s":
        first = meant_listener(text, first, scope)
        to, at = to_person(first, scope), first.end
    if to is not None and _is_broken_off(text, at):
        return [Find(person=to)], at
    if to not in (None, ME) and text.word(at) == COMMA and verbs_at(text.words, at + 1):
        return [Find(person=to)], at
    at += first is not None and text.word(at) == COMMA
    at = text.phrase_end(_ABOUT, at) or at
    at = text.phrase_end(_ABOUT, at) or at
    relayed = answer_told(text, at, scope, to)
    if relayed is not None:
        return relayed
    result = _result_end(text, at)
    found = result or (at if ends_clause(text, at) else None)
    heard_by = listener_at(text, found + 1, scope) if found and text.word(found) == "to" else None
    if heard_by is not None and to is None:
        to, found = to_person(heard_by, scope), heard_by.end
    if found is not None and isinstance(scope.last, Count | Tell):
        return ([replace(scope.last, to=to)] if to not in (None, ME) else []), found
    if found is not None and scope.object and isinstance(scope.last, Find):
        return [Tell(object=scope.object, property="name", to=to)], found
    asked = question(text, at, scope, to, told=True)
    if asked and (to is None or to == ME or not isinstance(asked[0][0], Say)):
        return _to_listener(text, asked, scope)
    if to is not None and to != ME:
        return _said_to(text, at, to, scope)
    end = content_end(text, at)
    heard, stop = last_listener(text, at, end, scope)
    if to is None and heard and heard != ME:
        return [Say(what=text.raw(at, stop), to=heard)], end
    talk = small_talk(text, at, stop)
    if talk is None:
        raise NotUnderstood(f"“{text.raw(at, end)}” is nothing I can find out" if end > at else
                            "I do not know what to tell")  # fmt: skip
    return [Say(what=talk.what, to=to)], end


def inform(text: Text, at: int, scope: Scope) -> Found:
    """Give me the number of cups; show me Emil's pose.

    Raises:
        Misfit: It is a thing that is to be given.
    """
    first = listener_at(text, at, scope)
    if first:
        at = first.end
    to = to_person(first, scope) if first else None
    asked = about_robot(text, at) or property_question(text, at, scope, to)
    end = content_end(text, at)
    talk = small_talk(text, at, end)
    if asked is None and talk:
        return [Say(what=talk.what, to=to)], end
    if asked is None:
        raise Misfit("that is to give something")
    return _to_listener(text, asked, scope)


def describe(text: Text, at: int, scope: Scope) -> Found:
    """Describe the person at the sofa to me.

    Raises:
        Misfit: It is nothing that can be seen.
    """
    to = None
    if text.word(at) in TO:
        first = listener_at(text, at + 1, scope)
        if first:
            to, at = to_person(first, scope), first.end
    asked_after = property_question(text, at, scope, to)
    if asked_after:
        return _to_listener(text, asked_after, scope)
    phrase = noun_phrase(text, at)
    if phrase is None or phrase.noun == "unknown":
        raise Misfit("describe what?")
    if is_person(phrase, scope):
        goal = Tell(person=to_person(phrase, scope), property="description", to=to)
    else:
        query = to_object(phrase, scope, spots=True)
        asked = "name" if query.superlative or query.count else "description"
        goal = Tell(object=query, property=asked, to=to)
    return _to_listener(text, ([goal], phrase.end), scope)


_RESULT = lexicon.phrases(
    "what they are,what it is,what are they,what is it,which they are,what that is,which ones,"
    "the number,the result,the total,what the total is,the answer,how many,them for me,them,it,"
    "the results,them to me,what you found,what you find,what you see,"
    "how many there are,how many you see,how many you found"
)


def _result_end(text: Text, at: int) -> int | None:
    """Where words for what was found end: "the number"; but not how many *cups are on it*."""
    end = text.phrase_end(_RESULT, at)
    return end if end and (ends_clause(text, end) or text.word(end) == "to") else None


def _said_to(text: Text, at: int, to: Person, scope: Scope) -> Found:
    """Tell Julia what day it is; tell her the following: ..."""
    at = message_start(text, at)
    if text.word(at) in ("and", "or"):
        refuse_more(text, at)
    end = before_condition(text, at, content_end(text, at), scope)
    if end == at:
        raise Unclear("What shall I tell?")
    stop, here = _place_of_speech(text, at, end, scope)
    if here and to.at is None:
        to = replace(to, at=here)
    return [Say(what=_words_for(text, at, stop, to), to=to)], end


def _words_for(text: Text, at: int, end: int, to: Person | None) -> str:
    """What is to be said, as whoever is told is to hear it: word for word where it is quoted."""
    if text.word(at) == QUOTE:
        return text.tokens[at].raw
    what = text.raw(at, end)
    if to in (None, ME):
        return what

    def names(word: str) -> bool:
        match = text.index.match([word], 0)
        return match is not None and bool(match.of("person"))

    before = (text.name_at(n) for n in range(at))
    spoken_of = {name for match in before if match and (name := match.of("person"))}
    told = text.words[max(0, at - 2) : at]
    gender = next((one for word, one in _TOLD.items() if word in told), None)
    return as_said(what, to.gender or gender, names, others=bool(spoken_of - {to.name}))


def answer(text: Text, at: int, scope: Scope) -> Found:
    """Answer Emil; answer his quiz; answer "how old are you?"."""
    if text.word(at - 1) == "ask" and (asked := asking(text, at, scope)):
        return asked
    asks = text.word(at - 1) in ("ask", "asks", "asking", "for")
    person = None
    at += text.word(at) in ("to", "with")
    if text.word(at) in ("it", "that", "this") and isinstance(scope.last, Answer):
        return [], at + 1
    first = listener_at(text, at, scope)
    if first:
        person, at = to_person(first, scope), first.end + (text.word(first.end) == "'s")
    start = at
    skipped = lexicon.DETERMINERS | {
        "any",
        "one",
        "to",
        "all",
        "of",
        "questions",
        "whatever",
        "which",
    }
    while text.word(at) in skipped:
        at += 1
    if text.word(at) in QUESTION_WORDS or text.word(at - 1) == "questions":
        what = "quiz" if text.word(at).startswith("quiz") else "question"
        at += text.word(at) in QUESTION_WORDS
        person, end = _asker(text, at, scope, person)
        return [Answer(what=what, person=person)], end
    if asks:
        raise Misfit("ask what?")
    end = _read_out(text, start)
    if _LETTERS.intersection(text.words[start:end]):
        raise NotUnderstood("I can answer questions that I am asked, not messages or calls")
    if text.word(end) == FULL_STOP and text.word(end + 1) == "to":
        listener = listener_at(text, end + 2, scope)
        if listener:
            person, end = to_person(listener, scope), listener.end
    return [Answer(what="question", person=person)], end


def _asker(text: Text, at: int, scope: Scope, person: Person | None) -> tuple[Person | None, int]:
    """Of somebody outside; asked by Ada; that Ada has."""
    skipped = lexicon.words("asked posed given that you will be are is which being they he she ask "
                            "asks may have has from of by for to on in at about with")  # fmt: skip
    where = text.lookup(lexicon.LOCATIVES, at)
    if where and where[0] in (None, "in", "on", "near"):
        phrase = noun_phrase(text, where[1])
        if phrase and phrase.name("room", "place") and (person is None or person.at is None):
            here = to_place(phrase, scope)
            return replace(person, at=here) if person else Person(at=here), phrase.end
    whose = NounPhrase(at, at, noun="person", said="person")
    if text.word(at) == "who":
        read_postmodifiers(text, whose)
        if whose.end > at and person:
            return replace(person, at=to_person(whose, scope).at or person.at), whose.end
    end = at
    while text.word(end) in skipped:
        end += 1
    phrase = listener_at(text, end, scope)
    if phrase and end == at and text.word(phrase.end) not in ("has", "have", "asks", "is"):
        phrase = None
    if phrase is None:
        return person, end
    after = phrase.end
    while text.word(after) in ("has", "have", "asks", "is", "asking"):
        after += 1
    after += 2 if text.words[after : after + 2] == ["for", "you"] else 0
    return person or to_person(phrase, scope), after


def _read_out(text: Text, at: int) -> int:
    """It is read out, up to the end of its sentence."""
    while at < len(text) and text.word(at) != FULL_STOP:
        at += 1
    return at
