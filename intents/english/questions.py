"""Questions, asked outright ("how many cups are there?") or after tell ("... how many ...")."""

from intents.english import lexicon
from intents.english.lexer import COMMA
from intents.english.measures import number
from intents.english.noun_phrases import Locative, NounPhrase, noun_phrase
from intents.english.postmodifiers import read_postmodifiers, weight_at
from intents.english.properties import property_of
from intents.english.referents import Scope, is_person, to_object, to_person
from intents.english.text import Text
from intents.goals import Count, Find, Goal, ObjectQuery, Person, Report, ReportTopic, Say, Tell

Reading = tuple[list[Goal], int]

_BE = lexicon.words("is are was were do does did can there you see find currently has have i am "
                    "be being now it could seen counted available around")  # fmt: skip
_ABOUT_ROBOT: dict[ReportTopic, str] = {
    "holding": "what are you holding,what do you hold,what do you have in your hand,what is "
    "in your "
    "hand,what have you got,what are you carrying,what do you have in your hands,what are you "
    "holding in your hand,what you are holding,what do you carry,what did you pick up,what is in "
    "your gripper,do you have anything in your hand,are you holding anything,are you holding "
    "something,what you have in your hand,what have you picked up",
    "seeing": "what do you see,what can you see,what are you looking at,what are you seeing,"
    "what is "
    "in front of you,what you see,what you can see,what is around you,what objects do you see,what "
    "are you able to see,what objects can you see",
    "location": "where are you,where you are,what is your position,what is your location,where are "
    "you right now,where are you now,your position,your location",
    "status": "what are you doing,what is your status,what are you up to,how is it going,how "
    "far are "
    "you,are you done,are you finished,are you ready,what is the status,what you are doing,what is "
    "going on,your status,what are you working on,what is your current task,are you busy,what are "
    "you doing right now,what are you doing now",
    "health": "how are you,how are you doing,are you okay,are you alright,are you all right,how do "
    "you feel,what is your battery level,how much battery do you have,is everything okay,is "
    "anything "
    "wrong,are you healthy,how is your battery,how is your health,your health,how hot are your "
    "motors,are your motors hot",
    "why": "why did you stop,why did you fail,what went wrong,what happened,why are you "
    "stopping,why "
    "did you do that,why did it fail,why have you stopped,why are you not moving,why did you "
    "not do "
    "it,why is that,why,why not,why did you drop it,why did you fall,why did you stop moving,why "
    "are you waiting,what is wrong,what is the problem,what was that",
    "capabilities": "who are you,what are you,what can you do,what are you able to do,what "
    "you can do,how can you help,how "
    "can you help me,what are your skills,what do you know how to do,what commands do you know,"
    "what can i say,what can i ask you,help,what can i tell you to do,what do you understand",
}
_TOPICS: dict[lexicon.Phrase, ReportTopic] = {
    phrase: topic for topic, text in _ABOUT_ROBOT.items() for phrase in lexicon.phrases(text)
}
_SMALL_TALK = lexicon.words(
    "what which is it the a an of today tomorrow day time date week month current now this joke "
    "something about yourself your team teams 's name affiliation country leader are you who "
    "me s in year "
    "to know whether dream or not on electric sheep tell day's time's right be funny"
)
_SMALL_TALK_HEADS = lexicon.words(
    "time day date joke yourself name affiliation country something dream"
)


def question(
    text: Text, at: int, scope: Scope, to: Person | None = None, *, told: bool = False
) -> Reading | None:
    """The question that begins at a word, as goals; None if there is none to be read.

    After tell (``told``) a noun phrase alone can be a question: "the largest object".
    """
    return (
        about_robot(text, at)
        or _how_many(text, at, scope, to)
        or _where(text, at, scope)
        or _property(text, at, scope, to)
        or _which(text, at, scope, to, told)
        or _who(text, at, scope, to)
        or _is_there(text, at, scope)
    )


def property_question(text: Text, at: int, scope: Scope, to: Person | None) -> Reading | None:
    """A question after "give me", where a thing could stand as well: the number of, the pose."""
    return _how_many(text, at, scope, to) or _property(text, at, scope, to)


def small_talk(text: Text, at: int, end: int) -> Say | None:
    """The time, a joke, something about itself: what the robot can tell without looking."""
    words = text.words[at:end]
    known = bool(words) and all(w in _SMALL_TALK for w in words)
    if known and any(w in _SMALL_TALK_HEADS for w in words):
        return Say(what=text.raw(at, end))
    return None


def about_robot(text: Text, at: int) -> Reading | None:
    """What are you holding? How are you? What can you do?"""
    found = text.lookup(_TOPICS, at)
    if found is None or not (found[1] >= len(text) or not text.word(found[1])[0].isalnum()):
        return None
    goals: list[Goal] = [Report(topic=found[0])]
    return goals, found[1]


def _skip(text: Text, at: int, words: frozenset[str] = _BE) -> int:
    while text.word(at) in words:
        at += 1
    return at


def _read_on(text: Text, phrase: NounPhrase) -> int:
    """Read what stands after the verb of a question: how many cups are *on the table*."""
    after = _skip(text, phrase.end)
    end, phrase.end = phrase.end, after
    read_postmodifiers(text, phrase)
    if text.word(phrase.end) == "from" and not phrase.places:
        source = noun_phrase(text, phrase.end + 1)
        if source:
            phrase.places.append(Locative(None, source))
            phrase.end = source.end
            read_postmodifiers(text, phrase)
            return _skip(text, phrase.end)
    if phrase.is_person and text.word(phrase.end) in lexicon.GENDERS:
        phrase.gender = lexicon.GENDERS[text.word(phrase.end)]
        phrase.end += 1
    if phrase.end == after and after < len(text) and text.word(after)[0].isalnum():
        phrase.end = end if text.words[end:after] == ["there"] else after
    return phrase.end


def _how_many(text: Text, at: int, scope: Scope, to: Person | None) -> Reading | None:
    """How many people in the office are wearing red?"""
    start = at + (text.word(at) == "the")
    if text.words[start : start + 2] == ["how", "many"] or (
        text.word(start) in ("number", "amount", "quantity") and text.word(start + 1) == "of"
    ):
        start += 2
    else:
        return None
    phrase = noun_phrase(text, start)
    if phrase is None:
        return None
    end = _read_on(text, phrase)
    if is_person(phrase, scope):
        return [Count(person=to_person(phrase, scope), to=to)], end
    return [Count(object=to_object(phrase, scope), to=to)], end


def _where(text: Text, at: int, scope: Scope) -> Reading | None:
    """Where is the cup? Tell me where the cup is."""
    if text.word(at) != "where":
        return None
    phrase = noun_phrase(text, _skip(text, at + 1))
    if phrase is None:
        return None
    end = _read_on(text, phrase)
    if is_person(phrase, scope):
        return [Find(person=to_person(phrase, scope))], end
    return [Find(object=to_object(phrase, scope, spots=True))], end


def _property(text: Text, at: int, scope: Scope, to: Person | None) -> Reading | None:
    """What is the pose of the person? The person's pose; what pose the person is in."""
    asked = text.word(at) in ("what", "which")
    start = _skip(text, at + asked)
    start += text.word(start) in ("the", "its", "their", "his", "her")
    name = None if text.name_at(start) else property_of(text.word(start))
    if name:
        of = text.word(start + 1) in ("of", "for")
        inner = start + 2 if of else _skip(text, start + 1)
        phrase = noun_phrase(text, inner)
        if phrase is None and text.word(start - 1) in ("its", "their", "his", "her"):
            return [_tell(None, name, scope, to)], start + 1
        if phrase is None or not (of or asked):
            return None
        end = _read_on(text, phrase)
        end += text.word(end) in ("in", "doing", "making")
        return [_tell(phrase, name, scope, to)], end
    phrase = noun_phrase(text, start)
    name = property_of(text.word(phrase.end + 1)) if phrase else None
    if phrase and name and text.word(phrase.end) == "'s":
        end, phrase.end = phrase.end + 2, phrase.end + 2
        return [_tell(phrase, name, scope, to)], max(end, _read_on(text, phrase))
    return None


def _tell(phrase: NounPhrase | None, name: str, scope: Scope, to: Person | None) -> Tell:
    if phrase is None:
        last = scope.person if scope.person_is_last or scope.object is None else None
        if last:
            return Tell(person=last, property=name, to=to)
        return Tell(object=scope.object or ObjectQuery(held=True), property=name, to=to)
    if is_person(phrase, scope):
        return Tell(person=to_person(phrase, scope), property=name, to=to)
    name = "location" if name == "posture" else name
    return Tell(object=to_object(phrase, scope, spots=True), property=name, to=to)


def _which(text: Text, at: int, scope: Scope, to: Person | None, told: bool) -> Reading | None:
    """Which object is the lightest on the table? What are the three largest things there?"""
    asked = text.word(at) in ("what", "which")
    start = _skip(text, at + 1) if asked else at
    start += text.words[start : start + 2] == ["one", "of"]
    start += asked and text.word(start) == "of"
    if asked and text.lookup(lexicon.LOCATIVES, start):
        phrase = NounPhrase(start, start, noun="object", said="object")
        read_postmodifiers(text, phrase)
        end = phrase.end
    else:
        found = noun_phrase(text, start)
        if found is None or not (asked or (told and found.superlative)):
            return None
        phrase, end = found, _read_on(text, found)
        end = _predicate_superlative(text, phrase, end)
    if is_person(phrase, scope):
        return [Tell(person=to_person(phrase, scope), property="name", to=to)], end
    informative = phrase.superlative or phrase.places or phrase.color
    if not informative or phrase.noun in ("pronoun", "unknown"):
        return None
    return [Tell(object=to_object(phrase, scope), property="name", to=to)], end


def _predicate_superlative(text: Text, phrase: NounPhrase, end: int) -> int:
    """Which object is *the lightest one on the table*."""
    start = end + (text.word(end) == "the")
    weight = weight_at(text, start)
    if weight:
        phrase.superlative, phrase.end = weight
        read_postmodifiers(text, phrase)
        return phrase.end
    amount = number(text.words, start)
    if amount and text.lookup(lexicon.SUPERLATIVES, amount.end):
        phrase.count, start = int(amount.value), amount.end
    most = text.lookup(lexicon.SUPERLATIVES, start)
    if most is None:
        return end
    phrase.superlative = most[0]
    phrase.end = most[1] + (text.word(most[1]) in lexicon.ONES | lexicon.OBJECT_NOUNS)
    read_postmodifiers(text, phrase)
    return phrase.end


def _who(text: Text, at: int, scope: Scope, to: Person | None) -> Reading | None:
    """Who is in the kitchen?"""
    if text.word(at) not in ("who", "whom"):
        return None
    start = _skip(text, at + 1)
    phrase = NounPhrase(start, start, noun="person", said="person")
    read_postmodifiers(text, phrase)
    if phrase.end == start:
        named = noun_phrase(text, start)
        if named is None or not is_person(named, scope):
            return None
        phrase = named
        phrase.end = _read_on(text, phrase)
    return [Tell(person=to_person(phrase, scope), property="name", to=to)], phrase.end


def _is_there(text: Text, at: int, scope: Scope) -> Reading | None:
    """Is there a cup on the table? Do you see the bottle?"""
    start = at + (text.word(at) in ("if", "whether"))
    openings = lexicon.phrases(
        "is there,are there,do you see,can you see,there is,there are,is,are"
    )
    end = text.phrase_end(openings, start)
    if end is None or (text.word(start) == "there" and start == at):
        return None
    phrase = noun_phrase(text, end)
    if phrase is None or text.word(end) == COMMA:
        return None
    end = _read_on(text, phrase)
    if (
        phrase.places == []
        and text.word(start) in ("is", "are")
        and text.word(start + 1) != "there"
    ):
        return None
    told = _EITHER.get(text.word(end))
    if is_person(phrase, scope):
        if told:
            after = end + 1 + 2 * (text.word(end + 1) == "or")
            phrase.posture = None
            return [Tell(person=to_person(phrase, scope), property=told)], after
        return [Find(person=to_person(phrase, scope))], end
    return [Find(object=to_object(phrase, scope))], end


_EITHER: dict[str, str] = dict.fromkeys(("male", "female", "boy", "girl"), "gender")
