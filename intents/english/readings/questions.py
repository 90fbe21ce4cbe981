"""What is asked: "what are you holding?", "how many cups are there?", "look whether ..."."""

from msgspec.structs import replace

from intents.english.clauses import questions as syntax
from intents.english.clauses import self_talk
from intents.english.phrases.complements import ends_clause
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.referents import ME, is_person, sought, to_object, to_person
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.goals import Count, Find, ObjectQuery, Tell

_LOOKS = lexicon.phrases("look,see,check,go see,go and see,find out,have a look,go check")

_GOES = lexicon.phrases(
    "go and have a look,go have a look,have a look,take a look,go and take a look,go look,"
    "go and look,go and check,go check,go and see,go see,check,have a look for me,check for me,"
    "go and find out,find out,look and see"
)
"""How one goes to see what was asked; nothing more is to be done."""
_POSTURE_OF = lexicon.phrases(
    "report posture,check posture,state posture,note posture,posture,report the posture,"
    "report on posture,posture check,check the posture"
)
_INSIDE = frozenset(
    (*told.split(), *what.split())
    for told in ("", "tell me", "see", "look", "say", "let me know", "report", "check")
    for what in ("what is inside", "what is in it", "what is in there", "what is inside it")
)
_SEEN = lexicon.phrases(
    "has anyone seen,has anybody seen,did anyone see,anyone seen,do we have,do we still have,"
    "have we got,have we still got,is there still,are there still,do we happen to have,"
    "did i leave,did i put,did i forget,have i left,have i forgotten,did i drop,did we leave"
)


def about_robot(sentence: Sentence, at: int) -> Found | None:
    """What are you holding? How are you?"""
    return self_talk.about_robot(sentence.text, at)


def posture_noted(sentence: Sentence, at: int) -> Found | None:
    """Patient on the couch: *sitting or lying*?; *report posture*: Ravi, on the sofa."""
    text = sentence.text
    start = text.phrase_end(_POSTURE_OF, at)
    begin = at if start is None else start + (text.word(start) in (COMMA, "of", "for"))
    phrase = noun_phrase(text, begin) if text.word(begin)[0].isalpha() else None
    if phrase is None or not phrase.is_person:
        return None
    end = phrase.end
    if start is None and text.word(end) != COMMA:
        return None
    if start is None:
        one = text.lookup(lexicon.POSTURES, end + 1)
        other = text.lookup(lexicon.POSTURES, one[1] + 1) if one else None
        if one is None or other is None or text.word(one[1]) != "or":
            return None
        end = other[1]
    elif text.word(end) == COMMA:
        phrase.end = end + 1
        read_postmodifiers(text, phrase)
        end = phrase.end if phrase.end > end + 1 else end
    return [Tell(person=to_person(phrase, sentence.scope), property="posture")], end


def question(sentence: Sentence, at: int) -> Found | None:
    """How many cups are there?"""
    if sentence.text.word(at) == "if":
        return None  # a condition, of which a part may not be understood
    return syntax.question(sentence.text, at, sentence.scope)


def which_room(sentence: Sentence, at: int) -> Found | None:
    """Which room is Ada in? What room are the keys in?"""
    text = sentence.text
    asked = text.word(at) in ("which", "what") and text.word(at + 1) in ("room", "place")
    phrase = noun_phrase(text, at + 3) if asked and text.word(at + 2) in ("is", "are") else None
    if phrase is None or not (phrase.name("object", "category") or phrase.is_person):
        return None
    end = phrase.end + (text.word(phrase.end) == "in")
    return ([sought(phrase, sentence.scope)], end) if ends_clause(text, end) else None


def inside(sentence: Sentence, at: int) -> Found | None:
    """Open the cupboard and tell me *what is inside*."""
    text, scope = sentence.text, sentence.scope
    end = text.phrase_end(_INSIDE, at)
    place = scope.device or scope.place
    if end is None or place is None or not ends_clause(text, end):
        return None
    to = ME if "me" in text.words[at:end] else None
    return [Tell(property="name", object=ObjectQuery(at=place), to=to)], end


def any_left(sentence: Sentence, at: int) -> Found | None:
    """Any juice left in the fridge?"""
    text = sentence.text
    phrase = noun_phrase(text, at) if at == 0 and text.word(at) == "any" else None
    if phrase is None or not phrase.name("object", "category"):
        return None
    left = text.word(phrase.end) == "left" or text.word(phrase.end - 1) == "left"
    if not (phrase.places or left) or phrase.end + 1 < len(text):
        return None
    return [Find(object=to_object(phrase, sentence.scope))], len(text)


def whether(sentence: Sentence, at: int) -> Found | None:
    """Look whether the ball is behind the box; go and see how many there are."""
    start = sentence.text.phrase_end(_LOOKS, at)
    text = sentence.text
    if start is None:
        return None
    there = _is_there(sentence, start + 1)
    if text.word(start) in ("if", "whether") and there:
        return there
    counts = text.words[start : start + 2] == ["how", "many"]
    asked = counts or text.word(start) in ("if", "whether", "who", "what", "which")
    return syntax.question(text, start, sentence.scope) if asked else None


def went_to_see(sentence: Sentence, at: int) -> Found | None:
    """I wonder whether Ada is in the hall, *could you go and have a look*."""
    text, before = sentence.text, sentence.before
    end = text.phrase_end(_GOES, at)
    if end is None or not ends_clause(text, end):
        return None
    if before:
        return ([], end) if isinstance(before[-1], Find | Count | Tell) else None
    there = sentence.scope.object  # I think I left my cap in the hall, could you check
    return ([Find(object=there)], end) if there is not None and there.at and at else None


def _is_there(sentence: Sentence, at: int) -> Found | None:
    """See whether *the bottle is there*: at the place spoken of."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at)
    if phrase is None or phrase.places or (scope.place is None and not phrase.is_person):
        return None
    if text.words[phrase.end : phrase.end + 2] not in (["is", "there"], ["are", "there"]):
        return None
    if is_person(phrase, scope):
        someone = to_person(phrase, scope)
        return [Find(person=replace(someone, at=scope.place))], phrase.end + 2
    there = to_object(phrase, scope)
    return [Find(object=replace(there, at=scope.place))], phrase.end + 2


def seen(sentence: Sentence, at: int) -> Found | None:
    """Has anyone seen my umbrella? Do we still have bananas? It is looked for."""
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(_SEEN, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None or not phrase.name("object", "category"):
        return None
    end = phrase.end
    while text.word(end) in ("left", "anywhere", "around", "somewhere", "lately", "recently"):
        end += 1
    return [Find(object=to_object(phrase, scope))], end
