"""A sentence again in plain words: "jar, off the bench, to Ada" is "bring jar from bench to Ada".

It is the law of faithfulness that says whether the plain words will do: a number, a colour, a
negation, a condition or a name that does not come back in them makes them no more than a guess.
"""

import re
from typing import NamedTuple

from intents.english.faithfulness import CARRYING
from intents.english.learnt.looks import Said
from intents.english.learnt.roles import Meant, Mention, Role, meant
from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.measures import NUMBER_WORDS, UNIT_WORDS
from intents.english.words.names import NameIndex
from intents.english.words.verbs import verbs_at

SURE = 0.65
"""From here on the plain words are taken for what was said, below it they are asked about."""
LIKELY = 0.5
"""What is less likely is not even asked."""
_BEFORE = (
    lexicon.DETERMINERS | frozenset(lexicon.COLORS) | frozenset(lexicon.SIZES) | NUMBER_WORDS
    | lexicon.words("all both every each other left right of last first second only")
)  # fmt: skip
"""What before a name belongs to it."""
_CONDITIONAL = lexicon.words(
    "if unless until till before after when whenever except but not no never don't dont without "
    "nor neither otherwise else should instead either or then"
)
_GRAVE = (
    (CARRYING - lexicon.EMPTY_ADJECTIVES) | UNIT_WORDS | _CONDITIONAL | lexicon.PERSON_NOUNS
    | frozenset(lexicon.GENDERS) | lexicon.ALL
    | lexicon.words(
        "under behind beside between above below near next opposite everyone everybody them him "
        "her each one ones two half dozen couple pair same tomorrow later many much twice thrice "
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
_INTO = lexicon.words("in into inside")
_ONTO = lexicon.words("on onto upon atop")


class Reworded(NamedTuple):
    """A sentence in plain words.

    Attributes:
        text: The plain words.
        sure: Whether they may be acted on; else they are asked about.
    """

    text: str
    sure: bool


def reworded(text: str, index: NameIndex) -> Reworded | None:
    """A sentence in plain words; None where there is nothing that can be said so."""
    found = meant(text, index)
    if found is None or found.sure < LIKELY:
        return None
    plain = _plain(text, found)
    if plain is None:
        return None
    left = _left(found)
    strange = [word for word in left if word not in found.speaking]
    if _CONDITIONAL.intersection(left) or any(map(_is_unheard_verb, strange)):
        return None
    known = all(word in _LIGHT or verbs_at([word], 0) for word in strange)
    grave = any(word in _GRAVE or _MANY.fullmatch(word) for word in left)
    doubtful = grave or not known or _forgotten(found)
    return Reworded(plain, found.sure >= SURE and not doubtful)


def _is_unheard_verb(word: str) -> bool:
    """Whether it may be an order to do what the robot has no word for: "paint", "wash"."""
    if word in _LIGHT or verbs_at([word], 0):
        return False
    return any(is_english(stem + "ing") for stem in (word, word.removesuffix("e"), word + word[-1]))


def _plain(text: str, found: Meant) -> str | None:
    """The order in words that the grammar knows."""

    def phrase(role: Role) -> str:
        mention = found.roles.get(role)
        if mention is None:
            return ""
        start, end = _span(found.words, mention)
        spoken = text[found.words[start].start : found.words[end - 1].end]
        before = found.words[start].raw
        spoken = before.lower() + spoken[len(before) :] if start < mention.start else spoken
        return spoken if mention.names else "me"

    what, who, source, to = (phrase(role) for role in ("what", "who", "from", "to"))
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
        case "switch_on" | "switch_off" if what:
            return f"{found.act.replace('_', ' ')} {what}"
        case "open" | "close" if what:
            return f"{found.act} {what}"
        case "greet" if who:
            return f"greet {who}"
        case _:
            return None


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


def _left(found: Meant) -> list[str]:
    """The words that do not come back."""
    spans = [_span(found.words, one) for one in found.roles.values()]
    taken = {n for start, end in spans for n in range(start, end)}
    taken |= {n - 1 for n, _ in spans if n and found.words[n - 1].raw.lower() in _POINTING}
    return [
        word.raw.lower().replace("’", "'")
        for n, word in enumerate(found.words)
        if n not in taken and not word.is_sign
    ]


def _forgotten(found: Meant) -> bool:
    """Whether a name was said that does not come back by another mention of the same."""
    known = frozenset[str]().union(*(one.names for one in found.roles.values()))
    return any(one.names and not one.names & known for one in found.idle)
