"""What stands before a clause and asks for nothing: "and then", "could you", "step 1:"."""

from intents.english.clauses.announcements import announced_end
from intents.english.clauses.self_talk import about_robot
from intents.english.phrases.complements import connector_end
from intents.english.phrases.phrase import is_content
from intents.english.words import lexicon
from intents.english.words.disfluency import is_side
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at

_SEEN = lexicon.words(
    "a an any the my some anyone anybody someone somebody anything it them him her"
)
_IF_NOT = lexicon.phrases(
    "if no,if it is not,if they are not,if there is not,if there are not,if there is none,"
    "if there are none,if there is not one,if there is not any,if it is not there,"
    "if they are not there,if you do not,if you can not,if he is not,if she is not,"
    "if is not,if is not there,if not there,"
    "if he is not there,if she is not there,if nobody is,if nobody is there,if no one is there"
)
"""These are "otherwise" only where nothing follows: "if it is not on the table" is another."""
_NUMERALS = lexicon.words("one two three four five")
_NOTHING = lexicon.phrases(
    "nothing,do nothing,just do nothing,do not do anything,do not bother,do not,leave it,"
    "leave it be,leave them,never mind,forget it,forget about it,leave it there,"
    "leave it where it is,leave everything as it is,let it be,nothing at all,"
    "do nothing at all,do not worry,do not worry about it,do not worry about that,"
    "leave it as it is,"
    "leave it alone,do not bother with it,do not bother about it,ignore it,skip it,that is fine,"
    "it is fine,no worries,no matter,no harm done,never mind it,stay where you are,all is well"
)
_NEED_NOT = ["you", "need", "not"]
_URGING = lexicon.words("do only simply merely")
_OPENING = lexicon.OPENERS | lexicon.LIGHT_VERBS | lexicon.PATROLS


_OBLIGED = lexicon.words(
    "want need have got must should would like wish love am hoping hope trying going supposed "
    "really just ought badly urgently shall"
)
_GOING = lexicon.phrases(
    "go,get,be taken,be brought,be led,be shown,be guided,find my way,find the way,get back,"
    "go back,return,find our way,make my way,be escorted,be accompanied"
)
"""How one says that one is on one's way somewhere."""
_OFF = lexicon.words("go come run hurry nip pop dash hop trot zip")
"""How one sets out to do something."""


def skip_openings(text: Text, at: int) -> int:
    """Past connectors, signs and openings like "could you"."""
    while at < len(text):
        if text.word(at) in (COMMA, FULL_STOP) or _sets_out(text, at):
            at += 1
            continue
        numbered = _numbering_end(text, at)
        if numbered:
            at = numbered
            continue
        if text.word(at) == "be" and text.words[at + 3 : at + 4] == ["and"]:
            at += 4  # be so kind and ...
            continue
        end = announced_end(text, at) or _opening_end(text, at) or _urging_end(text, at)
        if end is None:
            return at
        at = end
    return at


def _urging_end(text: Text, at: int) -> int | None:
    """*Do* bring it; *only* tell me; *simply* leave it there."""
    bare = bool(verbs_at(text.words, at + 1)) and base_form(text.word(at + 1)) == text.word(at + 1)
    urges = text.word(at) in _URGING and bare and not text.name_at(at + 1)
    return at + 1 if urges else None


def otherwise_end(text: Text, at: int) -> int | None:
    """Where "otherwise", "if not" or "if it is not," ends, if it begins at a word."""
    asked = text.phrase_end(_IF_NOT, at)
    if asked and (text.word(asked) in (COMMA, "then") or nothing_end(text, asked)):
        return asked
    return text.phrase_end(lexicon.ELSE, at)


def other_case(text: Text, at: int) -> int | None:
    """Where "if" stands that begins another case: "..., *and if* it is off, ..."."""
    start = at
    while text.word(start) in (COMMA, FULL_STOP, "and", "but") and start < len(text):
        start += 1
    begins = text.word(start) in ("if", "should") and text.word(start + 1) != "you"
    signed = begins and COMMA in text.words[start:] and start > at
    return start if signed else None


def nothing_end(text: Text, at: int) -> int | None:
    """Where "nothing" ends that is to be done otherwise, if no more is said."""
    end = text.phrase_end(_NOTHING, skip_openings(text, at))
    return end if end and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)) else None


def _opening_end(text: Text, at: int) -> int | None:
    """Where "could you" or "and then" ends, if it is no part of what is asked for."""
    if text.words[at + 1 : at + 3] == ["you", "see"] and _is_seen(text, at + 3):
        return None
    if goes_oneself_end(text, at) or sits_oneself_end(text, at) or purpose_end(text, at):
        return None  # I want to go to the lab: to be taken there
    verb = verbs_at(text.words, at)
    end = max(connector_end(text, at) or 0, text.phrase_end(lexicon.OPENERS, at) or 0)
    if not end or about_robot(text, at) or (verb and verb[0][1] > end):
        return None
    if text.word(at) == "right" and is_side(text.words, at):
        return None
    opens_verb = verbs_at(text.words, end) or text.phrase_end(_OPENING, end)
    opens_verb = opens_verb or text.word(end) in (COMMA, FULL_STOP, "be")
    if text.word(at) == "mind" and not verbs_at(text.words, end):
        return None  # mind the step
    if text.words[at : at + 2] == ["no", "need"] or text.words[at : at + 3] == _NEED_NOT:
        return None  # no need to come; you need not come
    bidden = verbs_at(text.words, end) and not text.word(end).endswith("ing")
    if text.words[at:end] == ["no"] and is_content(text, end) and not bidden:
        return None  # no milk for Emil; no running in the hall
    if text.words[at:end] == ["do"] and not (verbs_at(text.words, end) or text.word(end) == "be"):
        return None  # do fetch it; but: do three squats
    open_ended = text.word(end - 1) in ("to", "there", "you", "next", "and", "me")
    if open_ended and not connector_end(text, at) and not opens_verb:
        return None
    named = text.name_at(at)
    if otherwise_end(text, at) or (named and named.end >= end):
        return None
    return end


def goes_oneself_end(text: Text, at: int) -> int | None:
    """Where "I would like to go" ends: who says it is to get somewhere, and not the robot."""
    if text.word(at) not in ("i", "we") or text.word(at + 1) not in _OBLIGED:
        return None
    end = at + 1
    while text.word(end) in _OBLIGED | {"to"}:
        end += 1
    going = text.phrase_end(_GOING, end)
    return going if going and not text.name_at(end) else None


_BODILY = lexicon.words("sit lie stand kneel squat nap sleep rest wave bow nod dance")
_SELF = lexicon.words("down up a bit while moment there here now myself for little too please")


def sits_oneself_end(text: Text, at: int) -> int | None:
    """Where "I want to sit down" ends: that is what who speaks wants to do."""
    if text.word(at) not in ("i", "we") or text.word(at + 1) not in _OBLIGED:
        return None
    end = at + 1
    while text.word(end) in _OBLIGED | {"to"}:
        end += 1
    if text.word(end - 1) != "to" or text.word(end) not in _BODILY:
        return None
    end += 1
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP, "so", "but"):
        if text.word(end) not in _SELF and not text.lookup(lexicon.LOCATIVES, end - 1):
            return None
        end += 1
    return end


_PURPOSES = lexicon.phrases("to,in order to,so as to")


def purpose_end(text: Text, at: int) -> int | None:
    """Where "to make the bed, ..." ends: what an order is good for, and no order by itself."""
    start = text.phrase_end(_PURPOSES, at)
    first = at == 0 or text.word(at - 1) == FULL_STOP
    if start is None or not first or not verbs_at(text.words, start):
        return None
    end = start
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        end += 1
    after = end + 1 + (text.word(end + 1) == "please")
    ordered = text.word(end) == COMMA and verbs_at(text.words, after)
    return end if ordered and base_form(text.word(after)) == text.word(after) else None


def _is_seen(text: Text, at: int) -> bool:
    """Whether "can you see ..." asks after something, and not for it to be seen to the door."""
    named = text.name_at(at)
    if named is None:
        return text.word(at) in _SEEN
    along = text.word(named.end) in ("along", "over", "through", "back", "off", "out", "home")
    return text.word(named.end + along) not in ("to", "into")


def _numbering_end(text: Text, at: int) -> int | None:
    """*Step 1:* go to the table. *2.* Take the cup."""
    numeral = at + (text.word(at) in ("step", "number", "task"))
    end = numeral + 1
    numbered = text.word(numeral).isdecimal() or text.word(numeral) in _NUMERALS
    numbered = numbered and text.word(end) in (COMMA, FULL_STOP)
    return end + 1 if numbered and end < len(text) else None


def _sets_out(text: Text, at: int) -> bool:
    """Go *get the cup*: the walk goes without saying."""
    if text.word(at) in ("start", "begin", "keep") and text.word(at + 1).endswith("ing"):
        longest = max((end for _, end in verbs_at(text.words, at)), default=at + 1)
        return bool(verbs_at(text.words, at + 1)) and longest == at + 1
    if text.word(at) not in _OFF:
        return False
    after = connector_end(text, at + 1) or at + 1
    inner = max((end for _, end in verbs_at(text.words, after)), default=after)
    verbs = verbs_at(text.words, at)
    whole = bool(verbs) and at + 1 < verbs[0][1] >= inner
    goes_somewhere = text.lookup(lexicon.LOCATIVES, at + 1) or text.word(after) == "go"
    return not whole and not goes_somewhere and bool(verbs_at(text.words, after))


def begins_clause(text: Text, at: int) -> bool:
    """Whether "you go" or "going" begins at a word."""
    return text.word(at) in ("you", "that") or text.word(at).endswith("ing")
