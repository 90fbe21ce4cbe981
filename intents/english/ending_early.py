"""A stop that hangs on something is no step: "walk 2 metres *but stop after 1 metre*".

It says how far the act before it goes. Where the goal of that act can carry it, it does: a walk or
a turn by so much, a posture or a wait of so long, so many repetitions, half of any of these, the
place where following ends. What the robot cannot tell the coming of ("before the chair", "if Ada is
near", "when I say so") is asked about: nothing is ever read as the whole act and then a stop but
what says no more than that ("and stop there", "stop when you are done").
"""

from msgspec.structs import replace

from intents.english.phrases.complements import connector_end, ends_clause, read_complements
from intents.english.phrases.referents import to_place
from intents.english.reading import Found, Sentence
from intents.english.so_much import ended_after, halved
from intents.english.trouble import ReadingError, Unpromised
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import measure
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import Follow, Goal, GoTo, Stop, Wait

_ENDING = ("stop", "pause", "cancel")
"""Senses of verbs that end or hold what is under way."""
_MANNERS = lexicon.phrases(
    "please,now,right now,at once,immediately,straight away,right away,completely,for good,again,"
    "too,as well,robot,then,everything,what you are doing,doing that,all of it"
)
_DONE = lexicon.phrases(
    "there,here,right there,right here,over there,after that,after this,afterwards,after it,"
    "at the end,on the spot,where you are,in your tracks,"
    "when you are there,when you are done,when you are finished,when you have finished,"
    "when you have done that,when you have done it,when you get there,when you arrive,"
    "when you arrive there,when you have arrived,when you reach it,when that is done,when done,"
    "when finished,when it is done,when there,"
    "once you are there,once you are done,once you are finished,once you have finished,"
    "once you have done that,once you have done it,once you get there,once you arrive,"
    "once you have arrived,once you reach it,once that is done,once done,once finished,once there,"
    "as soon as you are there,as soon as you are done,as soon as you get there,"
    "as soon as you arrive,as soon as you reach it,as soon as that is done,"
    "after you have done that,after you have done it,after you get there,after you arrive,"
    "after you have arrived,after you reach it,after doing that,after doing it,after arriving,"
    "upon arrival,on arrival,at it,in front of it,by it,next to it,near it,beside it,before it"
)
"""That the act before is to be done: to its end, or where it leads."""
_AT = lexicon.phrases(
    "at,in,by,near,beside,in front of,before,next to,close to,when you reach,when you get to,"
    "when you are at,when you are in,when you arrive at,when you have reached,"
    "once you reach,once you get to,once you are at,once you are in,once you arrive at,"
    "once you have reached,as soon as you reach,as soon as you get to,as soon as you are at,"
    "after you reach,after you have reached,after you get to,after you reached,after reaching,"
    "on reaching,upon reaching"
)
"""What stands before where the act before leads: "and stop *at the table*"."""
_HALF = lexicon.phrases(
    "halfway,half way,midway,halfway through,half way through,halfway there,half way there,"
    "at half the distance,at half the time,after half,after half of it,after half of that,"
    "after half the way,after half the distance,after half the time,in the middle"
)
_TIMES = lexicon.words(
    "after before when whenever once if unless until till as while whilst in at on upon by for"
)
_SO_FAR = lexicon.phrases(
    "after,at,after about,after just,after only,after exactly,after roughly,"
    "after doing,after going,after walking,after moving,after turning,after waiting,"
    + ",".join(
        f"{link} you {done}"
        for link in ("after", "once", "when", "as soon as")
        for done in (
            "have gone", "have walked", "have done", "have turned", "have moved", "have covered",
            "have made", "have taken", "have waited", "have squatted", "have come", "did", "went",
            "walked",
        )
    )
)  # fmt: skip
"""What stands before so much of the act that is enough."""
_OR_SO = lexicon.phrases("or so,at most,of it,of that,only,please,of walking,of that walk")


def ended_early(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Walk 2 metres *but stop after 1 metre*: 1 metre, and no step of its own.

    Raises:
        Unpromised: No goal can carry it.
    """
    text = sentence.text
    ending = _ending(text, at)
    if ending is None or not last or text.word(at - 1) == "first":
        return None
    sense, first = ending
    first = _manners_end(text, first)
    end = _clause_end(text, first)
    if first >= end or (sense != "stop" and not _hangs(text, first)):
        return None
    done = text.phrase_end(_DONE, first) or _where_it_leads(sentence, first, last[-1])
    if done and _manners_end(text, done) >= _clause_end(text, done):
        stop = [Stop()] if sense == "stop" else []
        return ([*last, *stop], _manners_end(text, done)) if stop else None
    found = _carried(sentence, at, first, last) if sense == "stop" else None
    if found:
        sentence.notes.passed += [_measured(text, at), (at, found[1])]
        return found
    if sense == "stop" and _is_on_the_way(sentence, at, first, last[-1]):
        return None
    raise Unpromised(_why(text, at, first), tuple(sentence.before))


def untold(text: Text, at: int) -> Unpromised | None:
    """What is asked about a stop with nothing before it that hangs on something; None for others.

    It stands at word ``at``.
    """
    ending = _ending(text, at)
    if ending is None:
        return None
    first = _manners_end(text, ending[1])
    done = text.phrase_end(_DONE, first)
    if not _hangs(text, first) or (done and ends_clause(text, done)):
        return None
    return Unpromised(_why(text, at, first), (Stop(),))


def _why(text: Text, at: int, first: int) -> str:
    end = _clause_end(text, first)
    if text.word(first) in _TIMES:
        return f"I cannot tell when to stop, “{text.raw(first, end)}”"
    return f"I cannot take account of “{text.raw(at, end)}”"


def _ending(text: Text, at: int) -> tuple[str, int] | None:
    """The sense of a verb that ends something, and where it ends with what it ends."""
    found = verbs_at(text.words, at)
    if not found or found[0][0] not in _ENDING:
        return None
    sense, end = found[0]
    word = text.word(end)
    if word.endswith("ing") and base_form(word) != word:  # stop walking
        end = max(after for _, after in verbs_at(text.words, end) or [("", end + 1)])
        end += text.word(end) in lexicon.PRONOUNS
    return sense, end


def _manners_end(text: Text, at: int) -> int:
    while (end := text.phrase_end(_MANNERS, at)) is not None:
        at = end
    return at


def _clause_end(text: Text, at: int) -> int:
    """Where a clause ends: at a sign, or where a connector leads on to another act."""
    while at < len(text) and text.word(at) not in (COMMA, FULL_STOP):
        after = connector_end(text, at)
        if after and verbs_at(text.words, after):
            break
        at += 1
    return at


def _hangs(text: Text, first: int) -> bool:
    if text.word(first) in _TIMES:
        lasts = measure(text.words, first + 1) if text.word(first) == "for" else None
        return text.word(first) != "for" or lasts is not None
    return bool(text.phrase_end(_HALF, first)) or measure(text.words, first) is not None


def _where_it_leads(sentence: Sentence, first: int, goal: Goal) -> int | None:
    """Go to the table and stop *in front of the table*."""
    text = sentence.text
    there = text.phrase_end(_AT, first)
    there = there + (text.word(there) in lexicon.DETERMINERS) if there else None
    named = text.name_at(there) if there else None
    leads_to = {getattr(goal, "place", None), getattr(goal, "to", None)}
    same = named is not None and any(name.name in leads_to for name in named.names)
    return named.end if named and same else None


def _carried(sentence: Sentence, at: int, first: int, last: list[Goal]) -> Found | None:
    """The goals before with the last of them ended by what is said from word ``first`` on."""
    text = sentence.text
    if text.word(first) == "for":
        rest = measure(text.words, first + 1)
        timed = rest is not None and rest.kind == "time" and _closes(text, rest.end)
        return ([*last, Wait(duration_s=rest.value)], rest.end) if rest and timed else None
    half = text.phrase_end(_HALF, first)
    if half and _closes(text, half):
        less = halved(last[-1]) if _is_measured(text, at) else None
        return ([*last[:-1], less], half) if less else None
    start = text.phrase_end(_SO_FAR, first)
    amount = measure(text.words, start) if start else None
    if amount is not None:
        end = text.phrase_end(_OR_SO, amount.end) or amount.end
        less = (
            ended_after(last[-1], amount, said=_is_measured(text, at))
            if _closes(text, end)
            else None
        )
        return ([*last[:-1], less], end) if less else None
    return _up_to_place(sentence, at, first, last)


def _closes(text: Text, at: int) -> bool:
    return at >= _clause_end(text, at)


def _measured(text: Text, at: int) -> tuple[int, int]:
    """Where the clause before a word says how much: "walk *2 metres* but stop ..."."""
    begin = at - 1
    while begin >= 0 and text.word(begin) in (COMMA, "and", "but", "then"):
        begin -= 1
    found = (at, at)
    while begin >= 0 and text.word(begin) not in (COMMA, FULL_STOP, "then"):
        amount = measure(text.words, begin)
        if amount is not None and amount.end <= at:
            found = begin, amount.end
        begin -= 1
    return found


def _is_measured(text: Text, at: int) -> bool:
    begin, end = _measured(text, at)
    return begin < end


def _up_to_place(sentence: Sentence, at: int, first: int, last: list[Goal]) -> Found | None:
    """Follow Ada but stop *at the door*; walk forward and stop *at the table*."""
    text, goal = sentence.text, last[-1]
    place, end = _spot(sentence, first)
    if not place or text.word(first) not in ("at", "when", "once"):
        return None
    if isinstance(goal, Follow) and goal.to is None:
        return [*last[:-1], replace(goal, to=place)], end
    by = goal.by if isinstance(goal, GoTo) else None
    ahead = by is not None and (by.forward_m or 0) > 0 and not by.turn_rad
    return ([*last[:-1], GoTo(place=place)], end) if ahead and not _is_measured(text, at) else None


def _spot(sentence: Sentence, first: int) -> tuple[str, int]:
    """The place that a clause ends with, and where; an empty name if it is none."""
    text = sentence.text
    reaching = text.phrase_end(_AT, first)
    if text.word(first) in ("when", "once") and not reaching:
        return "", first
    begin = first if text.word(first) == "at" or reaching is None else reaching
    try:
        complements, end = read_complements(text, begin)
        for there in complements[:1]:
            spot = there.phrases and there.phrase.is_spot and there.role in ("at", "")
            if spot and there.how in (None, "near") and _closes(text, end):
                return to_place(there.phrase, sentence.scope), end
    except ReadingError:
        pass
    return "", first


def _is_on_the_way(sentence: Sentence, at: int, first: int, goal: Goal) -> bool:
    """Go to the hall *and stop at the bar*: an errand; "but stop at the bar" is none."""
    but = "but" in sentence.text.words[max(0, at - 2) : at]
    walks_by = isinstance(goal, Follow) or (isinstance(goal, GoTo) and goal.place is None)
    place, _ = _spot(sentence, first)
    return bool(place) and sentence.text.word(first) == "at" and not (but or walks_by)
