"""What a task is made of, as plain values that can be checked and shown before anything moves.

Every part has a *path* inside its task, so that a step can be named: by the journal, by `--from`,
by a run that is taken up again::

    2           the second step                2.1        the first step of the second
    2.then.1    the first step of a branch     2#3.1      the first step of the third round
    2.look.1    the first look that it takes to decide a branch
    2.no_path.1 what is done on that failure   2.always.1 what is done after 2 in any case
    2.1         the first look of a settling   2.then.1   the first step once it is settled
    2*2.1       the same in a second attempt   2+1        2 again, after its first recovery
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

import msgspec

from executive.behaviours.conditions import Predicate
from executive.behaviours.run_skill import Bound
from executive.blackboard import Blackboard
from executive.skills.parameters import SkillParams
from robot.failures import Failure

Words = Callable[[Blackboard], str]
"""What is so, in words."""


class Errand(msgspec.Struct, frozen=True, kw_only=True):
    """One step of a task: its name for people, what the skill is asked, which object it is about.

    `carries` is set where the object is in the hand when the step begins.
    """

    name: str
    params: SkillParams | Bound
    object_id: str | None = None
    object_name: str = ""
    carries: bool = False


class Series(msgspec.Struct, frozen=True, kw_only=True):
    """Parts to be done one after the other."""

    name: str
    parts: tuple[Part, ...]


class Branch(msgspec.Struct, frozen=True, kw_only=True):
    """One part or the other, as the answer to a question is when it is asked.

    With a `look` that is done before, so that the answer is known and not guessed.
    """

    name: str
    question: Predicate
    then: Part
    otherwise: Part
    look: Part | None = None


class Settle(msgspec.Struct, frozen=True, kw_only=True):
    """A part that depends on which things a description means, which is found out by looking.

    The question is asked of what the world model believes: before the first look and after each,
    or, where only all looks together can tell (`thorough`), after the last. It answers with the ids
    of the things, or with why it is still open; what is still open after the last look fails so.

    Attributes:
        looks: where to go and look.
        question: which things are meant.
        then: what is done with those things.
        likely: what that will probably be: it is checked and shown before anything moves.
    """

    name: str
    looks: tuple[Part, ...]
    question: Callable[[Blackboard], tuple[str, ...] | Failure]
    then: Callable[[tuple[str, ...]], Part]
    likely: Part
    thorough: bool = False


class Each(msgspec.Struct, frozen=True, kw_only=True):
    """The same with several things: a part for each, done whatever became of those before it.

    At the end the robot says which were done and which not. It fails as the first one did.
    `things` names what each part is about.
    """

    name: str
    parts: tuple[Part, ...]
    things: tuple[str, ...]


class Parallel(msgspec.Struct, frozen=True, kw_only=True):
    """Parts to be done at the same time; the first that fails ends the others."""

    name: str
    parts: tuple[Part, ...]


class Loop(msgspec.Struct, frozen=True, kw_only=True):
    """A part done again and again, in at most `at_most` rounds.

    With a question the loop ends when the answer is no, and fails if it is yes after all rounds.
    `bodies` holds what the first rounds do where that differs; the last one goes for all others.
    """

    name: str
    bodies: tuple[Part, ...]
    at_most: int
    question: Predicate | None = None

    def body(self, number: int) -> Part:
        """What a round does; the first is number 1."""
        return self.bodies[min(number, len(self.bodies)) - 1]


class Retry(msgspec.Struct, frozen=True, kw_only=True):
    """A part that is tried again when it fails: `attempts` counts the first as well."""

    name: str
    part: Part
    attempts: int


class Timeout(msgspec.Struct, frozen=True, kw_only=True):
    """A part that fails with `timeout` when it takes longer [s]."""

    name: str
    part: Part
    limit_s: float


class OnFail(msgspec.Struct, frozen=True, kw_only=True):
    """A part, and what else to do when it fails, by failure code; "any" is for all others."""

    name: str
    part: Part
    handlers: tuple[tuple[str, Part], ...]


class Always(msgspec.Struct, frozen=True, kw_only=True):
    """A part, and what is done after it in any case; it ends as the first part ended."""

    name: str
    part: Part
    after: Part


class GiveUp(msgspec.Struct, frozen=True, kw_only=True):
    """Fails, and says why."""

    name: str
    cause: str
    code: str = "given_up"


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """One thing that should be so: in words, as a question, and what is so instead, in words.

    `looks` is what has to be looked at for the answer to be known.
    """

    text: str
    question: Predicate
    found: Words | None = None
    looks: tuple[Part, ...] = ()


class Expect(msgspec.Struct, frozen=True, kw_only=True):
    """Things that have to be so by now; fails with `not_as_expected` if one is not."""

    name: str
    findings: tuple[Finding, ...]


class Kept(msgspec.Struct, frozen=True, kw_only=True):
    """What the task put down stands there by its end, and what it took is held, or it fails.

    That is as far as is believed: `gone` is given where each thing was put (place ids by object
    id) and what was taken (object ids), and names those that are not there.
    """

    name: str
    gone: Callable[[Blackboard, Mapping[str, str], Collection[str]], Sequence[str]]


Part: TypeAlias = (
    Errand | Series | Branch | Settle | Each | Parallel | Loop | Retry | Timeout | OnFail | Always
    | GiveUp | Expect | Kept
)  # fmt: skip
"""Any part."""

Leaf: TypeAlias = Errand | GiveUp | Expect | Kept
Wrapper: TypeAlias = Retry | Timeout | OnFail | Always


def below(path: str, step: int | str) -> str:
    """The path of a step inside the part with a path."""
    return f"{path}.{step}" if path else str(step)


def of_round(path: str, number: int) -> str:
    """The path of a round of the loop with a path; the first is number 1."""
    return f"{path}#{number}"


def of_attempt(path: str, number: int) -> str:
    """The path of an attempt of the part with a path; the first has the path itself."""
    return path if number == 1 else f"{path}*{number}"


def of_any_attempt(path: str) -> str:
    """The path of a step as it is in the first attempt of whatever is tried again."""
    return re.sub(r"\*\d+", "", path)


def children(part: Part, path: str = "") -> Iterator[tuple[str, Part]]:
    """The parts inside a part with their paths; of a loop the first round of each body."""
    match part:
        case Series(parts=parts) | Parallel(parts=parts) | Each(parts=parts):
            yield from ((below(path, n + 1), child) for n, child in enumerate(parts))
        case Branch():
            if part.look is not None:
                yield below(path, "look"), part.look
            yield below(path, "then"), part.then
            yield below(path, "else"), part.otherwise
        case Settle():
            yield from ((below(path, n + 1), look) for n, look in enumerate(part.looks))
            yield below(path, "then"), part.likely
        case Loop():
            yield from ((of_round(path, n + 1), body) for n, body in enumerate(part.bodies))
        case Retry() | Timeout():
            yield path, part.part
        case OnFail():
            yield path, part.part
            for code, handler in part.handlers:
                yield below(path, code), handler
        case Always():
            yield path, part.part
            yield below(path, "always"), part.after
        case Errand() | GiveUp() | Expect() | Kept():
            return


def walk(
    part: Part, path: str = "", *, means: Mapping[str, tuple[str, ...]] | None = None
) -> Iterator[tuple[str, Part]]:
    """A part and all parts inside it with their paths, in reading order.

    What was settled already (`means`: the ids by the path) is what is done, others what is likely.
    """
    known = means or {}
    stack = [(path, part)]
    while stack:
        where, node = stack.pop()
        if isinstance(node, Settle) and where in known:
            node = msgspec.structs.replace(node, likely=node.then(known[where]))
        yield where, node
        stack += reversed(list(children(node, where)))


def errands(part: Part) -> Iterable[Errand]:
    """Every step of a skill that may be done."""
    return (node for _, node in walk(part) if isinstance(node, Errand))
