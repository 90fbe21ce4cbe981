"""What each word of a sentence looks like: the features that the tagger of background weighs."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.names import NameIndex
from intents.english.words.spelling import GRAMMAR_WORDS
from intents.english.words.verbs import verbs_at

_WORD = re.compile(r"[A-Za-z0-9]+(?:['’][A-Za-z]+)*|[^\sA-Za-z0-9]")
_SIGNS = frozenset('.,;:!?()-–—…"“”')
_LINKS = lexicon.words(
    "and so but because cos cuz coz cause since as for or while when whilst where which who whom "
    "whose that than then before after till until unless if though although like afore nor yet plus"
)
"""Words that begin a clause, besides those after a sign."""
_LEADS = lexicon.words("please pls just then now well oh and go kindly also")
_SUBJECTS = {
    said: subject
    for subject, words in {
        "i": "i im ive i'm i've i'd i'll id",
        "you": "you u ya ye you're you've you'll youre",
        "he": "he she he's she's hes shes he'll she'll he'd she'd nobody everyone everybody "
        "someone somebody",
        "they": "they they're they've they'll theyre",
        "we": "we we're we've we'll",
        "were": "were",
        "it": "it it's its it'll",
        "that": "that that's thats this these those",
        "there": "there there's theres",
        "my": "my our",
        "his": "his her their",
        "the": "the",
        "a": "a an",
        "who": "who",
        "what": "what",
        "one": "one",
    }.items()
    for said in words.split()
}
_FINITE = lexicon.words(
    "is are was were am be been being has have had does do did will would can could shall should "
    "may might must cannot gonna wanna gotta ain't"
)
_NEGATIONS = lexicon.words("not no never none nothing nobody without dont cant wont neither nor")
_KEPT = lexicon.words(
    "only except but both all every each instead slowly carefully gently quickly hand hands first "
    "last twice times"
)
_MODALS = lexicon.words("could can would will cud wud may might shall")
_LITTLE = lexicon.words("the a an of")


class Said(NamedTuple):
    """A word or a sign, from which character to which it stands, and how it was written."""

    start: int
    end: int
    raw: str

    @property
    def is_sign(self) -> bool:
        """Whether it is a sign and no word."""
        return not self.raw[0].isalnum()


def said(text: str) -> list[Said]:
    """The words and signs of a text as they stand, none corrected or left out."""
    return [Said(m.start(), m.end(), m.group()) for m in _WORD.finditer(text)]


@dataclass(frozen=True, slots=True)
class _Clause:
    """What a clause looks like: the words from a sign or a link to the next."""

    start: int
    end: int
    link: str
    first: str
    subject: str
    is_order: bool
    is_finite: bool
    kinds: frozenset[str]
    has_verb: bool
    is_negated: bool
    has_number: bool
    has_kept: bool
    has_past: bool
    has_gerund: bool
    signs: str

    @property
    def asks(self) -> str:
        """Whether it begins with an order and names something."""
        return f"{self.is_order}{bool(self.kinds)}"


def looks(words: list[Said], index: NameIndex) -> list[list[str]]:
    """The features of each word.

    Args:
        words: A sentence.
        index: The names of its world; they count by their kind, so that what was learnt in one
            world holds in another.

    Returns:
        The names of the features of each word.
    """
    plain = [word.raw.lower().replace("’", "'") for word in words]
    kinds = _kinds(plain, index)
    verbs = [bool(verbs_at(plain, at)) and word not in lexicon.FUNCTION_WORDS
             for at, word in enumerate(plain)]  # fmt: skip
    classes = [_class(*one) for one in zip(plain, kinds, verbs, strict=True)]
    clauses = [_clause(plain, kinds, verbs, *span) for span in _clauses(plain)]
    within = {at: n for n, clause in enumerate(clauses) for at in range(clause.start, clause.end)}
    orders = sum(one.is_order and bool(one.kinds - {"part"}) for one in clauses)
    found: list[list[str]] = []
    for at, word in enumerate(words):
        features = ["always", *_of_word(plain, classes, kinds, at)]
        features += ["capital"] if word.raw[0].isupper() else []
        if at in within:
            features += _of_clause(
                plain, kinds, clauses, kind=classes[at], n=within[at], orders=orders, at=at
            )
        else:
            features += _of_sign(clauses, within, at)
        found.append(features)
    return found


def _kinds(plain: list[str], index: NameIndex) -> list[str]:
    """Of what kind of name each word is a part; empty if of none."""
    kinds = [""] * len(plain)
    at = 0
    while at < len(plain):
        match = index.match(plain, at) if plain[at][0].isalnum() else None
        little = plain[at] in lexicon.FUNCTION_WORDS
        if match and not (match.end == at + 1 and little):
            kinds[at : match.end] = [match.names[0].kind] * (match.end - at)
            at = match.end
            continue
        if not little and index.partial(plain[at]):
            kinds[at] = "part"
        at += 1
    return kinds


def _class(word: str, kind: str, verb: bool) -> str:
    """What a word is, whatever it means."""
    if kind:
        return f"name:{kind}"
    if verb:
        return "verb"
    if word in _SIGNS:
        return word
    if word in lexicon.FUNCTION_WORDS:
        return f"function:{word}"
    if word[0].isdigit():
        return "number"
    if word in lexicon.LISTED or word in GRAMMAR_WORDS:
        return "listed"
    return "english" if is_english(word) else "unknown"


def _clauses(plain: list[str]) -> Iterator[tuple[int, int]]:
    start = 0
    for at, word in enumerate(plain):
        if word in _SIGNS or (word in _LINKS and at > start):
            if at > start:
                yield start, at
            start = at + (word in _SIGNS)
    if start < len(plain):
        yield start, len(plain)


def _clause(plain: list[str], kinds: list[str], verbs: list[bool], start: int, end: int) -> _Clause:
    link = plain[start] if plain[start] in _LINKS else ""
    first = start + bool(link)
    while first < end - 1 and plain[first] in _LEADS:
        first += 1
    words = plain[start:end]
    before = plain[start - 1] if start and plain[start - 1] in _SIGNS else "_" if start else "^"
    after = "$" if end >= len(plain) else plain[end] if plain[end] in _SIGNS else "_"
    return _Clause(
        start=start,
        end=end,
        link=link,
        first=plain[first] if first < end else "",
        subject=_subject(plain, kinds, first, end),
        is_order=first < end and verbs[first],
        is_finite=any(w in _FINITE or w.endswith(("'s", "'re", "'ve", "'ll", "n't"))
                      for w in words),
        kinds=frozenset(kinds[start:end]) - {""},
        has_verb=any(verbs[start:end]),
        is_negated=any(w in _NEGATIONS or w.endswith("n't") for w in words),
        has_number=any(w[0].isdigit() for w in words),
        has_kept=bool(_KEPT.intersection(words)),
        has_past=any(w.endswith("ed") for w in words),
        has_gerund=any(w.endswith("ing") for w in words),
        signs=after + before,
    )  # fmt: skip


def _subject(plain: list[str], kinds: list[str], first: int, end: int) -> str:
    for at in range(first, min(end, first + 3)):
        if plain[at] in _SUBJECTS:
            return _SUBJECTS[plain[at]]
        if kinds[at] == "person":
            return "person"
    return ""


def _of_word(plain: list[str], classes: list[str], kinds: list[str], at: int) -> list[str]:
    """What the word and its neighbours are."""

    def word(n: int) -> str:
        return plain[n] if 0 <= n < len(plain) else "<" if n < 0 else ">"

    def kind(n: int) -> str:
        return classes[n] if 0 <= n < len(plain) else "<" if n < 0 else ">"

    own, known = plain[at], kinds[at] not in ("", "part")
    features = [
        f"w={kind(at) if known else own}", f"c={kind(at)}",
        f"c-1={kind(at - 1)}", f"c+1={kind(at + 1)}", f"c-2={kind(at - 2)}", f"c+2={kind(at + 2)}",
        f"c-1,0={kind(at - 1)}|{kind(at)}", f"c0,1={kind(at)}|{kind(at + 1)}",
        f"c-1,0,1={kind(at - 1)}|{kind(at)}|{kind(at + 1)}",
    ]  # fmt: skip
    if not kinds[at]:
        features += [
            f"w-1={word(at - 1)}", f"w+1={word(at + 1)}", f"w-2={word(at - 2)}",
            f"w+2={word(at + 2)}", f"w-1,0={word(at - 1)}|{own}", f"w0,1={own}|{word(at + 1)}",
            f"end3={own[-3:]}", f"end2={own[-2:]}",
        ]  # fmt: skip
    return features


def _of_clause(
    plain: list[str],
    kinds: list[str],
    clauses: list[_Clause],
    *,
    kind: str,
    n: int,
    orders: int,
    at: int,
) -> list[str]:
    """What the clause of a word is, and those beside it."""
    one = clauses[n]
    names = bool(one.kinds)
    place, thing = one.kinds & {"place", "room"}, one.kinds & {"object", "category"}
    shape = _bits(one.is_order, one.is_finite, thing, place, "person" in one.kinds)
    others = min(2, orders - (one.is_order and names))
    stands = "first" if n == 0 else "last" if n == len(clauses) - 1 else "amid"
    features = [
        f"k.link={one.link}", f"k.first={one.first}", f"k.link+first={one.link}|{one.first}",
        f"k.subject={one.subject}", f"k.shape={shape}",
        f"k.mood={_bits(one.is_order, one.is_finite, names, one.is_negated, one.first in _MODALS)}",
        f"k.subject+finite={one.subject}|{one.is_finite}|{one.link}",
        f"k.subject+names={one.subject}|{one.is_finite}{one.asks}",
        f"k.length={_size(one.end - one.start)}",
        f"k.length+names={_size(one.end - one.start)}|{_bits(names, one.has_verb)}",
        f"k.first+names={one.first}|{names}", f"k.last={plain[one.end - 1]}",
        f"k.signs={one.signs}", f"k.kept={_bits(one.has_kept, one.has_number)}",
        f"k.from={_size(at - one.start)}", f"k.to={_size(one.end - 1 - at)}",
        f"k.first+w={one.first}|{kind if kinds[at] not in ('', 'part') else plain[at]}",
        f"k.subject+c={one.subject}|{one.is_finite}|{kind}",
        f"k.stands={stands}{len(clauses) == 1}", f"k.orders={others}{one.asks}",
        f"k.past={_bits(one.has_past, one.has_gerund)}|{one.subject}",
    ]  # fmt: skip
    for side, m in (("p", n - 1), ("n", n + 1)):
        if not 0 <= m < len(clauses):
            features.append(f"{side}.none")
            continue
        other = clauses[m]
        features += [
            f"{side}.subject={other.subject}|{other.is_finite}",
            f"{side}.asks={other.asks}|{one.asks}",
            f"{side}.first={other.first}", f"{side}.link={other.link}",
        ]  # fmt: skip
    return features + [
        f"in={plain[m]}"
        for m in range(one.start, one.end)
        if not kinds[m] and plain[m] not in _LITTLE
    ]


def _of_sign(clauses: list[_Clause], within: dict[int, int], at: int) -> list[str]:
    """What stands to the left and right of a sign."""
    features: list[str] = []
    for side, n in (("l", within.get(at - 1)), ("r", within.get(at + 1))):
        if n is not None:
            one = clauses[n]
            features += [
                f"{side}.first={one.first}", f"{side}.subject={one.subject}",
                f"{side}.order={one.is_order}", f"{side}.asks={one.asks}",
                f"{side}.length={_size(one.end - one.start)}", f"{side}.link={one.link}",
            ]  # fmt: skip
    return features


def _bits(*flags: object) -> str:
    return "".join("1" if flag else "0" for flag in flags)


def _size(n: int) -> str:
    return str(n) if n < 5 else "5-7" if n < 8 else "8-12" if n < 13 else "13-"
