"""A sentence again in plain words: "jar, off the bench, to Ada" is "bring jar from bench to Ada".

It is the law of faithfulness that says whether the plain words will do: a number, a colour, a
negation, a condition or a name that does not come back in them makes them no more than a guess.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from intents.english.faithfulness import CARRYING
from intents.english.learnt.field import LEARNT, Fields, level
from intents.english.learnt.looks import Said
from intents.english.learnt.roles import Meant, Mention, Role, meant
from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.limits import (
    CHOICES,
    CONDITIONS,
    DENIALS,
    MEASURES,
    QUANTITIES,
    SPOTS,
    TIMES,
)  # fmt: skip
from intents.english.words.measures import NUMBER_WORDS, measure
from intents.english.words.names import NameIndex
from intents.english.words.verbs import verbs_at

_TALK = 0.95
"""From here on a word that would change what is asked is taken for background."""
_BEFORE = (
    lexicon.DETERMINERS | frozenset(lexicon.COLORS) | frozenset(lexicon.SIZES) | NUMBER_WORDS
    | lexicon.words("all both every each other left right of last first second only")
)  # fmt: skip
"""What before a name belongs to it."""
_LIMITING = CONDITIONS | TIMES | DENIALS | CHOICES
"""What makes of an order another one: then there are no plain words for it."""
_GRAVE = (
    (CARRYING - lexicon.EMPTY_ADJECTIVES) | QUANTITIES | MEASURES | SPOTS | lexicon.PERSON_NOUNS
    | frozenset(lexicon.GENDERS)
    | lexicon.words(
        "everyone everybody them him her one ones same "
        "fella geezer guy dude fellow chap student visitor guest patient client customer colleague"
    )
) - lexicon.words("wee little small big old young new")  # fmt: skip
"""What has to come back in the plain words, or they are doubtful."""
_LIGHT = lexicon.FUNCTION_WORDS | lexicon.words(
    "please pls plz thanks thank cheers ta kindly now just right ok okay hey oi well good there "
    "here back away over out up down off on go get got need needs want wants could would should "
    "quick robot mate pal love dear sir madam buddy"
)
"""Words that say nothing of what is to be done with a thing."""
_POINTING = lexicon.words("them thae her me us these those")
"""Right before a name these say no more than "the"."""
_MANY = re.compile(r"x?\d.*")
_ORDERS = {
    "gesture wave": "wave", "gesture bow": "bow", "gesture nod": "nod",
    "gesture thumbs_up": "give a thumbs up", "gesture shake_head": "shake your head",
    "gesture point": "point", "report holding": "what are you holding?",
    "report location": "where are you?", "report health": "is your battery low?",
    "report seeing": "what do you see?", "report status": "report your status",
    "report why": "why did you stop?", "balance one_leg": "stand on one leg",
    "balance squat": "squat", "balance sit": "sit down", "balance lean": "lean forward",
    "balance stand": "stand up", "wait": "wait", "stop": "stop", "pause": "pause",
    "resume": "carry on", "cancel": "never mind", "turn_left": "turn left",
    "turn_right": "turn right", "forward": "walk forward", "back": "walk back",
    "left": "walk left", "right": "walk right",
}  # fmt: skip
"""What takes no thing, in plain words."""
_OF_ONE: dict[str, tuple[Role, ...]] = {
    "switch_on": ("what",), "switch_off": ("what",), "open": ("what",), "close": ("what",),
    "greet": ("who",), "meet": ("who",), "look_at": ("what", "to"),
}  # fmt: skip
"""What takes one name, and as what."""
_MEASURED = (
    ("turn", "angle"), ("forward", "length"), ("back", "length"), ("left", "length"),
    ("right", "length"), ("wait", "time"), ("balance", "time"),
)  # fmt: skip
"""In what an act is measured."""
_OPENING = lexicon.words("and then please just go now to")
"""What stands before an order."""
_LEADING = lexicon.words("to from on onto in into at by with for of")
"""What leads to a name."""
_PRONOUNS = lexicon.words("it them that those this these")
_INTO = lexicon.words("in into inside")
_ONTO = lexicon.words("on onto upon atop")


class Reworded(NamedTuple):
    """A sentence in plain words.

    Attributes:
        text: The plain words.
        left: The words that do not come back in them, and what they are.
        whole: Whether nothing that may change what is asked is lost; else they are asked about.
    """

    text: str
    left: tuple[str, ...]
    whole: bool


def reworded(
    text: str,
    index: NameIndex,
    idle: Sequence[float] = (),
    *,
    going_on: bool = False,
    fields: Fields = LEARNT,
) -> Reworded | None:
    """A sentence in plain words; None where there is nothing that can be said so.

    Args:
        text: A sentence.
        index: The names of its world.
        idle: How likely each of its words is background [0..1]; by default none is.
        going_on: Whether "it" is what was spoken of before.
        fields: What was learnt; by default what comes with the package.
    """
    found = meant(text, index, fields)
    plain = _plain(text, found, going_on=going_on) if found else None
    if found is None or plain is None:
        return None
    lost = _left(found)
    left = [word for _, word in lost]
    strange = [word for word in left if word not in found.speaking]
    likely = [float(p) for p in idle] or [0.0] * len(found.words)
    meant_ = [word for n, word in lost if likely[n] < _TALK]
    if _LIMITING.intersection(meant_):
        return None
    known = all(word in _LIGHT or verbs_at([word], 0) for word in strange)
    grave = any(word in _GRAVE or _MANY.fullmatch(word) for word in meant_)
    forgotten = _forgotten(found)
    verb = any(map(_is_unheard_verb, strange))
    asked = [n for n, word in lost if likely[n] < _TALK and word in strange]
    if any(_opens(found.words, n) and _is_unheard_verb(found.words[n].raw.lower()) for n in asked):
        return None
    strangers = any(_is_named(found.words, n) for n in asked)
    told = (f"sure {level(found.sure)}", f"known {known}", f"verb {verb}", f"grave {grave}")
    return Reworded(plain, (*left, *told), not (grave or forgotten or strangers))


def _opens(words: list[Said], at: int) -> bool:
    """Whether an order may begin at a word."""
    return at == 0 or words[at - 1].is_sign or words[at - 1].raw.lower() in _OPENING


def _is_named(words: list[Said], at: int) -> bool:
    """Whether a word may be a manner, or the name of what nobody knows."""
    word, before = words[at].raw, words[at - 1].raw.lower() if at else ""
    if word.lower() in _LIGHT or verbs_at([word.lower()], 0):
        return False
    if word.endswith("ly"):
        return True  # a manner
    capital = word[0].isupper() and not word.isupper() and at > 0 and not words[at - 1].is_sign
    return capital or before in lexicon.DETERMINERS or before in _LEADING


def _is_unheard_verb(word: str) -> bool:
    """Whether it may be an order to do what the robot has no word for: "paint", "wash"."""
    if word in _LIGHT or verbs_at([word], 0):
        return False
    return any(is_english(stem + "ing") for stem in (word, word.removesuffix("e"), word + word[-1]))


def _plain(text: str, found: Meant, *, going_on: bool) -> str | None:
    """The order in words that the grammar knows."""

    def phrase(role: Role) -> str:
        mention = found.roles.get(role)
        return spoken_of(mention) if mention else ""

    def spoken_of(mention: Mention) -> str:
        start, end = _span(found.words, mention)
        spoken = text[found.words[start].start : found.words[end - 1].end]
        before = found.words[start].raw
        spoken = before.lower() + spoken[len(before) :] if start < mention.start else spoken
        return spoken if mention.names else "me"

    what, who, source, to = (phrase(role) for role in ("what", "who", "from", "to"))
    what = " and ".join([what, *map(spoken_of, found.also)]) if what else _pronoun(found, going_on)
    out, at = (f" {link} {source}" if source else "" for link in ("from", "at"))
    match found.act:
        case "bring" if what:
            return f"bring {what}{out} to {to or 'me'}"
        case "place" if what and to and to != "me":
            return f"{_put(found, what, out)} {to}"
        case "pick" if what:
            return f"pick up {what}{out}"
        case "go_to" if to:
            return "come here" if to == "me" else f"go to {to}"
        case "find" | "count" if what or who:
            return f"{found.act} {what or who}{at}"
        case "guide" if to and to != "me":
            return f"guide {who or 'me'}{out} to {to}"
        case "follow":
            return f"follow {who or 'me'}{f' to {to}' if to else ''}"
        case act if act in _OF_ONE:
            told = [one for one in map(phrase, _OF_ONE[act]) if one]
            return f"{act.replace('_', ' ')} {told[0]}" if told else None
        case "tell name" if source:
            return f"what is on {source}?"
        case "gesture thumbs_up" if who:
            return f"give {who} a thumbs up"
        case _:
            return _bare(found, who)


def _pronoun(found: Meant, going_on: bool) -> str:
    """What stands for a thing that was spoken of before."""
    words = (word.raw.lower() for word in found.words)
    return next((word for word in words if word in _PRONOUNS), "") if going_on else ""


def _bare(found: Meant, who: str) -> str | None:
    """An order that takes no thing: "nod at Ada", "turn left ninety degrees"."""
    order = _ORDERS.get(found.act)
    if order is None:
        return None
    if found.act.startswith("gesture"):
        return f"{order} {'to' if order in ('wave', 'bow') else 'at'} {who}" if who else order
    amount = _amount(found)
    spoken = " ".join(word.raw for word in found.words[slice(*amount)])
    link = "for " if found.act.startswith(("wait", "balance")) and spoken else ""
    return f"{order} {link}{spoken}".strip()


def _amount(found: Meant) -> tuple[int, int]:
    """From which word to which how far or how long is said; nowhere if it is not."""
    kind = next((kind for start, kind in _MEASURED if found.act.startswith(start)), None)
    plain = [word.raw.lower() for word in found.words]
    for at in range(len(plain)):
        amount = measure(plain, at) if kind else None
        if amount and amount.kind == kind:
            return at, amount.end
    return 0, 0


def _put(found: Meant, what: str, out: str) -> str:
    """Putting something on or into, as it was said; else taking it somewhere."""
    start, _ = _span(found.words, found.roles["to"])
    link = found.words[start - 1].raw.lower() if start else ""
    if link in _INTO or link in _ONTO:
        return f"put {what}{out} {'into' if link in _INTO else 'on'}"
    return f"take {what}{out} to"


def _span(words: list[Said], mention: Mention) -> tuple[int, int]:
    """A name with what stands before it and belongs to it."""
    start = mention.start
    while mention.names and start and _belongs(words[start - 1]):
        start -= 1
        if words[start].raw.lower() in lexicon.DETERMINERS:
            break
    return start, mention.end


def _belongs(word: Said) -> bool:
    return word.raw.lower() in _BEFORE or word.raw.isdigit()


def _left(found: Meant) -> list[tuple[int, str]]:
    """The words that do not come back, and where they stand."""
    spans = [_span(found.words, one) for one in (*found.roles.values(), *found.also)]
    taken = {n for start, end in spans for n in range(start, end)}
    taken |= set(range(*_amount(found)))
    taken |= {n - 1 for n, _ in spans if n and found.words[n - 1].raw.lower() in _POINTING}
    return [
        (n, word.raw.lower().replace("’", "'"))
        for n, word in enumerate(found.words)
        if n not in taken and not word.is_sign
    ]


def _forgotten(found: Meant) -> bool:
    """Whether a name was said that does not come back by another mention of the same."""
    known = frozenset[str]().union(*(one.names for one in (*found.roles.values(), *found.also)))
    return any(one.names and not one.names & known for one in found.idle)
