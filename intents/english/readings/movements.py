"""Movements in set phrases: "step aside", "patrol between table and shelf", "go to x = 1"."""

from intents.english.phrases.complements import ends_clause, read_list
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import to_place
from intents.english.reading import Found, Sentence
from intents.english.repeating import repeated
from intents.english.trouble import Unclear
from intents.english.words import lexicon
from intents.english.words.measures import measure, number
from intents.english.words.verbs import verbs_at
from intents.goals import GoTo, Pose2

_TO_AND_FRO = lexicon.phrases(
    "patrol between,commute between,pace between,pace back and forth between,"
    "go back and forth between,walk back and forth between,move back and forth between,"
    "run back and forth between,go to and fro between,walk to and fro between"
)
_THROUGH = lexicon.phrases("through,of,to,at,in,around,between,along,from")
_ROUNDS = ("round", "rounds", "tour", "tours", "lap", "laps", "patrol", "patrols")
_ALL_ROOMS = lexicon.EVERY_ROOM | lexicon.phrases("the rooms")
_ASIDE = lexicon.phrases(
    "step aside,move aside,go aside,stand aside,get out of the way,get out of my way,"
    "move out of the way,move out of my way,go out of the way,out of the way,out of my way,"
    "make way,make room,clear the way,move over,step to the side,move to the side,go to the side,"
    "take a step aside,take a step to the side,sidestep,side step,stay out of the way,"
    "step out of the way,keep out of the way,let me pass,let me through,let us through"
)
_POSE = lexicon.words("x y position point coordinates coordinate pose location the at and to , yaw")


_AT = _POSE - lexicon.words("the and ,")
"""With none of these, two amounts are no coordinates: "walk 2 metres and 1"."""


def out_of_the_way(sentence: Sentence, at: int) -> None:
    """Step aside.

    Raises:
        Unclear: That is what was said: to which side is to be asked.
    """
    end = sentence.text.phrase_end(_ASIDE, at)
    if end is not None and ends_clause(sentence.text, end):
        sides = ("step to the left", "step to the right")
        raise Unclear("To the left or to the right?", sides, sentence.text.raw(at, end))


def to_and_fro(sentence: Sentence, at: int) -> Found | None:
    """Patrol between the table and the shelf three times."""
    text = sentence.text
    start = text.phrase_end(_TO_AND_FRO, at)
    one = noun_phrase(text, start) if start else None
    other = noun_phrase(text, one.end + 1) if one and text.word(one.end) == "and" else None
    if one is None or other is None:
        return None
    there = tuple(GoTo(place=to_place(phrase, sentence.scope)) for phrase in (one, other))
    often = measure(text.words, other.end)
    if often is None or often.kind != "times":
        raise Unclear("How many times shall I go to and fro?")
    return repeated(list(there), often.value), often.end


def patrol(sentence: Sentence, at: int) -> Found | None:
    """Patrol the kitchen, the hall and the bedroom twice; once, if it is not said how often."""
    text = sentence.text
    start = text.phrase_end(lexicon.PATROLS, at)
    counted = number(text.words, at + 1) if text.word(at) in ("do", "make", "go") else None
    if start is None and counted and text.word(counted.end) in _ROUNDS:
        times, start = counted, counted.end + 1
    elif start is not None:
        early = measure(text.words, start)  # patrol twice through the kitchen and the hall
        times = early if early is not None and early.kind == "times" else None
        start = times.end if times else start
    else:
        return None
    if times is None and text.word(start) == "between":
        return None  # to and fro, which asks how often
    start = text.phrase_end(_THROUGH, start) or start
    there, end = _rounds(sentence, start)
    if not there:
        return None
    late = measure(text.words, end)
    if times is None and late is not None and late.kind == "times":
        times, end = late, late.end
    return repeated(list(there), times.value if times else 1), end


def _rounds(sentence: Sentence, at: int) -> tuple[tuple[GoTo, ...], int]:
    """Where a patrol leads, described from a word on, and where that ends; nowhere: not told."""
    text = sentence.text
    end = text.phrase_end(_ALL_ROOMS, at)
    if end is not None:
        return tuple(GoTo(place=room) for room in text.index.rooms), end
    phrases, end = read_list(text, at)
    if not all(phrase.is_spot or phrase.name("room") for phrase in phrases):
        return (), end
    return tuple(GoTo(place=to_place(phrase, sentence.scope)) for phrase in phrases), end


def pose(sentence: Sentence, at: int) -> Found | None:
    """Go to x = 1, y = 2; go to position -1.5 0.2."""
    text = sentence.text
    ends = [end for sense, end in verbs_at(text.words, at) if sense == "go"]
    if not ends:
        return None
    end = max(ends)
    values: list[float] = []
    start = end
    while len(values) < 2 and end < len(text):
        metres = measure(text.words, end)
        length = metres if metres is not None and metres.kind == "length" else None
        found = length or number(text.words, end)
        if found is None and text.word(end) not in _POSE:
            return None
        values += [found.value] if found else []
        end = found.end if found else end + 1
    said = _AT.intersection(text.words[start:end])
    if len(values) < 2 or not said or not ends_clause(text, end):
        return None
    return [GoTo(pose=Pose2(x_m=values[0], y_m=values[1]))], end
