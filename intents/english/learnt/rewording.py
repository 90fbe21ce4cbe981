"""A sentence again in plain words: "jar, off the bench, to Ada" is "bring jar from bench to Ada".

It is the law of faithfulness that says whether the plain words will do: a number, a colour, a
negation, a condition or a name that does not come back in them makes them no more than a guess.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from intents.english.clauses.parentheses import COMMENTING
from intents.english.faithfulness import CARRYING
from intents.english.learnt.field import LEARNT, Fields, level
from intents.english.learnt.looks import Said
from intents.english.learnt.roles import Meant, Mention, Role, meant
from intents.english.learnt.trust import CERTAIN, NEVER, SURE
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
from intents.english.words.verbs import participle_base, verbs_at

_TALK = 0.95
"""From here on a word that would change what is asked is taken for background."""
_LEAST = 0.2
"""What is less likely is not even asked."""
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
_POLITELY = lexicon.words("don't couldn't can't won't wouldn't shouldn't")
"""These deny nothing where somebody is only polite: "couldn't you", "I don't suppose"."""
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
    "balance stand": "stand up", "wait": "wait", "turn_left": "turn left",
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
_ASKING = lexicon.words("how why what who when where is are was were did does has had am")
"""What a question begins with."""
_WHAT = lexicon.words("what what's whats how why who did does")
_LEADING = lexicon.words("to from on onto in into at by with for of")
"""What leads to a name."""
_LEAST_WITH = {"thing": CERTAIN}
"""How likely plain words have to be in spite of a harm; for all others they are asked about."""
_FEW = 3
"""So many words are looked back to, and may be lost of what is said in a word or two."""
_YOU = lexicon.words("you u ya ye you'd you'll yer")
_OTHERS = lexicon.words("i we he she they who which it someone somebody colleague son man lad")
_LINKS = lexicon.words("once until till")
_SUBJECTS = lexicon.words("i i'm he he's she she's they they're we we're the my his her it it's")
_BEING = lexicon.words("was were been")
_WILL = lexicon.words("will would who'd he'd she'd they'd which'd gonna to'")
_STATES = lexicon.words("belongs belonged owns")
_PAST = lexicon.words("took left put went had gave brought got came made kept lost drank ate saw")
_PRONOUNS = lexicon.words("it them that those this these")
_INTO = lexicon.words("in into inside")
_ONTO = lexicon.words("on onto upon atop")


class Reworded(NamedTuple):
    """A sentence in plain words.

    Attributes:
        text: The plain words.
        left: The words that do not come back in them, and what they are.
        least: How likely they have to be what was meant to be acted on [0..1]; above 1 if never.
        harms: What may be lost or amiss: "manner", "forgotten".
    """

    text: str
    left: tuple[str, ...]
    least: float
    harms: frozenset[str] = frozenset()


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
    if found is None or found.sure < _LEAST or _is_bare(found):
        return None
    plain = _plain(text, found, going_on=going_on)
    if plain is None:
        return None
    lost = _left(found)
    left = [word for _, word in lost]
    strange = [word for word in left if word not in found.speaking]
    likely = [float(p) for p in idle] or [0.0] * len(found.words)
    meant_ = [word for n, word in lost if likely[n] < _TALK]
    denied = any(word.endswith("n't") and word not in _POLITELY for word in meant_)
    if denied or _LIMITING.intersection(meant_) or CONDITIONS.intersection(left):
        return None
    asked = [n for n, word in lost if likely[n] < _TALK and word in strange]
    if any(_opens(found.words, n) and is_unheard_verb(found.words[n].raw.lower()) for n in asked):
        return None
    harms = _harms(found, left, meant_, asked)
    known = all(word in _LIGHT or verbs_at([word], 0) for word in strange)
    verb = any(map(is_unheard_verb, strange))
    told = (f"sure {level(found.sure)}", f"known {known}", f"verb {verb}")
    least = max((_LEAST_WITH.get(harm, NEVER) for harm in harms), default=SURE)
    return Reworded(plain, (*left, *told), least, harms)


def _harms(found: Meant, left: list[str], meant_: list[str], asked: list[int]) -> frozenset[str]:
    """What the words that do not come back may say, and what else may be amiss.

    Args:
        found: What is asked for.
        left: All words that do not come back.
        meant_: Those that are not talk.
        asked: Where those of them stand that do not speak for what is asked for.
    """
    words = found.words
    told = {
        "grave": any(word in _GRAVE or _MANY.fullmatch(word) for word in meant_),
        "forgotten": _forgotten(found),
        "manner": any(word.endswith("ly") and word not in COMMENTING | _LIGHT for word in left),
        "either": _is_either(found),
        "event": any(_is_event(words, n) for n, _ in _left(found)),
        "question": _is_question(found),
        "further": any(n > 0 and _opens(words, n) and _is_verb(words[n]) for n in asked)
        or any(_does_something(words, n) for n, _ in _left(found)),
        "told": _is_told(found),
        "dangling": words[-1].raw.lower() in _LEADING,
        "where": found.act in _ORDERS and "where" in left,
        "bare": found.act in _ORDERS and _is_much(found, left),
        "verb": _begins_otherwise(found, dict(_left(found))),
        "switch": found.act not in ("switch_on", "switch_off") and _switches(found),
    }
    strange = (_strangeness(words, n) for n in asked)
    return frozenset([*(harm for harm, is_so in told.items() if is_so), *filter(None, strange)])


def _is_event(words: list[Said], at: int) -> bool:
    """Whether it hangs on what happens: "once I am done", "until he comes"."""
    word, after = (words[n].raw.lower() if n < len(words) else "" for n in (at, at + 1))
    return word == "whenever" or (word in _LINKS and (after in _SUBJECTS or after in _YOU))


def _is_much(found: Meant, left: list[str]) -> bool:
    """Whether much more is said than what takes no thing: "wait, are you recording this"."""
    strange = set(left) - _LIGHT - found.speaking
    return len(strange) > (0 if found.act.startswith(("report", "wait")) else _FEW)


def _begins_otherwise(found: Meant, lost: dict[int, str]) -> bool:
    """Whether it begins with an order for something else: "bless this roll", "swap the cups"."""
    words = found.words
    first = next((n for n, word in enumerate(words) if word.raw.lower() not in _OPENING), 0)
    verb = lost.get(first, "")
    if not verb or verb in _LIGHT or verb in found.speaking or first + 1 >= len(words):
        return False
    onto = words[first + 1].raw.lower() in lexicon.DETERMINERS | _PRONOUNS
    return onto and (is_unheard_verb(verb) or bool(verbs_at([verb], 0)))


def _is_told(found: Meant) -> bool:
    """Whether it is told what somebody does, did or is to do: "he will bring it", "I took it"."""
    words = [word.raw.lower().replace("’", "'") for word in found.words]
    for n, word in enumerate(words[1:], 1):
        others = set(words[max(0, n - _FEW) : n])
        subject = not others.isdisjoint(_OTHERS) or any(one.endswith("'d") for one in others)
        if others & _YOU:
            continue
        past = word in _PAST or word.endswith("ed") or participle_base(word) not in (None, word)
        if past and not others.isdisjoint(_OTHERS | _BEING):
            return True
        if word in _STATES or (verbs_at([word], 0) and words[n - 1] in _WILL and subject):
            return True
    return False


def _switches(found: Meant) -> bool:
    """Whether something is to be on or off: "the lamp off please", not "off the shelf"."""
    names = {one.start for one in (*found.roles.values(), *found.also, *found.idle)}
    leads = lexicon.DETERMINERS | _LEADING | _PRONOUNS
    words = found.words
    return any(
        word.raw.lower() in ("on", "off")
        and n + 1 not in names
        and (n + 1 == len(words) or words[n + 1].raw.lower() not in leads)
        and n - 1 in {one.end - 1 for one in (*found.roles.values(), *found.also, *found.idle)}
        for n, word in enumerate(words)
    )


def _is_bare(found: Meant) -> bool:
    """Whether nothing is said but one name: that answers a question."""
    named = {n for one in (*found.roles.values(), *found.idle) for n in range(one.start, one.end)}
    others = (w.raw.lower() for n, w in enumerate(found.words) if n not in named and not w.is_sign)
    return len(found.roles) + len(found.idle) < 2 and lexicon.FUNCTION_WORDS.issuperset(others)


def _is_question(found: Meant) -> bool:
    """Whether it is a question, and what is read no answer to one."""
    first, then = ([word.raw.lower() for word in found.words] + [""])[:2]
    answers = found.act.startswith(("count", "tell", "report"))
    seeks = found.act == "find" and first not in _WHAT
    return first in _ASKING and then != "about" and not answers and not seeks


def _is_either(found: Meant) -> bool:
    """Whether it is not said which of two places it is at and to which it is to come."""
    if not {"from", "to"} <= found.roles.keys() or not found.roles["to"].names:
        return False
    start, _ = _span(found.words, found.roles["to"])
    return start > 0 and found.words[start - 1].is_sign


def _opens(words: list[Said], at: int) -> bool:
    """Whether an order may begin at a word."""
    return at == 0 or words[at - 1].is_sign or words[at - 1].raw.lower() in _OPENING


def _does_something(words: list[Said], at: int) -> bool:
    """Whether something unheard of is to be done: "whittle a spoon"."""
    onto = at + 1 < len(words) and words[at + 1].raw.lower() in lexicon.DETERMINERS
    return at > 0 and onto and _opens(words, at) and is_unheard_verb(words[at].raw.lower())


def _is_verb(word: Said) -> bool:
    """Whether it may be an order of its own."""
    said = word.raw.lower()
    return said not in _LIGHT and bool(verbs_at([said], 0))


def _strangeness(words: list[Said], at: int) -> str:
    """What a word that nothing is made of may be: a manner, a name, a thing unknown; or empty."""
    word, before = words[at].raw, words[at - 1].raw.lower() if at else ""
    begins = at == 0 or words[at - 1].is_sign
    ends = at + 1 == len(words) or words[at + 1].is_sign
    apart = at < 2 or words[at - 2].is_sign or words[at - 2].raw.lower() == "and"
    if (before == "and" and ends) or (before in lexicon.DETERMINERS and at > 1 and apart):
        return "one more"
    if word.lower() in _LIGHT or verbs_at([word.lower()], 0):
        return ""
    if (begins or before == "and") and ends and (at > 0 or is_english(word.lower())):
        return "alone"
    if word[0].isupper() and not word.isupper() and not begins:
        return "name"
    return "thing" if before in lexicon.DETERMINERS or before in _LEADING else ""


def is_unheard_verb(word: str) -> bool:
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
            return f"guide {who}{out} to {to}" if who else None
        case "follow":
            return f"follow {who}{f' to {to}' if to else ''}" if who else None
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
