"""Questions of yes or no: "is there a cup on the table?", "is Ada sitting or standing?"."""

from intents.english.clauses.coordination import link_at
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import Scope, is_person, sought, to_object, to_person
from intents.english.reading import Found
from intents.english.trouble import Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.text import Text
from intents.goals import Find, Person, Tell

BE = lexicon.words("is are was were do does did can there you see seeing find currently has "
                    "have i am we got be being now it could seen counted available "
                    "around")  # fmt: skip


def skip_being(text: Text, at: int, words: frozenset[str] = BE) -> int:
    """Past "is", "are there" and the like."""
    while text.word(at) in words:
        at += 1
    return at


def read_on(text: Text, phrase: NounPhrase) -> int:
    """Read what stands after the verb of a question: how many cups are *on the table*."""
    after = skip_being(text, phrase.end)
    end, phrase.end = phrase.end, after
    read_postmodifiers(text, phrase)
    if text.word(phrase.end) == "from" and not phrase.places:
        source = noun_phrase(text, phrase.end + 1)
        if source:
            phrase.places.append(Locative(None, source))
            phrase.end = source.end
            read_postmodifiers(text, phrase)
            return skip_being(text, phrase.end)
    if phrase.is_person and text.word(phrase.end) in lexicon.GENDERS:
        phrase.gender = lexicon.GENDERS[text.word(phrase.end)]
        phrase.end += 1
    if phrase.end == after and after < len(text) and text.word(after)[0].isalnum():
        phrase.end = end if text.words[end:after] == ["there"] else after
    return phrase.end


_IS_THERE = lexicon.phrases(
    "does it exist,does there exist,exists there,there exists,have you seen,did you see,is there,"
    "are there,do you see,can you see,there is,there are,is,are"
)
_HERE = lexicon.words("here there around home present about in")
_KINDS: dict[str, str] = dict.fromkeys(lexicon.GENDERS, "gender") | dict.fromkeys(
    (word for phrase in lexicon.POSTURES for word in phrase), "posture"
)
"""What is asked after where one of several is given to choose: a man or a woman, sitting or not."""


def yes_or_no(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Is there a cup on the table? Whether the cup is on the table *and the box on the shelf*.

    Raises:
        Unclear: It is asked whether one thing or another is so.
    """
    found = _one(text, at, scope, to)
    if found is None:
        return None
    goals, end = found
    while (link := link_at(text, end)) and link.joint != ",":
        more = _stated(text, link.start, scope, to)
        if more is None:
            break
        if link.joint != "and":
            raise Unclear("Whether the one or the other? Please ask one by one.")
        goals, end = [*goals, *more[0]], more[1]
    return goals, end


def _one(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Is there a cup on the table? Do you see the bottle? Is the shelf empty?"""
    embedded = text.word(at) in ("if", "whether")
    start = at + embedded
    stated = _stated(text, start, scope, to) if embedded else None
    if stated:
        return stated
    end = text.phrase_end(_IS_THERE, start)
    if end is None or (text.word(start) == "there" and not embedded):
        return None
    phrase = noun_phrase(text, end)
    if phrase is None or text.word(end) == COMMA:
        return None
    if text.word(phrase.end) == "empty" and phrase.is_spot:
        thing = NounPhrase(start, start, noun="object", said="thing", count=1)
        thing.places.append(Locative(None, phrase))
        return [Find(object=to_object(thing, scope))], phrase.end + 1
    told = _either(text, phrase, scope, to) or _posed(text, phrase, scope, to)
    if told:
        return told
    end = read_on(text, phrase)
    end += text.word(end) in ("left", "remaining") and end + 1 == len(text)
    asked_there = text.word(start + 1) == "there" or text.word(start) not in ("is", "are")
    if not phrase.places and _HERE & {text.word(end), text.word(end - 1)}:
        asked_there, end = True, end + (text.word(end) in _HERE)
    return ([sought(phrase, scope)], end) if phrase.places or asked_there else None


def _stated(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Whether *the cup is on the table*; whether *Ada is standing*."""
    phrase = noun_phrase(text, at)
    if phrase is None:
        return None
    told = _either(text, phrase, scope, to)
    if told or text.word(phrase.end) not in ("is", "are"):
        return told
    end = read_on(text, phrase)
    if not phrase.places and text.word(end) in _HERE:
        return [sought(phrase, scope)], end + 1
    posed = _posed(text, phrase, scope, to)
    return posed or (([sought(phrase, scope)], end) if phrase.places else None)


def _posed(text: Text, phrase: NounPhrase, scope: Scope, to: Person | None) -> Found | None:
    """Is Ada standing? Of one that is named it is the posture that is asked after."""
    if not (phrase.posture and phrase.name("person")):
        return None
    phrase.posture = None
    end = phrase.end + (text.word(phrase.end) in ("up", "down", "upright"))
    end += text.word(end) in ("yet", "already", "now", "again")
    return [Tell(person=to_person(phrase, scope), property="posture", to=to)], end


def _either(text: Text, phrase: NounPhrase, scope: Scope, to: Person | None) -> Found | None:
    """Is Ada *sitting or standing*? Whether the guest *is a man or a woman*."""
    end = phrase.end
    while text.word(end) in ("is", "are", "a", "an", "in", "currently"):
        end += 1
    asked = _KINDS.get(text.word(end))
    if asked is None and phrase.posture and text.word(phrase.end) in (COMMA, "or"):
        asked, end = "posture", phrase.end
    end = _past_kind(text, end, asked)
    alternatives = 0
    while asked and text.word(end) in (COMMA, "or"):
        after = end + 1
        while text.word(after) in ("or", "a", "an"):
            after += 1
        if _KINDS.get(text.word(after)) != asked:
            break
        end, alternatives = _past_kind(text, after, asked), alternatives + 1
    if asked is None or not alternatives or not is_person(phrase, scope):
        return None
    phrase.posture = None if asked == "posture" else phrase.posture
    return [Tell(person=to_person(phrase, scope), property=asked, to=to)], end


def _past_kind(text: Text, at: int, asked: str | None) -> int:
    while asked and (_KINDS.get(text.word(at)) == asked or text.word(at) in ("down", "up")):
        at += 1
    return at
