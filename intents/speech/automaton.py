"""Finite automata over words, as small as they can be: what a speech grammar is compiled to.

Built from arcs with and without a word, made deterministic by the subset construction and minimal
by refining partitions [Hopcroft, Ullman 1979, chapters 2 and 3].
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import msgspec


class Automaton(msgspec.Struct, frozen=True, kw_only=True):
    """A deterministic automaton; state 0 is the first.

    Attributes:
        arcs: of each state, the state that each word leads to; no words lead to nowhere.
        final: the states in which a sentence may end.
    """

    arcs: tuple[dict[str, int], ...]
    final: frozenset[int]

    @property
    def words(self) -> frozenset[str]:
        """Every word that occurs."""
        return frozenset(word for arcs in self.arcs for word in arcs)

    def accepts(self, words: Iterable[str]) -> bool:
        """Whether the words are a sentence."""
        state: int | None = 0
        for word in words:
            state = self.arcs[state].get(word)
            if state is None:
                return False
        return state in self.final


class Builder:
    """An automaton under construction; arcs without a word (None) may be taken at any time."""

    start = 0

    def __init__(self) -> None:
        """One state, no arcs."""
        self._free: list[list[int]] = [[]]
        self._spoken: list[list[tuple[str, int]]] = [[]]

    def state(self) -> int:
        """A new state."""
        self._free.append([])
        self._spoken.append([])
        return len(self._free) - 1

    def arc(self, source: int, word: str | None, target: int) -> None:
        """Lead from one state to another."""
        if word is None:
            self._free[source].append(target)
        else:
            self._spoken[source].append((word, target))

    def automaton(self, end: int) -> Automaton:
        """The smallest automaton that accepts what leads from the first state to `end`."""
        reached: dict[int, frozenset[int]] = {}
        first = self._reached(self.start, end, reached)
        numbers = {first: 0}
        arcs: list[dict[str, int]] = []
        for states in (waiting := [first]):
            targets: defaultdict[str, set[int]] = defaultdict(set)
            for state in states:
                for word, target in self._spoken[state]:
                    targets[word].add(target)
            arcs.append({})
            for word in sorted(targets):
                parts = [self._reached(state, end, reached) for state in targets[word]]
                found = parts[0].union(*parts[1:])
                if found not in numbers:
                    numbers[found] = len(waiting)
                    waiting.append(found)
                arcs[-1][word] = numbers[found]
        final = {number for states, number in numbers.items() if end in states}
        return _smallest(*_useful(arcs, final))

    def _reached(self, state: int, end: int, known: dict[int, frozenset[int]]) -> frozenset[int]:
        """The states that matter among those that are reached without a word."""
        if state not in known:
            seen, waiting = {state}, [state]
            while waiting:
                new = [target for target in self._free[waiting.pop()] if target not in seen]
                seen.update(new)
                waiting += new
            known[state] = frozenset(one for one in seen if self._spoken[one] or one == end)
        return known[state]


def _useful(arcs: list[dict[str, int]], final: set[int]) -> tuple[list[dict[str, int]], set[int]]:
    """Without the arcs from which no sentence can be finished."""
    sources: defaultdict[int, set[int]] = defaultdict(set)
    for source, targets in enumerate(arcs):
        for target in targets.values():
            sources[target].add(source)
    useful, waiting = set(final), list(final)
    while waiting:
        for source in sources[waiting.pop()] - useful:
            useful.add(source)
            waiting.append(source)
    return [{w: t for w, t in targets.items() if t in useful} for targets in arcs], final


def _smallest(arcs: list[dict[str, int]], final: set[int]) -> Automaton:
    """One state for all from which the same can follow."""
    group = [int(state in final) for state in range(len(arcs))]
    count = 0
    while count != len(set(group)):
        count = len(set(group))
        found: dict[tuple[int | tuple[str, int], ...], int] = {}
        group = [
            found.setdefault((old, *((w, group[t]) for w, t in targets.items())), len(found))
            for old, targets in zip(group, arcs, strict=True)
        ]
    kept = {group[s]: {w: group[t] for w, t in arcs[s].items()} for s in range(len(arcs))}
    return Automaton(
        arcs=tuple(kept[number] for number in range(len(kept))),
        final=frozenset(group[state] for state in final),
    )
