"""A question with its order is a condition: "no eggs in the fridge? tell Leo" is "if there are no".

So is "see whether the gate is open, and if it is, close it", of what can be open, on or full.

Nobody waits for the answer: who asks whether something is so and says at once what to do then
says it for that case only. A question with a verb of its own ("is there an egg? tell me") or with a
question word is one.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import AUXILIARIES, DETERMINERS, LOCATIVES, WH, words
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_NOBODY = words("nobody noone somebody someone anybody anyone")
_NONE = words("no any some")
_OPENS = words("so then please and just")
_LONGEST = 12
_REST = words("left remaining there around")


_CHECKS = words("see check look find")
_STATES = words("open closed shut on off empty full running locked")
_SO = words("so it they that is are the case then yes")


def checked_states(tokens: list[Token]) -> list[Token]:
    """See whether the gate is open, and if so, close it: *if the gate is open*, close it."""
    said = [token.text for token in tokens]
    at = next((n for n, word in enumerate(said[:-6]) if word in _CHECKS), None)
    begun = None if at is None else _asked_begin(said, at)
    again = [n for n, word in enumerate(said) if word == "if" and begun and n > begun + 2]
    if at is None or begun is None or not again:
        return tokens
    close = again[0]
    while said[close - 1] in {"and", COMMA, FULL_STOP}:
        close -= 1
    taken_up = again[0] + 1
    while taken_up < len(said) and said[taken_up] in _SO:
        taken_up += 1
    state = said[close - 1]
    taken_up += said[taken_up : taken_up + 1] == [state]
    alone = {"and", COMMA, FULL_STOP, "if"}.isdisjoint(said[begun:close])
    order = taken_up + (said[taken_up : taken_up + 1] == [COMMA])
    ordered = order < len(said) and said[order] in FIRST_WORDS
    if state not in _STATES or not alone or taken_up == again[0] + 1 or not ordered:
        return tokens
    link = Token(COMMA, ",")
    return [*tokens[:at], Token("if", ""), *tokens[begun:close], link, *tokens[order:]]


def _asked_begin(said: list[str], at: int) -> int | None:
    """Where begins what is to be seen: see *whether*, find out *if*."""
    start = at + 1 + (said[at + 1] == "out")
    return start + 1 if said[start] in ("if", "whether") else None


def conditional_questions(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with "if there is ..., ..." for a question without a verb and its order."""
    said = [token.text for token in tokens]
    close = said.index(FULL_STOP) if FULL_STOP in said else len(said)
    if not 1 < close < min(_LONGEST, len(said) - 1) or "?" not in tokens[close].raw:
        return tokens
    order = close + 1
    while order < len(said) and said[order] in _OPENS:
        order += 1
    asked = said[:close]
    if order >= len(said) or said[order] not in FIRST_WORDS or not _is_bare(asked):
        return tokens
    link = Token(",", tokens[close].raw)
    subject = _subject_end(asked, index)
    if subject:
        front, verb = [Token("if", ""), *tokens[:subject]], Token("is", "")
        return [*front, verb, *tokens[subject:close], link, *tokens[order:]]
    opening = _opening(asked, index)
    if not opening:
        return tokens
    plain = [Token(word, "") for word in opening]
    skipped = 1 if asked[0] == "any" else 0
    return [*plain, *tokens[skipped:close], link, *tokens[order:]]


def _is_bare(asked: list[str]) -> bool:
    """Whether nothing is said but what there is and where: no verb, no question word."""
    verbs = AUXILIARIES | WH | {"you", "i", "we", "and", "or"}
    return verbs.isdisjoint(asked) and asked[0] not in FIRST_WORDS


def _opening(asked: list[str], index: NameIndex) -> list[str]:
    """What goes before the words asked to make them a condition; empty if they cannot be one."""
    where = any(_is_where(asked, n) for n in range(1, len(asked)))
    at = 1 if asked[0] in _NONE or asked[0] in DETERMINERS else 0
    begins = next((n for n in range(at, min(len(asked), at + 3)) if index.match(asked, n)), None)
    match = index.match(asked, begins) if begins is not None else None
    if match is None:
        return []
    gone = asked[0] == "no" and (where or asked[-1] in _REST)
    if not match.of("object", "category") or not (where or gone):
        return []
    return ["if", "there", "is", "a"] if asked[0] == "any" or not at else ["if", "there", "is"]


def _is_where(asked: list[str], at: int) -> bool:
    return any(tuple(asked[at : at + size]) in LOCATIVES for size in (1, 2, 3))


def _subject_end(asked: list[str], index: NameIndex) -> int:
    """Where somebody ends of whom it is asked whether they are there; 0 if it is of nobody."""
    match = index.match(asked, 0)
    end = match.end if match is not None and match.of("person") else int(asked[0] in _NOBODY)
    return end if end and end < len(asked) and _is_where(asked, end) else 0
