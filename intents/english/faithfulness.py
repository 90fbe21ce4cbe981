"""The law of faithfulness: every word of a sentence comes back in its goals, or says nothing.

Readings pass over words: a frame that has no slot for a manner, a noun phrase that knows no word
for a material. So it is looked at once, here, when a sentence has been read and before anything is
made of it: each word that carries something (a name, a colour, a number, a superlative, a word that
the grammar does not know) has to come back in the goals, or to stand in words that ask for nothing
(:class:`~intents.english.reading.Notes`). What does not is left out, and that is said: a word that
only describes a thing that is known by its name in a remark, any other in a question.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple, cast

from intents.english.words import lexicon
from intents.english.words.excluding import is_excluded
from intents.english.words.lexer import singular
from intents.english.words.measures import (
    NUMBER_WORDS,
    UNIT_WORDS,
    Measure,
    Number,
    measure,
    number,
)
from intents.english.words.spelling import GRAMMAR_WORDS
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, participle_base, verbs_at
from intents.goals import (
    Answer,
    Ask,
    Balance,
    Bring,
    Close,
    ForEach,
    Gesture,
    Give,
    Goal,
    GoTo,
    If,
    LookAt,
    Open,
    Repeat,
    Report,
    Say,
    Wait,
    each,
    to_builtins,
)

_SUPERLATIVE_WORDS = frozenset(phrase[-1] for phrase in lexicon.SUPERLATIVES)
_QUANTIFIERS = lexicon.words("all every each both most half several none except besides")
_LIMBS = lexicon.words("hand hands arm arms gripper grippers")
_OF_LIMBS = lexicon.words("with using use in your both two one left right of my the")
"""What stands before a hand that is no verb: "with both hands", not "hand me the cup"."""
_WAYS = lexicon.words(
    "backward backwards rearwards sideways upside diagonally kneel kneeling crawl jump hop tiptoe"
)
"""How something is to be done, for which no goal has a slot but a walk by some distance."""
_LOCKS = lexicon.words("lock locks locked locking unlock unlocked")
"""What is taken for closing and opening, and is more than that."""
_POSES = lexicon.words("kneel kneeling")
"""What is taken for a squat, and is none."""
_PARTS = lexicon.words("foot yard")
"""Units that are things, too."""
_ORDINALS = lexicon.words("second third fourth fifth")
_BOARDS = lexicon.words("top upper bottom lower middle topmost uppermost")
CARRYING = (
    frozenset(lexicon.COLORS) | frozenset(lexicon.SIZES) | _SUPERLATIVE_WORDS | NUMBER_WORDS
    | frozenset(lexicon.COMPARATIVES) | lexicon.EMPTY_ADJECTIVES | _QUANTIFIERS | _LIMBS | _WAYS
    | _ORDINALS | _BOARDS | lexicon.CLOTHES | _LOCKS
) - lexicon.words("left right finest light other same the to short long one")  # fmt: skip
"""Words of closed classes that say something by themselves: what, how many, which, in what way."""
_EXTREMES = lexicon.words(
    "furthest farthest nearest closest leftmost rightmost topmost lowest highest"
)
_MARKS = frozenset(lexicon.COLORS) | frozenset(lexicon.SIZES)
_WHICH = frozenset(("the", "that", "this", *_MARKS))
_NO_SUPERLATIVES = lexicon.words(
    "best rest test nest vest chest guest forest request interest harvest honest modest west quest "
    "protest contest arrest invest suggest digest latest earliest dearest jest pest zest latest "
    "lest midwest northwest southwest crest fest priest tempest almost least everest behest"
)
"""Words in -est that single nothing out."""
_OTHERS = lexicon.words(
    "x y quantity wear whoever whatever whichever robot result total amount given being having "
    "went gone ended floor apartment house ok today fist"
)
"""Words of constructions that the readings know and no list has."""
_PEOPLE = lexicon.PERSON_NOUNS | frozenset(lexicon.GENDERS)
_WEIGHING = lexicon.words("weigh weighs weight weights heavy large big little small slender thick")
_TAKEN_BACK = lexicon.words("no sorry wait actually rather")
_SPEAKS = (Say, Ask, Answer, Report)
_HANDED = (Gesture, Open, Close, Balance, LookAt)


class LeftOut(NamedTuple):
    """Words that no goal carries; ``slight`` ones only describe what is known by its name."""

    said: str
    slight: bool


def left_out(text: Text, goals: Iterable[Goal], passed: Iterable[tuple[int, int]]) -> list[LeftOut]:
    """The words of a sentence that come back in none of its goals.

    Args:
        text: The sentence.
        goals: What it was read as.
        passed: From where to where words stand that ask for nothing.
    """
    told = _Told(tuple(each(goals)))
    silent = {at for start, end in passed for at in range(start, end)}
    silent -= {at for start, end in passed for at in _singling_out(text, start, end)}
    silent -= {at for at in silent if _is_told_superlative(text, at, told)}
    dropped: list[LeftOut] = []
    at = 0
    while at < len(text):
        end, carried = (at + 1, True) if at in silent else _carried(text, at, told)
        if not carried:
            grave = text.word(at) in CARRYING - lexicon.EMPTY_ADJECTIVES
            grave = grave or is_superlative(text.word(at))
            slight = not grave and (_describes(text, end, told) or _owns(text, at, told))
            dropped.append(LeftOut(text.raw(at, end), slight))
        at = max(end, at + 1)
    return dropped


def is_superlative(word: str) -> bool:
    """Whether a word looks like a superlative, be it one that no list has: "teensiest"."""
    return word.endswith("est") and len(word) > 2 and word not in _NO_SUPERLATIVES


def _singling_out(text: Text, start: int, end: int) -> Iterator[int]:
    """Names, colours and sizes in "it's *the one* on the shelf": what tells which one is meant.

    That is a part of the order wherever it is said, however much it looks like background.
    """
    ones = [n for n in range(start + 1, end) if text.word(n) in lexicon.ONES]
    first = next((n for n in ones if text.word(n - 1) in _WHICH), None)
    if first is None or is_excluded(text, start, first):
        return  # not the green one: which one is not meant has been taken account of
    if text.word(first - 1) in _MARKS:
        yield first - 1
    for n in range(first + 1, end):
        match = text.name_at(n)
        if text.word(n) in _MARKS | _EXTREMES or (match is not None and not match.of("person")):
            yield n


def _is_told_superlative(text: Text, at: int, told: "_Told") -> bool:
    """Whether it is told of a thing that it is the smallest, and something is done with any.

    "The *smallest* cap's for Ada, give it to her"; what is taken back has come back otherwise.
    """
    most = text.lookup(lexicon.SUPERLATIVES, at)
    match = text.name_at(most[1]) if most else None
    thing = match.of("object", "category") if match else ""
    return bool(thing) and told.name(thing) and not told.words & _SUPERLATIVE_WORDS


class _Told:
    """What the goals say, word by word."""

    def __init__(self, goals: tuple[Goal, ...]) -> None:
        self.goals = goals
        plain_goals = to_builtins(goals)
        self.values = {value.lower() for value in _strings(plain_goals)}
        self.numbers = numbers(goals)
        plain = " ".join(self.values).replace("_", " ").replace("-", " ").split()
        self.words = {*plain, *map(singular, plain)}
        self.speaks = any(isinstance(goal, _SPEAKS) for goal in goals)
        self.answers = any(isinstance(goal, Answer) for goal in goals) or all(
            isinstance(goal, Report) for goal in goals
        )
        self.walks_by = any(isinstance(goal, GoTo) and goal.by for goal in goals)

    def name(self, *names: str) -> bool:
        """Whether one of these names comes back."""
        return any(
            name.lower() in self.values or self.words.issuperset(name.lower().split())
            for name in names
        )

    def number(self, value: float) -> bool:
        """Whether a quantity comes back, be it an angle in degrees or in turns."""
        same = (value, value * 3.141593 / 180, value * 6.283185)
        return any(abs(n - one) <= 2e-3 * max(1.0, one) for n in self.numbers for one in same)

    def several(self) -> bool:
        """Whether something is done with each of several things or people."""
        return "all" in self.values or self.has(ForEach)

    @property
    def handed_over(self) -> bool:
        """Whether something is given to somebody, and not only taken somewhere."""
        to_somebody = (isinstance(g, Bring) and not isinstance(g.to, str) for g in self.goals)
        return self.has(Give) or any(to_somebody)

    def has(self, *kinds: type[Goal]) -> bool:
        """Whether there is a goal of one of these kinds."""
        return any(isinstance(goal, kinds) for goal in self.goals)


def _carried(text: Text, at: int, told: _Told) -> tuple[int, bool]:
    """Where what is said at a word ends, and whether it comes back."""
    word, match = text.word(at), text.name_at(at)
    if word in lexicon.BOARDS and at and _is_told_board(text.word(at - 1), told):
        return at + 1, True
    if match and word not in _OTHERS | _PEOPLE:
        known = told.name(*(n.name for n in match.names)) or told.answers
        known = known or _whole_of(text, at, match.end, told) or _contents(text, match.end, told)
        known = known or (told.speaks and told.words.issuperset(text.words[at : match.end]))
        if match.of("person") and lexicon.LEAVING.intersection(
            text.words[match.end : match.end + 2]
        ):
            return match.end, True  # the plate Ada left on the sofa
        if match.of("person") and text.word(match.end + 1) in _TAKEN_BACK and told.speaks:
            return match.end, True  # tell Ada, no, Leo, that ...
        favour = text.word(at - 1) == "for" and bool(match.of("person"))
        return match.end, known or (favour and not told.handed_over)
    most = text.lookup(lexicon.SUPERLATIVES, at)
    if most:
        known = most[0] in told.values or text.word(at - 1) in _WEIGHING
        return most[1], known or _is_told_board(word, told)
    if not word[0].isalnum() or word in told.words or singular(word) in told.words:
        return at + 1, True
    amount = measure(text.words, at) or number(text.words, at)
    if amount and told.number(amount.value):
        return amount.end, True
    if amount and _is_quantity(text, at, amount) and not told.speaks:
        return amount.end, False  # a minute's wait
    if amount and (word in NUMBER_WORDS - {"one"} or word[0].isdigit()) and not told.speaks:
        return amount.end, amount.value == 1 or (told.has(Repeat) and amount.value < 1)
    verb = max((end for _, end in verbs_at(text.words, at)), default=at)
    if verb > at + 1 and word not in _POSES:
        return verb, True
    if word in CARRYING:
        return at + 1, told.speaks or _word_carried(text, at, told)
    return at + 1, told.speaks or _is_listed(word)


def _is_quantity(text: Text, at: int, amount: Measure | Number) -> bool:
    """Whether an amount, be it of one, says how long or how far: *a minute*, *1 m*; not *a foot*.

    Who is to come "here (for) a minute" is not told to leave after it.
    """
    measured = isinstance(amount, Measure) and amount.kind in ("time", "length")
    here = "here" in (text.word(at - 1), text.word(at - 2) if text.word(at - 1) == "for" else "")
    return measured and not here and text.word(amount.end - 1) in UNIT_WORDS - _PARTS


def _is_listed(word: str) -> bool:
    """Whether the grammar knows a word, in whatever form."""
    forms = (word, base_form(word), participle_base(word))
    return any(form in lexicon.LISTED or form in GRAMMAR_WORDS for form in forms)


def _word_carried(text: Text, at: int, told: _Told) -> bool:
    """Whether a word of a closed class that carries something comes back."""
    word, after = text.word(at), text.word(at + 1)
    tables = (lexicon.COLORS, lexicon.SIZES, lexicon.COMPARATIVES)
    if told.values.intersection(filter(None, (table.get(word) for table in tables))):
        return True
    if word in _QUANTIFIERS:
        return _quantity_carried(text, at, told)
    if word in _LIMBS:
        about = text.word(at - 1) not in _OF_LIMBS or {"holding", "true"} & told.words
        return bool(about) or told.has(*_HANDED) or any(map(_is_held, told.goals))
    if word in _WEIGHING:
        weighs = (
            told.words & {"heaviest", "lightest", "weight", "size"}
            | told.words & _SUPERLATIVE_WORDS
        )
        if weighs or text.word(at - 1) in ("how", "a"):
            return True
    if word in lexicon.SIZES and told.words.intersection(text.words[at + 1 : at + 3]):
        named = next((m for n in (at + 1, at + 2) if (m := text.name_at(n))), None)
        if named and named.of("person"):
            return True  # little Ada
    if word in lexicon.SIZES or word in lexicon.EMPTY_ADJECTIVES:
        return not _before_noun(text, at + 1)
    if word in _WAYS:
        return told.walks_by
    if word == "longer":
        return told.has(Wait, Balance) and not _before_noun(text, at + 1)
    if word in _ORDINALS:
        return not _before_noun(text, at + 1) and not text.lookup(lexicon.SUPERLATIVES, at + 1)
    if word in _BOARDS:
        said = _is_told_board(word, told) or after == "of"
        return said or not _before_noun(text, at + 1)
    return False


def _is_told_board(word: str, told: _Told) -> bool:
    """Whether one of several boards comes back, by whatever word the world has for it."""
    return not told.words.isdisjoint(lexicon.LEVELS.get(word, ()))


def _quantity_carried(text: Text, at: int, told: _Told) -> bool:
    word = text.word(at)
    if word in ("all", "every", "each", "both"):
        pair = word == "both" and (2 in told.numbers or len(told.goals) > 1)
        fixed = text.word(at + 1) in ("the", "right", "in", "of")
        return told.several() or pair or fixed or not _before_noun(text, at + 1)
    if word in ("except", "besides"):
        return "'except':" in str(to_builtins(told.goals))
    if word == "none":
        return told.has(If)
    return word == "most" and bool(told.words & _SUPERLATIVE_WORDS)


def _before_noun(text: Text, at: int) -> bool:
    """Whether a name, or what stands before one, begins at a word."""
    word = text.word(at)
    return text.name_at(at) is not None or word in CARRYING or word in lexicon.OBJECT_NOUNS


def _is_held(goal: Goal) -> bool:
    return bool(getattr(getattr(goal, "object", None), "held", False))


def _contents(text: Text, end: int, told: _Told) -> bool:
    """A *bottle* of water, the *shelf* of the bookcase, where what follows comes back."""
    begin = end + 1 + (text.word(end + 1) in lexicon.DETERMINERS)
    within = text.name_at(begin) if text.word(end) == "of" else None
    return within is not None and told.name(*(n.name for n in within.names))


_LINKS = lexicon.FUNCTION_WORDS | lexicon.words("front top side back middle")


def _whole_of(text: Text, at: int, end: int, told: _Told) -> bool:
    """The table *in the kitchen*: the more precise of two places stands for both."""
    match = text.name_at(at)
    if match is None or not match.of("place", "room"):
        return False
    before = at - 1 - (text.word(at - 1) in lexicon.DETERMINERS)
    if not match.of("room") and text.word(before) in ("in", "into"):
        return False  # on the sofa in the wardrobe: one of them is where to
    while before >= 0 and text.word(before) in _LINKS:
        before -= 1
    if told.name(*(n.name for n in text.index.partial(text.word(before)))):
        return True
    around = [text.name_at(end)]
    for n in range(max(0, before - 4), before + 1):
        name = text.name_at(n)
        around += [name] if name and name.end == before + 1 else []
    return any(m and told.name(*(n.name for n in m.names)) for m in around)


def _describes(text: Text, at: int, told: _Told) -> bool:
    """Whether what stands before a word only describes a thing whose name comes back."""
    if "with" in text.words[max(0, at - 4) : at - 1]:
        return True  # the book with a blue cover: the colour has come back
    for n in range(at, min(at + 4, len(text))):
        match = text.name_at(n)
        if match:
            return told.name(*(name.name for name in match.names))
        if not text.word(n)[0].isalpha() or text.word(n) in lexicon.FUNCTION_WORDS:
            return False
    return False


def _owns(text: Text, at: int, told: _Told) -> bool:
    """The charger *of my laptop*, the cap *of Hans*: whose it is of what comes back."""
    of = at - 1 - (text.word(at - 1) in lexicon.DETERMINERS)
    return text.word(of) == "of" and singular(text.word(of - 1)) in told.words


def strings(goals: Iterable[Goal]) -> list[str]:
    """Every word that goals say, in lower case."""
    return [value.lower() for value in _strings(to_builtins(goals))]


def numbers(goals: Iterable[Goal]) -> list[float]:
    """Every number that goals say, without its sign."""
    return [abs(value) for value in _numbers(to_builtins(goals))]


def _strings(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    for inner in _inside(value):
        yield from _strings(inner)


def _numbers(value: object) -> Iterator[float]:
    if isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)
    for inner in _inside(value):
        yield from _numbers(inner)


def _inside(value: object) -> Iterable[object]:
    if isinstance(value, dict):
        return cast("dict[str, object]", value).values()
    return cast("list[object]", value) if isinstance(value, list | tuple) else ()
