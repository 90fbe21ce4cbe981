"""The steps of a mission to parts: looked up, grounded and checked one by one, all before motion.

The scene follows what the steps so far will have put into the hands, so that "it" has a meaning and
no third thing is taken with two hands. A mistake ends one step, not the check.
"""

from __future__ import annotations

from math import floor

import msgspec
from msgspec.structs import replace

from executive.meaning.identify import CannotMean, Scene
from executive.meaning.tasks import in_turn, last_look, part_of
from executive.meaning.validation import check
from executive.missions import schema as s
from executive.missions.calling import Calls
from executive.missions.conditions import Conditions
from executive.missions.contradictions import contradicted
from executive.missions.least_times import LeastTimes
from executive.missions.load import Mission
from executive.missions.names import Names, NoNames
from executive.missions.problems import Problems
from executive.missions.reading import Reader
from executive.missions.slots import Slots
from executive.missions.values import Bound, Scope
from executive.skills.resources import conflicts, needed_by
from executive.trees import parts as p
from executive.trees.build import ANY
from intents import goals
from robot.failures import CATALOGUE
from robot.files.config import nearest
from robot.files.yaml_nodes import Node, text_node
from robot.model.description import RobotDescription

MAX_STEPS = 20_000

CODES = [ANY, *(code for code in CATALOGUE if code != "cancelled")]

Hands = tuple[tuple[str, ...], str | None]
"""What is held, and what was spoken of last."""


class Meant(msgspec.Struct, frozen=True, kw_only=True):
    """What a goal takes where the scene was in some state, and its state after that."""

    part: p.Part | None
    after: Hands
    problem: tuple[str, str] = ("", "")


class Compiler:
    """Compiles one mission and those that it calls, in one world."""

    def __init__(self, names: Names, description: RobotDescription, problems: Problems) -> None:
        """Note problems in `problems`."""
        self.names = names
        self.problems = problems
        self.scene = Scene(names.knowledge)
        self.calls = Calls(names, problems)
        self._description = description
        self._slots = Slots(names, problems)
        self._conditions = Conditions(names, problems)
        self._meant: dict[tuple[goals.Goal, Hands], Meant] = {}
        self._count = 0
        self._limits: list[tuple[p.Timeout, Node]] = []

    def note_limits(self, task: p.Part) -> None:
        """Note limits that are shorter than what they limit can take."""
        nodes = {id(part): node for part, node in self._limits}
        for limit, least_s in LeastTimes(self._description).too_short(task):
            takes = f"{floor(100.0 * least_s) / 100.0:g} s at least"
            text = f"{limit.limit_s:g} s: what is to be done takes {takes}"
            self.problems.add(nodes[id(limit)], text, "a longer limit, or less to do")

    # --- missions ---

    def mission(self, mission: Mission, bound: dict[str, Bound]) -> p.Part:
        """A mission with the values of its parameters."""
        with self.calls.inside(mission):
            return self._mission(mission, bound)

    def _mission(self, mission: Mission, bound: dict[str, Bound]) -> p.Part:
        record, node = mission.record, mission.node
        scope = Scope(bound, self.problems, wrong=mission.declared - bound.keys())
        steps = list(self.steps(record.steps, scope))
        findings = [
            self._conditions.read(item, scope, self.scene) for item in _items(node.get("expect"))
        ]
        good = tuple(finding for finding in findings if finding is not None)
        for item, other in contradicted(_items(node.get("expect")), self.names, self.scene):
            text = f"this and what is expected in line {other.line} are never both so"
            self.problems.add(item, text, "leave one of them out")
        if good:
            steps.append(p.Expect(name="expect", findings=good))
        if not self.calls.nested:
            steps += last_look(tuple(steps), self.names.knowledge)
        part: p.Part = p.Series(name=record.name, parts=tuple(steps))
        if record.limits.duration_s is not None:
            part = p.Timeout(name=record.name, part=part, limit_s=record.limits.duration_s)
            limits = node.get("limits")
            self._limits.append((part, (limits and limits.get("duration_s")) or node))
        if record.always:
            after = p.Series(name="always", parts=self.steps(record.always, scope))
            part = p.Always(name=record.name, part=part, after=after)
        return part

    # --- steps ---

    def steps(self, nodes: tuple[s.StepNode, ...] | list[Node], scope: Scope) -> tuple[p.Part, ...]:
        """Steps one after the other; those that are wrong are left out, and noted."""
        found = [self.step(node, scope) for node in nodes]  # pyright: ignore[reportArgumentType]
        return tuple(part for part in found if part is not None)

    def step(self, node: Node, scope: Scope) -> p.Part | None:
        """One step: a sentence, or a mapping."""
        self._count += 1
        if self._count > MAX_STEPS:
            cure = "fewer rounds, or a mission of its own"
            self.problems.add(node, f"more than {MAX_STEPS} steps, all rounds told apart", cure)
            self.problems.raise_any()
        if node.kind == "text":
            return self._sentence(node, scope)
        if node.kind == "list":
            self.problems.add(node, "a list where a step should be", "put it under do:")
            return None
        key = self._kind(node)
        if key is None:
            self._look_inside(node, scope)
            return None
        written = node
        record = Reader(self.problems, scope.fill).record(node, s.STEPS[key])
        if record is None:
            node = Reader(Problems(), scope.fill).readable(node, s.STEPS[key])
            record = Reader(Problems(), scope.fill).record(node, s.STEPS[key])
        if record is None:
            slots = written.get(key)
            if key in s.GOALS and slots is not None:
                self._slots.look(slots, scope.silent().fill)
            self._look_inside(node, scope)
            return None
        before = self._hands
        if key in s.GOALS:
            goal = self._slots.goal(key, record, node)
            part = None if goal is None else self._mean(goal, node.key(key))
        else:
            part = self._structure(record, node, scope)
        return self._dressed(part, record, node, scope, before)

    def _kind(self, node: Node) -> str | None:
        """The key that a step is known by."""
        found = [key for key in s.STEPS if key in node.entries]
        if not found:
            given = next((key for key in node.entries if key not in s.OPTIONS), "")
            cure = nearest(given, list(s.STEPS)) if given else f"one of {', '.join(s.STEPS)}"
            message = f"there is no step {given!r}" if given else "this step does nothing"
            self.problems.add(node.key(given), message, cure)
            return None
        second = next((key for key in found[1:] if key in s.GOALS or key in ("fail",)), None)
        if second is not None:
            text = f"a step does one thing: {found[0]!r} stands here already"
            self.problems.add(node.key(second), text, "begin another step with -")
            return None
        return found[0]

    def _look_inside(self, node: Node, scope: Scope) -> None:
        """Look for more mistakes inside a step that is wrong itself: conditions, and steps."""
        for key in ("if", "while"):
            if key in node.entries:
                self._conditions.read(node.entries[key][1], scope, self.scene)
        name = node.get("for_each")
        if name is not None:
            scope = scope.inside(name.text, None)
        for key in ("do", "then", "else", "always"):
            self.steps(_items(node.get(key)), scope)
        for branch in _items(node.get("parallel")):
            self.steps(branch.items if branch.kind == "list" else [branch], scope)

    def _dressed(
        self, part: p.Part | None, record: s.StepRecord, node: Node, scope: Scope, before: Hands
    ) -> p.Part | None:
        """A step with its options, the innermost first: retry, timeout, on_fail, always."""
        after = self._hands
        handlers = self._handlers(node, scope, before)
        self._hands = after
        always = self.steps(record.always, scope) if record.always is not None else ()
        if part is None:
            return None
        name = record.name or part.name
        if record.name is not None:
            part = replace(part, name=name)
        if record.retry is not None:
            part = p.Retry(name=name, part=part, attempts=int(record.retry) + 1)
        if record.timeout_s is not None:
            part = p.Timeout(name=name, part=part, limit_s=float(record.timeout_s))
            self._limits.append((part, node.get("timeout_s") or node))
        if handlers:
            part = p.OnFail(name=name, part=part, handlers=handlers)
        if always:
            after_it = p.Series(name="always", parts=always)
            part = p.Always(name=name, part=part, after=after_it)
        return part

    def _handlers(self, node: Node, scope: Scope, before: Hands) -> tuple[tuple[str, p.Part], ...]:
        """What is done by failure code; "any" comes last."""
        found: dict[str, p.Part] = {}
        handlers = node.get("on_fail")
        for code, (key, steps) in (handlers.entries if handlers else {}).items():
            if code not in CODES:
                self.problems.add(key, f"there is no failure code {code!r}", nearest(code, CODES))
            self._hands = before
            parts = self.steps(_items(steps), scope)
            found[code] = p.Series(name=f"on {code}", parts=parts)
        return tuple(sorted(found.items(), key=lambda item: item[0] == ANY))

    # --- goals ---

    def _sentence(self, node: Node, scope: Scope) -> p.Part | None:
        filled = scope.fill_words(node)
        found = None if filled is None else self.names.sentence(filled, self.problems)
        if filled is None or found is None:
            return None
        parts = [self._mean(goal, node) for goal in found]
        good = tuple(part for part in parts if part is not None)
        if len(good) == 1:
            return good[0]
        return p.Series(name=filled.text, parts=good) if good else None

    def _mean(self, goal: goals.Goal, node: Node) -> p.Part | None:
        """What a goal takes; equal goals in equal states of the scene are looked up once."""
        key = (goal, self._hands)
        meant = self._meant.get(key)
        if meant is None:
            meant = self._meant[key] = self._ground(goal)
        self._hands = meant.after
        if meant.problem[0]:
            self.problems.add(node, *meant.problem)
        return meant.part

    def _ground(self, goal: goals.Goal) -> Meant:
        if isinstance(self.names, NoNames):
            return Meant(part=None, after=self._hands)
        scene = self.scene
        try:
            part = part_of(goal, scene)
        except CannotMean as end:
            problem = (end.failure.cause, end.failure.suggestion)
            return Meant(part=None, after=self._hands, problem=problem)
        refusal = check(part, scene.knowledge.map, self._description)
        problem = (refusal.cause, refusal.suggestion) if refusal else ("", "")
        return Meant(part=part, after=self._hands, problem=problem)

    @property
    def _hands(self) -> Hands:
        return tuple(self.scene.held), self.scene.spoken_of

    @_hands.setter
    def _hands(self, hands: Hands) -> None:
        self.scene.held = list(hands[0])
        self.scene.spoken_of = hands[1]

    # --- structure ---

    def _structure(self, record: s.StepRecord, node: Node, scope: Scope) -> p.Part | None:
        """The part of a step that holds other steps."""
        match record:
            case s.DoStep():
                return p.Series(name="do", parts=self.steps(record.do, scope))
            case s.ParallelStep():
                return self._parallel(node, scope)
            case s.IfStep():
                return self._if(record, node, scope)
            case s.RepeatStep():
                return self._repeat(record, scope)
            case s.WhileStep():
                return self._while(record, node, scope)
            case s.ForEachStep():
                return self._for_each(record, node, scope)
            case s.MissionStep():
                return self._call(record, node, scope)
            case s.FailStep():
                return p.GiveUp(name="give up", cause=record.fail)
            case _:
                raise TypeError(f"no structure: {type(record).__name__}")

    def _parallel(self, node: Node, scope: Scope) -> p.Part:
        branches: list[p.Part] = []
        nodes: list[Node] = _items(node.get("parallel"))
        for branch in nodes:
            steps = branch.items if branch.kind == "list" else [branch]
            parts = self.steps(steps, scope)
            one = parts[0] if len(parts) == 1 else p.Series(name="branch", parts=parts)
            branches.append(one)
        needs = [needed_by(errand.params for errand in p.errands(part)) for part in branches]
        for number, branch in enumerate(nodes):
            both = conflicts([*needs[:number], needs[number]]) & needs[number]
            if both:
                other = next(n for n in range(number) if needs[n] & both)
                text = f"this branch and the one in line {nodes[other].line} both need: "
                words = ", ".join(sorted(both)).replace("_", " ")
                self.problems.add(branch, text + words, "do one after the other")
        return p.Parallel(name="at the same time", parts=tuple(branches))

    def _if(self, record: s.IfStep, node: Node, scope: Scope) -> p.Part | None:
        finding = self._conditions.read(node.entries["if"][1], scope, self.scene)
        before = self._hands
        then = p.Series(name="then", parts=self.steps(record.then, scope))
        after = self._hands
        self._hands = before
        otherwise = p.Series(name="else", parts=self.steps(record.else_, scope))
        self._hands = _common(after, self._hands)
        if finding is None:
            return None
        name = f"if {finding.text}"
        return p.Branch(
            name=name,
            question=finding.question,
            then=then,
            otherwise=otherwise,
            look=in_turn(finding.looks),
        )

    def _repeat(self, record: s.RepeatStep, scope: Scope) -> p.Part:
        times = int(record.repeat)
        bodies = self._bodies(record.do, scope, times)
        return p.Loop(name="once" if times == 1 else f"{times} times", bodies=bodies, at_most=times)

    def _while(self, record: s.WhileStep, node: Node, scope: Scope) -> p.Part | None:
        finding = self._conditions.read(node.entries["while"][1], scope, self.scene)
        at_most = int(record.at_most)
        before = self._hands
        bodies = self._bodies(record.do, scope, at_most)
        self._hands = _common(before, self._hands)
        if finding is None:
            return None
        looks = tuple(  # of places that are named
            look for look in finding.looks if not isinstance(look, p.Errand) or look.object_name
        )
        loop = p.Loop(
            name=f"while {finding.text}",
            bodies=tuple(_and_then(body, looks) for body in bodies),
            at_most=at_most,
            question=finding.question,
        )
        return p.Series(name=loop.name, parts=(*looks, loop)) if looks else loop

    def _bodies(self, steps: s.Steps, scope: Scope, times: int) -> tuple[p.Series, ...]:
        """The rounds of a loop, until one begins with the hands as the one before began."""
        bodies: list[p.Series] = []
        before: Hands | None = None
        while len(bodies) < min(times, 4) and before != self._hands:
            before = self._hands
            parts = self.steps(steps, scope)
            bodies.append(p.Series(name=f"round {len(bodies) + 1}", parts=parts))
        return tuple(bodies)

    def _for_each(self, record: s.ForEachStep, node: Node, scope: Scope) -> p.Part | None:
        items = self.each(record, node.entries["in"][1])
        rounds: list[p.Part] = []
        for value in items:
            inside = scope.inside(record.for_each, value)
            parts = self.steps(record.do, inside)
            rounds.append(p.Series(name=f"with {value.value}", parts=parts))
        if not items:
            self.steps(record.do, scope.inside(record.for_each, None))
        name = f"for each {record.for_each}{'' if rounds else ', of which there is none'}"
        return p.Series(name=name, parts=tuple(rounds))

    def each(self, record: s.ForEachStep, node: Node) -> list[Bound]:
        """The things of a for_each, by name."""
        if isinstance(record.in_, str):
            return self._described(text_node(record.in_, node))
        found: list[Bound] = []
        for number, text in enumerate(record.in_):
            item = text_node(text, node.items[number] if node.items else node)
            if self.names.is_place(text):
                found.append(Bound(type="place", value=text))
            elif self.names.is_person(text):
                found.append(Bound(type="person", value=text))
            elif self.names.member(item, self.problems) is not None:
                found.append(Bound(type="object", value=text))
        return found

    def _described(self, node: Node) -> list[Bound]:
        query = self.names.object(node, self.problems)
        if query is None:
            return []
        try:
            infos = self.scene.objects(replace(query, count=query.count or "all"))
        except CannotMean as end:
            self.problems.add(node, end.failure.cause, end.failure.suggestion)
            return []
        return [Bound(type="object", value=info.name) for info in infos]

    def _call(self, record: s.MissionStep, node: Node, scope: Scope) -> p.Part | None:
        where = text_node(record.mission, node.entries["mission"][1])
        called = self.calls.called(where)
        if called is None:
            return None
        bound = self.calls.arguments(called, node, scope, where)
        return self.mission(called, bound)


def _items(node: Node | None) -> list[Node]:
    """The items of a list, or nothing."""
    return node.items if node is not None and node.kind == "list" else []


def _and_then(body: p.Series, looks: tuple[p.Part, ...]) -> p.Series:
    """A round that ends with the looks that decide on the next one."""
    return replace(body, parts=(*body.parts, *looks))


def _common(one: Hands, other: Hands) -> Hands:
    """What is held in both cases."""
    held = tuple(object_id for object_id in one[0] if object_id in other[0])
    return held, one[1] if one[1] == other[1] else (held[-1] if held else None)
