"""The steps of a plan: which of them words mean, and the plan without some, or in another order.

A step that is done with what an earlier one has fetched ("put it on the shelf") hangs together with
that one: it goes where that goes, and is left out with it.
"""

import re

from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.english.words.measures import NUMBER_WORDS, number
from intents.english.words.names import index_of
from intents.goals import Goal, ObjectQuery
from intents.vocabulary import Vocabulary
from intents.wording import in_words

Steps = tuple[Goal, ...]


class NoSuchStep(Exception):
    """It is not in the plan; ``str()`` says so to people."""


class NoSuchNumber(NoSuchStep):
    """The plan has no step of that number."""


_EMPTY = lexicon.DETERMINERS | lexicon.words(
    "step steps number numbers no point points one ones and of to in on at into with it them that "
    "this do thing things , putting bringing taking put bring take get fetch"
)
_ORDINALS = {
    "first": 1, "second": 2, "third": 3, "fourth": 4, "fifth": 5, "sixth": 6, "seventh": 7,
    "eighth": 8, "ninth": 9, "tenth": 10,
}  # fmt: skip
_ALL = lexicon.words("it all of everything that them this")
_STEM = 3
"""Letters that two forms of a word begin with: "putting", "put"."""


class Pointing:
    """Finds the steps that words mean."""

    def __init__(self, goals: Steps, vocabulary: Vocabulary, *, shown: Steps) -> None:
        """Prepare; the numbers are those of the plan as it was `shown`."""
        self._goals = goals
        self._numbers = {id(goal): n for n, goal in enumerate(shown, 1)}
        self._index = index_of(vocabulary)

    def __call__(self, which: str) -> set[int]:
        """Places in the plan, from 0.

        Raises:
            NoSuchStep: There is no such step.
        """
        words = which.split()
        if _ALL.issuperset(words):
            raise NoSuchStep("That is all of it: say “no”.")
        try:
            return self._by_number(words) or self._by_words(which, words)
        except NoSuchNumber:
            spoken_of = self._fitting(words)  # “say three”
            if spoken_of:
                return spoken_of
            raise

    def _by_number(self, words: list[str]) -> set[int]:
        """Those that are called by numbers; none if there are other words."""
        numbers: list[int] = []
        plain = [w for w in words if w not in _EMPTY or w in NUMBER_WORDS]
        if len(plain) > 1 and plain[-1] in NUMBER_WORDS and words[-1] in ("one", "ones"):
            plain = plain[:-1]  # the second one
        through = {"to", "through", "till", "until"}.intersection(words)
        for word in plain:
            meant = max(self._numbers.values()) if word == "last" else _number(word)
            if meant is None and word not in through:
                return set()
            numbers += [meant] if meant is not None else []
        if through and len(numbers) == 2:
            numbers = list(range(numbers[0], numbers[1] + 1))
        wrong = [n for n in numbers if n not in self._numbers.values()]
        if wrong:
            raise NoSuchNumber(f"There is no step {wrong[0]}.")
        return {at for at, goal in enumerate(self._goals) if self._numbers[id(goal)] in numbers}

    def _by_words(self, which: str, words: list[str]) -> set[int]:
        """Those that speak of what is named."""
        alternatives = re.split(r"\s*(?:,|\band\b|\bor\b)\s*", which)
        if len(alternatives) > 1:
            found = [self._fitting(one.split()) for one in alternatives if one]
            if all(found):
                return set[int]().union(*found)
        found = self._fitting(words)
        if not found:
            raise NoSuchStep(f"No step speaks of “{which}”.")
        return found

    def _fitting(self, words: list[str]) -> set[int]:
        wanted = self._plain(words)
        if not wanted:
            return set()
        steps = [self._plain(re.findall(r"\w+", in_words((goal,)).lower())) for goal in self._goals]
        return {n for n, step in enumerate(steps) if all(_among(word, step) for word in wanted)}

    def _plain(self, words: list[str]) -> set[str]:
        """The telling words, singular, with names as the vocabulary spells them."""
        plain: set[str] = set()
        at = 0
        while at < len(words):
            match = self._index.match(words, at)
            if match:
                plain |= {singular(w) for w in match.names[0].name.lower().split()}
            elif words[at] not in _EMPTY:
                plain.add(singular(words[at]))
            at = match.end if match else at + 1
        return plain


def _number(word: str) -> int | None:
    if word in _ORDINALS:
        return _ORDINALS[word]
    found = number([word], 0)
    return int(found.value) if found is not None and found.value == int(found.value) else None


def _among(word: str, step: set[str]) -> bool:
    """Whether a step has a word, or another form of it: "waving" for "wave"."""
    if word in step:
        return True
    stem = word.removesuffix("ing") if word.endswith("ing") else ""
    return len(stem) >= _STEM and any(one.startswith(stem) for one in step)


def without(goals: Steps, out: set[int]) -> Steps:
    """The others, without what was to be done with a thing that is not fetched any more."""
    fetched = _fetched(goals)
    for n in range(len(goals)):
        if fetched[n] in out:
            out = out | {n}
    return tuple(goal for n, goal in enumerate(goals) if n not in out)


def kept(goals: Steps, wanted: set[int]) -> Steps:
    """These, and what fetches the things that they are done with."""
    fetched = _fetched(goals)
    for n in reversed(range(len(goals))):
        before = fetched[n]
        if n in wanted and before is not None:
            wanted = wanted | {before}
    return tuple(goal for n, goal in enumerate(goals) if n in wanted)


def moved(goals: Steps, these: set[int], to: int) -> Steps:
    """These before step `to`, in the order they had, with what hangs together with them."""
    fetched = _fetched(goals)
    together = [_together(n, fetched) for n in range(len(goals))]
    whole = {n for n in range(len(goals)) if together[n] & these}
    before = [n for n in range(to) if n not in whole]
    after = [n for n in range(to, len(goals)) if n not in whole]
    return tuple(goals[n] for n in (*before, *sorted(whole), *after))


def swapped(goals: Steps, one: set[int], other: set[int]) -> Steps:
    """One in the place of the other."""
    fetched = _fetched(goals)
    first, second = sorted((_together(min(one), fetched), _together(min(other), fetched)), key=min)
    order: list[int] = []
    for n in range(len(goals)):
        if n == min(first):
            order += sorted(second)
        elif n == min(second):
            order += sorted(first)
        elif n not in first | second:
            order.append(n)
    return tuple(goals[n] for n in order) if not first & second else goals


def _fetched(goals: Steps) -> list[int | None]:
    """For each step that is done with what an earlier one has fetched, which that is."""
    source: int | None = None
    found: list[int | None] = []
    for n, goal in enumerate(goals):
        query = getattr(goal, "object", None)
        again = isinstance(query, ObjectQuery) and query.held
        found.append(source if again else None)
        source = source if again or not isinstance(query, ObjectQuery) else n
    return found


def _together(at: int, fetched: list[int | None]) -> set[int]:
    """A step with those that fetch for it, or that it fetches for."""
    first = at
    while (before := fetched[first]) is not None:
        first = before
    return {first, *(n for n, source in enumerate(fetched) if source == first)}
