"""The tree of a part, and which of its steps are done already."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from py_trees.behaviour import Behaviour
from py_trees.common import OneShotPolicy, ParallelPolicy
from py_trees.composites import Parallel as SideBySide
from py_trees.composites import Selector
from py_trees.composites import Sequence as InOrder
from py_trees.decorators import FailureIsSuccess, OneShot

from executive.behaviours.stage import Stage
from executive.trees import parts as p
from executive.trees.each import each
from executive.trees.flow import (
    Again,
    AsItEnded,
    Caught,
    Compare,
    Deadline,
    Fails,
    Finished,
    Matches,
    Round,
)
from executive.trees.idioms import either, in_order, once
from executive.trees.recovery import resilient
from executive.trees.settling import Settling
from executive.trees.standing import IsAsLeft
from robot.failures import failure

ANY = "any"
"""In `OnFail`: any code that has no handler of its own."""

Done = frozenset[str]
_IS = "?is="
"""In `Done`: between the path of a settling and what it found out."""


def build(part: p.Part, stage: Stage, *, path: str = "", done: Done = frozenset()) -> Behaviour:  # noqa: PLR0912 - one line a kind
    """The tree of a part.

    Args:
        part: what is to be done.
        stage: shared by all leaves.
        path: of the part in its task.
        done: what was done before and becomes a finished leaf: steps by their path, whole parts by
            their path with a `/`; how a branch was taken, as in `2?then`, what a description was
            settled to mean, as in `2?is=red_cup,blue_cup`, and which attempts were begun, as in
            `2*2?again`. Made by `finished` from a journal and by `before` from a path.
    """
    if f"{path}/" in done or (path in done and isinstance(part, p.Leaf)):
        return Finished(part.name)
    match part:
        case p.Errand():
            return resilient(part, stage, path=path)
        case p.Series():
            return in_order(part.name, _inside(part, stage, path, done))
        case p.Branch():
            return _branch(part, stage, path, done)
        case p.Settle():
            return _settle(part, stage, path, done)
        case p.Each():
            return each(part, _inside(part, stage, path, done), stage=stage, path=path)
        case p.Parallel():
            return _side_by_side(part, stage, path, done)
        case p.Loop():
            return _loop(part, stage, path, done)
        case p.Retry():
            return _retry(part, stage, path, done)
        case p.Timeout():
            return _timeout(part, stage, path, done)
        case p.OnFail():
            return _on_fail(part, stage, path, done)
        case p.Always():
            return _always(part, stage, path, done)
        case p.GiveUp():
            return Fails(part.name, failure(part.code, part.cause), stage=stage, path=path)
        case p.Expect():
            return Compare(part.name, part.findings, stage=stage, path=path)
        case p.Kept():
            return IsAsLeft(part, stage=stage, path=path)


def _inside(part: p.Part, stage: Stage, path: str, done: Done) -> list[Behaviour]:
    return [build(child, stage, path=at, done=done) for at, child in p.children(part, path)]


def _branch(part: p.Branch, stage: Stage, path: str, done: Done) -> Behaviour:
    *look, then, otherwise = _inside(part, stage, path, done)
    question = _remembered(part, stage, path, done)
    choice = either(part.name, question, then=then, otherwise=otherwise, board=stage.board)
    decided = {f"{path}?then", f"{path}?else"} & done
    return in_order(part.name, [*look, choice]) if look and not decided else choice


def _remembered(part: p.Branch, stage: Stage, path: str, done: Done) -> p.Predicate:
    """The branch's question, or the answer it was given in an earlier run."""
    known = {answer for answer in ("then", "else") if f"{path}?{answer}" in done}

    def ask(board: p.Blackboard) -> bool:
        yes = "then" in known if known else part.question(board)
        stage.record("branch", id=path, step=part.name, took="then" if yes else "else")
        return yes

    return ask


def _settle(part: p.Settle, stage: Stage, path: str, done: Done) -> Behaviour:
    looks = [
        once(build(look, stage, path=p.below(path, n + 1), done=done))
        for n, look in enumerate(part.looks)
    ]

    def then(ids: tuple[str, ...]) -> Behaviour:
        return once(build(part.then(ids), stage, path=p.below(path, "then"), done=done))

    known = meanings(done).get(path)
    if known is not None:  # as it was settled in an earlier run
        return then(known)
    first = Settling(part, looks, then=then, stage=stage, path=path)
    return InOrder(part.name, memory=True, children=[first])


def _side_by_side(part: p.Parallel, stage: Stage, path: str, done: Done) -> Behaviour:
    policy = ParallelPolicy.SuccessOnAll(synchronise=False)
    nodes = [once(node) for node in _inside(part, stage, path, done)]
    return SideBySide(part.name, policy=policy, children=nodes)


def _loop(part: p.Loop, stage: Stage, path: str, done: Done) -> Behaviour:
    def make(number: int) -> Behaviour:
        body = part.body(number)
        return once(build(body, stage, path=p.of_round(path, number), done=done))

    def passed(number: int) -> bool:
        at = p.of_round(path, number)
        return any(
            entry == at or entry.startswith(tuple(at + mark for mark in ".?#/*")) for entry in done
        )

    first = Round(part, 1, make=make, stage=stage, passed=passed)
    return InOrder(part.name, memory=True, children=[first])


def _retry(part: p.Retry, stage: Stage, path: str, done: Done) -> Behaviour:
    def make(number: int) -> Behaviour:
        attempt = build(part.part, stage, path=p.of_attempt(path, number), done=done)
        return _settled(attempt)

    begun = (n for n in range(2, part.attempts + 1) if f"{p.of_attempt(path, n)}?again" in done)
    first = max(begun, default=1)
    again = Again(part, first + 1, make=make, stage=stage, path=path)
    return Selector(part.name, memory=True, children=[make(first), again])


def _settled(node: Behaviour) -> Behaviour:
    """A node that, once it ended, is not run again, however it ended."""
    return OneShot(node.name, node, policy=OneShotPolicy.ON_COMPLETION)


def _timeout(part: p.Timeout, stage: Stage, path: str, done: Done) -> Behaviour:
    work = _settled(build(part.part, stage, path=path, done=done))
    clock = Deadline(part.name, part.limit_s, stage=stage, path=path)
    policy = ParallelPolicy.SuccessOnSelected([work], synchronise=False)
    return SideBySide(part.name, policy=policy, children=[work, clock])


def _on_fail(part: p.OnFail, stage: Stage, path: str, done: Done) -> Behaviour:
    work, *handlers = _inside(part, stage, path, done)
    caught = Caught(stage=stage)
    codes = frozenset(code for code, _ in part.handlers)
    ways: list[Behaviour] = []
    for (code, _), handler in zip(part.handlers, handlers, strict=True):
        if code == ANY:
            check = Matches("any other failure?", caught, lambda found: found not in codes)
        else:
            check = Matches(f"{code}?", caught, lambda found, code=code: found == code)
        ways.append(InOrder(f"on {code}", memory=True, children=[check, _settled(handler)]))
    cure = InOrder(
        "on failure",
        memory=True,
        children=[caught, Selector("which?", memory=True, children=ways)],
    )
    return Selector(part.name, memory=True, children=[_settled(work), cure])


def _always(part: p.Always, stage: Stage, path: str, done: Done) -> Behaviour:
    work, after = _inside(part, stage, path, done)
    work = _settled(work)
    caught = Caught(stage=stage, result=lambda: work.status)
    steps: list[Behaviour] = [
        FailureIsSuccess(part.name, work),
        caught,
        FailureIsSuccess("always", _settled(after)),
        AsItEnded(caught, stage=stage),
    ]
    return InOrder(part.name, memory=True, children=steps)


def finished(events: Iterable[Mapping[str, object]]) -> Done:
    """What a journal's events say is done, in the form that `build` takes.

    Args:
        events: lines of a journal as mappings; "done", "branch", "settled" and "again" are looked
            at.
    """
    found: set[str] = set()
    for event in events:
        path = str(event.get("id", ""))
        if event.get("event") == "done" and path:
            step = re.sub(r"\+\d+$", "", path)
            if "+" not in step:  # a step of a recovery is none of the task's own
                found.add(step)
        elif event.get("event") == "branch" and path:
            found.add(f"{path}?{event.get('took')}")
        elif event.get("event") == "again" and path:
            found.add(f"{path}?again")
        elif event.get("event") == "settled" and path:
            found.add(f"{path}{_IS}{event.get('means')}")
    return frozenset(found)


def meanings(done: Done) -> dict[str, tuple[str, ...]]:
    """What descriptions were settled to mean: ids by the path of the settling."""
    found = (entry.split(_IS, 1) for entry in done if _IS in entry)
    return {path: tuple(ids.split(",")) for path, ids in found}


def before(part: p.Part, path: str) -> Done | None:
    """Everything that comes before the step with a path, as done; None if there is no such step.

    Loops are entered at the round of the path, branches on its side.
    """
    done: set[str] = set()
    at, node = "", part
    while at != path:
        inside = _towards(node, at, path)
        if inside is None:
            return None
        passed, (at, node) = inside
        done.update(passed)
    return frozenset(done)


def _towards(node: p.Part, at: str, path: str) -> tuple[list[str], tuple[str, p.Part]] | None:
    """One step down from a part towards a path: what comes before it, and the step."""
    if isinstance(node, p.Loop):
        number = re.match(re.escape(f"{at}#") + r"(\d+)(?=[.?#]|$)", path)
        if number is None or not 1 <= int(number[1]) <= node.at_most:
            return None
        last = int(number[1])
        rounds = [f"{p.of_round(at, n)}/" for n in range(1, last)]
        return [*rounds, f"{p.of_round(at, last)}?"], (p.of_round(at, last), node.body(last))
    passed: list[str] = []
    for where, child in p.children(node, at):
        if where == at and isinstance(node, p.Wrapper):
            if path == at or _towards(child, at, path) is not None:
                return [], (at, child)
            passed += _all_of(child, at)
            continue
        if path == where or path.startswith((f"{where}.", f"{where}#")):
            if isinstance(node, p.Branch) and child is not node.look:
                return [f"{at}?{where.rpartition('.')[2]}"], (where, child)
            return ([] if isinstance(node, p.Parallel) else passed), (where, child)
        passed.append(f"{where}/")
    return None


def _all_of(part: p.Part, at: str) -> list[str]:
    """What is in `done` when a part that shares its path with a wrapper is done."""
    if isinstance(part, p.Leaf):
        return [at]
    if isinstance(part, p.Wrapper):
        return _all_of(part.part, at)
    if isinstance(part, p.Loop):
        return [f"{p.of_round(at, n + 1)}/" for n in range(part.at_most)]
    taken = [f"{at}?then"] if isinstance(part, p.Branch) else []
    return [*taken, *(f"{where}/" for where, _ in p.children(part, at))]
