"""Quantities and directions that are taken back at once: "turn left, no, right"; "two, no, three".

The repair stands for what is of its kind before it [Shriberg1994], so the words are those that were
meant before anything is read. Things, places and people are taken back by what they mean, in
:mod:`intents.english.corrections`.

[Shriberg1994] E. Shriberg, Preliminaries to a Theory of Speech Disfluencies, UC Berkeley, 1994.
"""

from collections.abc import Iterator
from typing import NamedTuple

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token, singular
from intents.english.words.measures import measure, number

TAKES_BACK = lexicon.phrases(
    "no,no sorry,sorry,no wait,wait no,no i mean,no i meant,sorry i mean,sorry i meant,i mean,"
    "i meant,i mean to say,i meant to say,or rather,rather,make that,make it,no make that,"
    "correction,oops,whoops,my mistake,scratch that,i should say,pardon,better,or better,"
    "cancel that,scrap that,strike that,delete that,belay that,forget that,negative,or no,"
    "upon reflection,on reflection,upon mature reflection,on mature reflection,"
    "what am i saying,no better,on second thoughts,on second thought"
)
"""What is said before what is meant instead."""
_MARKERS = TAKES_BACK | lexicon.phrases("no no,sorry no,no make it,no better,excuse me")
_CRIES = lexicon.words("ah oh hm hmm er uh um ach och aw ay oops whoops")
_REGRETS = lexicon.words("excuse pardon forgive apologies")
_SAID_WITH = _CRIES | _REGRETS | lexicon.words("no sorry wait please me my i mean meant beg your")
"""What is said around a "no" that takes something back."""
_SPOTS = lexicon.words("to in on into onto at")
"""Before one of these no thing of a list begins: what comes is said anew."""
_PAUSES = lexicon.phrases("wait,hold on,hang on")
"""Between commas, before a direction alone, these are markers, and else orders."""
_ORDERS = lexicon.phrases("cancel,scratch,scrap,delete,strike,say,make it,let us say,call it")
"""Between a quantity and the one that is meant these are markers, and else orders."""
_APART = lexicon.words("no sorry rather correction oops whoops pardon better negative")
"""Alone, these are markers only behind a comma."""
_SIDES = lexicon.words("left right")
_WAYS = lexicon.words(
    "left right forward forwards ahead back backward backwards up down clockwise anticlockwise "
    "counterclockwise"
)
_LEADING = lexicon.words("to with by for at on the my your")
"""What may stand before a direction or a quantity that is said anew."""
_MARKS: dict[str, str] = {
    **dict.fromkeys(lexicon.COLORS, "color"),
    **dict.fromkeys(lexicon.words("big small large little tall short thick thin"), "size"),
}
"""What a thing is told by: "the red cup, I mean blue"."""
_SIDED = lexicon.words("hand arm one side")
_GOES_ON = lexicon.words("and then please thanks")
_REPORTS = lexicon.words("say tell announce shout whisper repeat sing ask spell")
"""What is only passed on is said as it was."""
_LONGEST_MARKER = 4
_LONGEST_COUNTED = 6
"""So many words a number and what is counted take."""


class _Said(NamedTuple):
    """A quantity or a direction: its kind, and the words from ``start`` to before ``end``."""

    kind: str
    start: int
    end: int


def as_one_marker(tokens: list[Token]) -> list[Token]:
    """The tokens with ", no," for what is said around it: ", ah no, excuse me please, to Ada"."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3, 0, -1):
        if words[at] != COMMA:
            continue
        end, said = at + 1, set[str]()
        while end < len(words) and words[end] in _SAID_WITH | {COMMA}:
            said.add(words[end])
            end += 1
        regrets = not _REGRETS.isdisjoint(said) or ("no" in said and not _CRIES.isdisjoint(said))
        if regrets and end < len(words) and words[end] in _SPOTS:
            mark = [Token(COMMA, ","), Token("no", "no"), Token(COMMA, ",")]
            return as_one_marker([*tokens[:at], *mark, *tokens[end:]])
    return tokens


def repaired(tokens: list[Token]) -> list[Token]:
    """The tokens with every quantity and direction as it was said last."""
    words: list[str] = [token.text for token in tokens]
    at = 1
    while at < len(words):
        marked = _marker_end(words, at)
        again = _counted_anew(words, at, marked) if marked is not None else None
        if marked is not None and again is not None and not _REPORTS.intersection(words[:at]):
            tokens = tokens[:again] + tokens[marked:]
            words = [token.text for token in tokens]
            continue
        anew = _anew(words, marked) if marked is not None else None
        begins = _begin(words, at)
        old = _last(words, begins, at, anew) if anew else None
        if anew is None or old is None or _REPORTS.intersection(words[:at]):
            at += 1
            continue
        new, end = anew
        stays = tokens[old.end : at]
        tokens = tokens[: old.start] + tokens[new.start : new.end] + stays + tokens[end:]
        words = [token.text for token in tokens]
        at = old.start + 1
    return tokens


def _marker_end(words: list[str], at: int) -> int | None:
    """Where the markers end that begin at a word or at the comma before it: "wait, no"."""
    pause = words[at - 1] in (COMMA, FULL_STOP) and words[at : at + 2] == ["wait", COMMA]
    end = _one_marker_end(words, at + 2 * pause) if at + 2 * pause < len(words) else None
    while end is not None and end < len(words):
        further = _one_marker_end(words, end) if words[end - 1] == COMMA else None
        if further is None:
            break
        end = further
    return end


def _one_marker_end(words: list[str], at: int) -> int | None:
    """Where one marker ends."""
    start = at + (words[at] == COMMA)
    for size in range(_LONGEST_MARKER, 0, -1):
        phrase = tuple(words[start : start + size])
        if phrase in _MARKERS:
            apart = start > at or size > 1 or phrase[0] not in _APART or _begins(words, at)
            end = start + size
            return end + (words[end : end + 1] == [COMMA]) if apart else None
        end = start + size
        pauses = phrase in _PAUSES and words[end : end + 1] == [COMMA] == words[at : at + 1]
        if pauses and words[end + 1 : end + 2] and words[end + 1] in _WAYS:
            return end + 1
        counted = end + (words[end : end + 1] == [COMMA])
        if phrase in _ORDERS and start > at and number(words, counted) and _is_counted(words, at):
            return counted
    return None


def _is_counted(words: list[str], at: int) -> bool:
    """Whether a quantity was said in the clause before a sign: *two* eggs, say three."""
    begin = max((n + 1 for n in range(at) if words[n] in (COMMA, FULL_STOP)), default=0)
    return any(number(words, n) is not None and words[n] != "one" for n in range(begin, at))


def _anew(words: list[str], at: int) -> tuple[_Said, int] | None:
    """What is said anew behind a marker, and where it ends with all that belongs to it."""
    start = at
    while start < len(words) and words[start] in _LEADING:
        start += 1
    found = next(_said(words, start, min(len(words), start + 1)), None)
    if found is None or found.start != start:
        return None
    end = found.end
    if words[found.start] in _SIDES and words[end : end + 1] and words[end] in _SIDED:
        end += 1
    following = words[end] if end < len(words) else FULL_STOP
    closes = following in _GOES_ON | {COMMA, FULL_STOP}
    return (found, end) if closes or (found.kind != "way" and following in _WAYS) else None


def _counted_anew(words: list[str], at: int, marked: int) -> int | None:
    """Two eggs, cancel, *three eggs* ...: where the same begins that is counted anew."""
    count = number(words, marked) if marked < len(words) else None
    if count is None or words[marked] == "one":
        return None
    for begin in range(at - 1, max(-1, at - _LONGEST_COUNTED), -1):
        old = number(words, begin)
        thing = [singular(word) for word in words[old.end : at]] if old else []
        same = [singular(word) for word in words[count.end : count.end + len(thing)]]
        if old is not None and thing and same == thing:
            return begin
    return None


def _begins(words: list[str], at: int) -> bool:
    """Turn left. *No*, right: whether a marker begins a sentence of its own."""
    return words[at - 1] in (COMMA, FULL_STOP) and words[at + 1 : at + 2] == [COMMA]


def _begin(words: list[str], at: int) -> int:
    """Where the clause begins that a marker takes something of back."""
    ends = range(at - (words[at - 1] == FULL_STOP))
    return max((n + 1 for n in ends if words[n] in (FULL_STOP, "then")), default=0)


def _last(words: list[str], begin: int, end: int, anew: tuple[_Said, int]) -> _Said | None:
    """The newest of that kind: a plain number takes the place of one with a unit, which stays."""
    for one in reversed([one for one in _said(words, begin, end) if one.end <= end]):
        if one.kind == anew[0].kind:
            return one
        counted = number(words, one.start) if anew[0].kind == "plain" else None
        if counted is not None:
            return one._replace(end=counted.end)
    return None


def _said(words: list[str], begin: int, end: int) -> Iterator[_Said]:
    """Quantities and directions that begin between two words, one after the other."""
    at = begin
    while at < end:
        with_unit, counted = measure(words, at), number(words, at)
        if words[at] in _WAYS:
            found = _Said("way", at, at + 1)
        elif words[at] in _MARKS:
            found = _Said(_MARKS[words[at]], at, at + 1)
        elif with_unit is not None:
            found = _Said(with_unit.kind, at, with_unit.end)
        elif counted is not None and not (at and words[at] == "one"):  # the red one
            found = _Said("plain", at, counted.end)
        else:
            at += 1
            continue
        yield found
        at = found.end
