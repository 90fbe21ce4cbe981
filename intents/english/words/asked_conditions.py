"""A question with its order is a condition: "no eggs in the fridge? tell Leo" is "if there are no".

So is "see whether the gate is open, and if it is, close it", of what can be open, on or full.

Nobody waits for the answer: who asks whether something is so and says at once what to do then
says it for that case only. A question with a verb of its own ("is there an egg? tell me") or with a
question word is one.
"""

from typing import NamedTuple

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
_NOT_SO = words("not no")
_FEWEST = 4
"""So many words a question has at least: "is the gate open?"."""


def checked_states(tokens: list[Token]) -> list[Token]:
    """See whether the gate is open, and if so, close it: *if the gate is open*, close it.

    Also "is it shut? If not, shut it": *if it is not shut*, shut it.
    """
    said = [token.text for token in tokens]
    asked = _asked_state(tokens, said)
    again = [n for n, word in enumerate(said) if word == "if" and asked and n > asked.begun + 1]
    if asked is None or not again:
        return tokens
    signs = {"and", COMMA, FULL_STOP}
    close = next(n for n in range(asked.begun + 1, again[0] + 1) if said[n] in signs | {"if"})
    state = said[close - 1]
    taken_up = again[0] + 1
    while taken_up < len(said) and said[taken_up] in _SO | _NOT_SO:
        taken_up += 1
    after = said[taken_up + 1 : taken_up + 2]
    again_said = said[taken_up : taken_up + 1] == [state]
    taken_up += again_said and (not after or after[0] == COMMA or after[0] in FIRST_WORDS)
    begin = close
    while said[begin] in signs or (said[begin] in _OPENS and begin < again[0]):
        begin += 1
    order = [*tokens[begin : again[0]]] or tokens[taken_up + (said[taken_up:][:1] == [COMMA]) :]
    ends = begin == again[0] or not (set(said[taken_up:]) - signs)
    ordered = bool(order) and order[0].text in FIRST_WORDS
    if state not in _STATES or taken_up == again[0] + 1 or not (ends and ordered):
        return tokens
    negated = not _NOT_SO.isdisjoint(said[again[0] : taken_up])
    link = [Token("not", ""), tokens[close - 1], Token(COMMA, ",")]
    subject = [*asked.subject, *tokens[asked.begun : close - 1]]
    return [*tokens[: asked.at], Token("if", ""), *subject, *link[not negated :], *order]


class _Asked(NamedTuple):
    """What is asked: from ``at`` on, its words from ``begun`` on, with "is" where it belongs."""

    at: int
    begun: int
    subject: list[Token]


def _asked_state(tokens: list[Token], said: list[str]) -> _Asked | None:
    at = next((n for n, word in enumerate(said[:-6]) if word in _CHECKS), None)
    begun = None if at is None else _asked_begin(said, at)
    if at is not None and begun is not None:
        return _Asked(at, begun, [])
    close = said.index(FULL_STOP) if FULL_STOP in said else 0
    if said[:1] not in (["is"], ["are"]) or close < _FEWEST or "?" not in tokens[close].raw:
        return None
    return _Asked(0, close - 1, [*tokens[1 : close - 1], tokens[0]])


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
