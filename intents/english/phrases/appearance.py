"""What people are known by: postures, gestures, clothes."""

from typing import Literal

from intents.english.phrases.phrase import NounPhrase
from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.english.words.lexicon import COLORS, DETERMINERS, POSTURES
from intents.english.words.text import Text
from intents.goals import Clothing

_POINTED_AT = lexicon.phrases(
    "i am pointing at,i am pointing to,i point at,i point to,that i am pointing at,"
    "that i am pointing to,that i point at,that i point to,whom i am pointing at,"
    "who i am pointing at,who i am pointing to,whom i point at"
)


_ON_THE_FLOOR: dict[lexicon.Phrase, Literal["lying"]] = dict.fromkeys(
    lexicon.phrases("on the floor,on the ground,on the carpet"), "lying"
)


def read_appearance(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Postures, gestures and clothes."""
    posture = text.lookup(POSTURES, at) or text.lookup(_ON_THE_FLOOR, at)
    if posture:
        phrase.posture = phrase.posture or posture[0]
        return posture[1]
    pointed_at = text.phrase_end(_POINTED_AT, at)
    if pointed_at:
        phrase.gesture = "pointed at"
        return pointed_at
    gesture = _gesture(text, at)
    if gesture:
        phrase.gesture, end = gesture
        return end
    clothing = _clothing(text, at)
    if clothing:
        phrase.wearing, end = clothing
        return end
    return None


def _gesture(text: Text, at: int) -> tuple[str, int] | None:
    """Waving; raising their left arm; pointing to the right; with the left hand up."""
    word, end = text.word(at), at + 1
    if word in ("waving", "waves", "wave"):
        return "waving", _past_limb(text, end)
    if word in ("pointing", "points", "point"):
        end += text.word(end) in ("to", "at", "towards", "toward")
        end += text.word(end) in DETERMINERS
        side = text.word(end)
        if side not in ("left", "right"):
            return None
        return f"pointing {side}", end + 1 + (text.word(end + 1) in ("side", "direction"))
    raising = word in ("raising", "raises", "raised", "lifting", "raise", "lifts")
    if word in DETERMINERS:
        end = at
    elif not raising and word not in ("with", "has", "having", "holding", "whose"):
        return None
    end += text.word(end) == "up"
    end += text.word(end) in DETERMINERS
    if text.word(end) == "raised":
        raising, end = True, end + 1
    side = text.word(end) if text.word(end) in ("left", "right") else ""
    if text.word(end + bool(side)) not in ("arm", "hand", "arms", "hands"):
        return None
    after = _past_limb(text, end)
    up = {("raised",): 0, ("up",): 0, ("in", "the", "air"): 0, ("lifted",): 0, ("up", "high"): 0}
    lifted = text.lookup(up, after + (text.word(after) == "is"))
    if not raising and not lifted:
        return None
    return " ".join(f"raising {side} arm".split()), lifted[1] if lifted else after


def _past_limb(text: Text, at: int) -> int:
    """Skip "their left hand", "at you"."""
    end = at + (text.word(at) in DETERMINERS)
    end += text.word(end) in ("left", "right")
    if text.word(end) in ("hand", "arm", "hands", "arms"):
        return end + 1
    if text.word(at) in ("at", "to") and text.word(at + 1) in ("you", "me", "us"):
        return at + 2
    return at


def _clothing(text: Text, at: int) -> tuple[Clothing, int] | None:
    """Wearing a red shirt; in blue; with the black jacket."""
    word, end = text.word(at), at + 1
    if word == "dressed":
        end += text.word(end) in ("in", "with")
    elif word == "has" and text.word(end) == "on":
        end += 1
    elif word not in ("wearing", "wears", "wear", "in", "with"):
        return None
    firm = word in ("wearing", "wears", "wear", "dressed")
    end += text.word(end) in DETERMINERS
    named = text.name_at(end)
    if word == "in" and named and named.of("room", "place"):
        return None  # who is in the boot room, or the blue room, wears nothing of that name
    color = COLORS.get(text.word(end))
    end += color is not None
    end += text.word(end) in ("colored", "coloured")
    item = singular(text.word(end))
    if item == "t" and text.word(end + 1) in ("shirt", "shirts"):
        return Clothing(color=color, item="t shirt"), end + 2
    if item in lexicon.CLOTHES:
        return Clothing(color=color, item=item), end + 1
    if firm and text.word(end)[0].isalpha() and text.word(end) not in lexicon.FUNCTION_WORDS:
        return Clothing(color=color, item=item), end + 1
    return (Clothing(color=color), end) if color else None
