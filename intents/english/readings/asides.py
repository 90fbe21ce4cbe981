"""Asides: words beside a command that ask for nothing by themselves.

Background ("my hands are full"), reasons ("because it is late"), warnings ("mind the step"), and
what is not to be done ("don't touch my phone"). None of them keeps a command from being read, and
none is acted on. A prohibition is noted, and looked at again when the goals are known.
"""

import re

from intents.english.clauses.openings import skip_openings
from intents.english.clauses.told import told_end
from intents.english.clauses.wishes import WISHES
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import is_content
from intents.english.phrases.referents import to_object
from intents.english.phrases.times import tells_when
from intents.english.reading import Forbidden, Found, Sentence
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE, tokenize
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.names import Name
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import ObjectQuery, Person

_WARNS = lexicon.phrases(
    "mind,mind out,watch out,look out,beware,be careful,take care,careful,careful with,caution,"
    "heads up,be aware,be gentle,easy,easy does it,make sure not to,make sure you do not,"
    "watch your,try not to,no rush,no hurry,take your time,no need,no worries,be warned,warning,"
    "attention,be nice,be good,be patient,be quiet,be honest,be brave,be polite,be kind,be fair,"
    "be serious,be sensible,be sweet,be reasonable,be real,be cool,be discreet,be a sport,"
    "gently does it"
)
_FORBIDS = lexicon.phrases(
    "forget,forget about,ignore,skip,do not,never,avoid,no,not,without,but not,and not,only not,"
    "do not you,do not ever,pay no attention to,take no notice of,pay no heed to,never mind about,"
    "rather than,instead of,leave alone,under no circumstances,on no account,in no case"
)
_RELEASES = lexicon.phrases(
    "need not,you need not,do not need to,you do not need to,do not have to,you do not have to,"
    "there is no need to,there is no need for you to,no need to,no need for you to,"
    "it is not necessary to,not necessary to,do not bother to,do not bother with,"
    "i do not need you to,it does not need to,you can skip,do not trouble to"
)
"""What takes an obligation away."""
_KEEPS_AWAY = lexicon.phrases(
    "keep away from,stay away from,keep off,stay off,keep out of,stay out of,stay clear of,"
    "keep clear of,steer clear of,keep your distance from,keep your hands off,stay outside,"
    "keep well away from,do not go near,do not go into,do not go in,do not enter,do not come near"
)
_ONTO = lexicon.words("on onto in into to under behind beside near at inside")
_SAFE = lexicon.words(
    "spill spilling drop dropping break breaking hit hitting bump bumping anything hurt scratch "
    "wake worry rush forget fall falling noise mess just fuss dawdle dilly hurry stumble trip "
    "slip crash knock knocking shake tip crush waste disturb"
)
"""What the robot takes care not to do in any case."""


_LIMBS = lexicon.words(
    "hand hands arm arms finger fingers gripper foot feet leg legs knee knees elbow"
)
_WAYS = lexicon.words("through near past across over along around beside behind between close")
_MOTIONS = lexicon.words(
    "walk walking turn turning move moving run running step stepping bend bending lean leaning "
    "kneel kneeling squat squatting crouch crouching reach reaching lift lifting"
)
_SPOTS = lexicon.words("on in at by with from to under onto into")
"""Where no name follows one of these, it is told how not to do it: "not on the middle one"."""

_HANDED = lexicon.words("me us him her them it this that everyone")
_LEFT = lexicon.words("left dropped forgot forgotten there found bought brought lost delivered put")
"""With one of these in it a statement may tell of a thing for the first time."""


_LEAVES_OUT = lexicon.phrases(
    "skip,skip over,leave out,omit,drop,ignore,jump over,pass over,do not do,forget,forget about,"
    "miss out,cut,cut out,go to,go on to,jump to,skip to,move on to,go back to"
)
_RELATIVE = lexicon.words("that which who whom whose")
"""Straight behind a thing or somebody these begin what tells which is meant."""
_WHICH = lexicon.words("this that the next last first current second third other rest whole one")
_STEPS = lexicon.words("step steps part parts bit stage item move action point")


def told(sentence: Sentence, at: int) -> Found | None:
    """My hands are full, ...; ..., because it is late; he said put it down."""
    end = told_end(sentence.text, at) or _cited(sentence.text, at)
    if sentence.text.word(at) == "before" and tells_when(sentence.text, at):
        end = _clause_end(sentence.text, at, links=False)  # now is before then
    if end is None or end == at or _is_wish(sentence.text, at) or _is_relative(sentence.text, at):
        return None
    if sentence.text.word(at) == QUOTE:
        _mention_cited(sentence, at)
    sentence.scope.unknown = _unknown_thing(sentence.text, at, end)
    _mention(sentence, at, end, described=True)
    return [], end


def _is_relative(text: Text, at: int) -> bool:
    """A cup *that is not chipped*; somebody *who is not Ada*: which one, and no remark."""
    before = text.word(at - 1) if at else COMMA
    return text.word(at) in _RELATIVE and before[0].isalpha() and is_content(text, at - 1)


def _is_wish(text: Text, at: int) -> bool:
    """*I want the cups* ...; *there are two cups* ...: no mere remark, though it may be unclear."""
    there = text.word(at) == "there" and text.word(at + 1) in ("is", "are")
    start = at + 2 if there else text.phrase_end(WISHES, at)
    wanted = noun_phrase(text, start) if start else None
    return wanted is not None and bool(wanted.name("object", "category"))


def warned(sentence: Sentence, at: int) -> Found | None:
    """Mind the step; be careful with it."""
    text = sentence.text
    start = text.phrase_end(_WARNS, at)
    return None if start is None else ([], _clause_end(text, start, links=True))


def released(sentence: Sentence, at: int) -> Found | None:
    """You need not come back; no need to bring it: not asked for, and not forbidden either."""
    text = sentence.text
    start = text.phrase_end(_RELEASES, at)
    if sentence.depth or start is None or start >= len(text):
        return None
    end = _clause_end(text, start, links=False)
    _mention(sentence, start, end)
    return [], end


def leaves_out_step(text: Text) -> bool:
    """Skip this step; leave out the second part of it: of what the robot is at."""
    start = text.phrase_end(_LEAVES_OUT, 0)
    while start is not None and (text.word(start) in _WHICH or text.word(start) in NUMBER_WORDS):
        start += 1
    if start is None or text.word(start) not in _STEPS:
        return False
    after = start + 1 + (text.word(start + 1) in NUMBER_WORDS)
    return after >= len(text) or text.word(after) in ("of", "in")


_PACE = re.compile(
    r"(?:(?:please|now|robot|and|but|can you|could you|you should)[ ,]+)*"
    r"(?:(?:walk|go|move|run|work|come|be|do (?:it|that|this)|get) (?:along |on )?)?"
    r"(?:(?:a (?:little |bit |lot )?|a little bit |much |even |way )?"
    r"(?:faster|slower|quicker|more (?:slowly|quickly|rapidly)|less (?:quickly|slowly))|"
    r"slow(?: it)? down|speed(?: it)? up|get a move on|step on it)"
    r"(?:[ ,]+(?:please|now|robot|then|a (?:bit|little)))*\W*",
    re.IGNORECASE,
)
"""That it is to move at another pace, and nothing else."""


def is_about_pace(said: str) -> bool:
    """Whether a sentence only asks for another pace: "walk faster", "a bit slower, please"."""
    return _PACE.fullmatch(said.strip()) is not None


def forbidden(sentence: Sentence, at: int) -> Found | None:
    """Don't touch my phone; keep away from the stove; no juice for Leo."""
    text = sentence.text
    if sentence.depth:
        return None  # what is not to be done if ... is no aside
    away = text.phrase_end(_KEEPS_AWAY, at)
    start = away or text.phrase_end(_FORBIDS, at)
    if start is None or start >= len(text):
        return None
    end = _clause_end(text, start, links=away is not None and text.word(at) != "do")
    if text.word(start - 1) in ("than", "of"):
        end = _before_order(text, start, end)
    said = text.words[at:end]
    if text.word(at) == "no" and end < len(text) and "?" in text.tokens[end].raw:
        return None  # no milk there? That asks
    if end == start or (text.word(at) == "no" and not is_content(text, start)):
        return None
    onto = _onto(text, start, end)
    _mention(sentence, start, onto or end, described=onto is None)
    if not _SAFE.intersection(said):
        names = _names(text, onto or start, end)
        found = Forbidden(text.raw(at, end), names, away is not None, _how(text, start, end, names))
        sentence.notes.forbidden.append(found)
    return [], end


def _onto(text: Text, start: int, end: int) -> int | None:
    """Don't put the cup *on the shelf*: it may be put elsewhere, and is not there."""
    if text.word(start) not in lexicon.PUTTING:
        return None
    named = (n for n in range(start + 1, end - 1) if text.name_at(n))
    thing = next(named, None)
    match = text.name_at(thing) if thing is not None else None
    behind = range(match.end, end - 1) if match and match.of("object", "category") else range(0)
    return next((n for n in behind if text.word(n) in _ONTO), None)


def _before_order(text: Text, start: int, end: int) -> int:
    """Rather than calling to her *give her a wave*: where what is done instead begins."""
    for n in range(start + 2, end):
        bare = bool(verbs_at(text.words, n)) and base_form(text.word(n)) == text.word(n)
        handed = text.word(n + 1) in lexicon.DETERMINERS | _HANDED
        if bare and handed and text.word(n - 1) not in lexicon.FUNCTION_WORDS - _HANDED:
            return n
    return end


def _how(text: Text, start: int, end: int, names: tuple[Name, ...]) -> bool:
    """Not with your left *hand*; do not go *past* Ada; without *turning*; not *on* this one."""
    said = text.words[start:end]
    motion = not names and bool(_MOTIONS.intersection(said))
    spot = not names and bool(_SPOTS.intersection(said[:1]))
    return motion or spot or not (_LIMBS | _WAYS).isdisjoint(said)


def _cited(text: Text, at: int) -> int | None:
    """*"Mummy said yes!"* - that was Leo: what is cited and not to be said asks for nothing."""
    cited = text.word(at) == QUOTE and text.word(at + 1) in (COMMA, FULL_STOP)
    return at + 1 if cited else None


def _mention_cited(sentence: Sentence, at: int) -> None:
    """Remember the last thing that somebody is cited to have spoken of."""
    words = [token.text for token in tokenize(sentence.text.raw(at, at + 1))]
    for n in range(len(words)):
        match = sentence.text.index.match(words, n)
        if match and match.of("object"):
            sentence.scope.mention(ObjectQuery(name=match.of("object")))


def _unknown_thing(text: Text, at: int, end: int) -> str:
    """What somebody left *a hammer* is called, where no such thing is known: it is "it" then."""
    if not _LEFT.intersection(text.words[at:end]):
        return ""
    for n in range(at, end):
        phrase = noun_phrase(text, n) if text.word(n) in ("a", "an", "some") else None
        if phrase is not None and phrase.noun == "unknown":
            return phrase.said
    return ""


def _mention(sentence: Sentence, start: int, end: int, *, described: bool = False) -> None:
    """Remember the person and the thing that stand between two words: "give *him* ...".

    ``described`` things are where they are told to be.
    """
    for n in range(start, end):
        match = sentence.text.name_at(n)
        person, thing = (match.of("person"), match.of("object")) if match else ("", "")
        spot = match.of("place") if match else ""
        if spot and not sentence.before:
            sentence.scope.device = spot
            sentence.scope.place = sentence.scope.place or spot
        if person:
            sentence.scope.mention(Person(name=person))
        elif thing and not sentence.before:
            known = _described(sentence, n)
            known = known if described or not known else _by_looks(known, thing)
            sentence.scope.mention(known or ObjectQuery(name=thing))


def _by_looks(known: ObjectQuery, name: str) -> ObjectQuery:
    """A thing by what it is told from others by, wherever it is: "the *smallest* cap is hers"."""
    return ObjectQuery(name=name, color=known.color, size=known.size, superlative=known.superlative)


def _described(sentence: Sentence, at: int) -> ObjectQuery | None:
    """The thing at a word with what is said of it: "about the *red* pen *that is on my desk*"."""
    before = lexicon.DETERMINERS | set(lexicon.SIZES) | set(sentence.text.index.colors)
    while sentence.text.word(at - 1) in before:
        at -= 1
    phrase = noun_phrase(sentence.text, at)
    try:
        thing = phrase and to_object(phrase, sentence.scope)
    except ReadingError:
        return None
    return thing or None


def _names(text: Text, start: int, end: int) -> tuple[Name, ...]:
    """The names that stand between two words."""
    found = (text.name_at(n) for n in range(start, end))
    return tuple(name for match in found if match for name in match.names)


def _clause_end(text: Text, at: int, *, links: bool) -> int:
    """Where a clause ends: at a sign, at "but", and with ``links`` at "and" before a verb."""
    begin = at
    while at < len(text) and text.word(at) not in (COMMA, FULL_STOP):
        linked = text.word(at) in ("and", "so", "then") and links
        if (text.word(at) in ("but", "just", "instead") and at > begin) or (
            linked and verbs_at(text.words, at + 1)
        ):
            return at
        at += 1
    return at


_KIN = lexicon.words(
    "mum mom mummy mommy dad daddy papa mama grandma grandpa granny nana auntie uncle son daughter "
    "kids children boys girls everyone everybody alexa siri"
)


_TAKES_BACK = lexicon.words("no nah nope sorry wait rather oops actually pardon")


_MODALS = lexicon.words("can could would will might may won't do did")


_ENDEARING = lexicon.words("my you our")


def _past_endearment(text: Text, at: int) -> int:
    """Ramesh, *beta*, go and ...: past what somebody is called besides, to the sign before more."""
    end = at + 1
    while end < min(at + 4, len(text)) and text.word(end) not in (COMMA, FULL_STOP):
        says_more = text.word(end) in lexicon.FUNCTION_WORDS - _ENDEARING
        if says_more or verbs_at(text.words, end) or text.name_at(end):
            return at
        end += 1
    within = text.word(at) == text.word(end) == COMMA and at + 1 < end < len(text)
    return end if within else at


def somebody_else(text: Text) -> str:
    """Who is spoken to by name and is not the robot; empty if nobody is.

    "Leo, bring me the ball"; "bring me the ball, Leo".
    """
    for at in (0, 1):
        match = text.name_at(at)
        end = match.end if match and match.of("person") else at + (text.word(at) in _KIN)
        calls = at == 0 or text.word(0) in ("hey", "hi", "oi", "yo", "okay", "hello")
        called_more = _past_endearment(text, end)
        after = skip_openings(text, called_more)
        asked = text.word(called_more + 1) in _MODALS and text.word(called_more + 2) == "you"
        told = text.words[called_more + 1 : called_more + 4] == ["your", "good", "self"]
        told = told or (
            text.word(called_more + 1) == "you" and text.word(called_more + 2) in _MODALS
        )
        commands = asked or told or bool(verbs_at(text.words, after)) or after > end + 1
        noted = end < len(text) and text.tokens[end].raw == ":"  # Ada: sitting or lying?
        if end > at and calls and text.word(end) == COMMA and commands and not noted:
            return text.raw(at, end)
    last = next((n for n in range(len(text) - 1, 0, -1) if text.word(n - 1) == COMMA), len(text))
    match = text.name_at(last)
    named = match is not None and match.of("person") and match.end == len(text)
    listed = text.word(last - 2) in lexicon.FUNCTION_WORDS or text.name_at(last - 2)
    person = listed and _names(text, last - 2, last - 1) and (
        _names(text, last - 2, last - 1)[0].kind == "person"
    )  # fmt: skip
    taken_back = text.word(last - 2) in _TAKES_BACK  # to Leo, no, Mia
    noted = text.tokens[last - 1].raw == ":"  # report posture: Ada
    addressed = named and not (person or taken_back or noted) and verbs_at(text.words, 0)
    return text.raw(last, len(text)) if addressed else ""
