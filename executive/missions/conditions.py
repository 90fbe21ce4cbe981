"""Conditions of a mission to questions that are asked of the blackboard when their turn comes."""

from __future__ import annotations

from collections.abc import Callable

from executive.behaviours.conditions import Predicate
from executive.blackboard import HELD, WORLD, Blackboard
from executive.meaning.identify import CannotMean, Scene
from executive.meaning.tasks import look_of, question_of
from executive.missions import schema as s
from executive.missions.names import Names
from executive.missions.problems import Problems
from executive.missions.reading import Reader
from executive.missions.values import Scope
from executive.trees.parts import Finding, Words
from intents import goals
from robot.files.yaml_nodes import Node, text_node
from robot.messages import ObjectInfo, Place
from robot.se3 import SE3

NEAR_M = 0.9
"""How far from the edge of a piece of furniture the robot stands when it is "at" it."""


class Conditions:
    """Makes questions of conditions."""

    def __init__(self, names: Names, problems: Problems) -> None:
        """Look texts up in `names`; what is wrong goes to `problems`."""
        self._names = names
        self._problems = problems

    def read(self, node: Node, scope: Scope, scene: Scene) -> Finding | None:
        """The question of a condition; None if it means nothing, which is noted."""
        if node.kind == "text":
            return self._sentence(node, scope, scene)
        record = Reader(self._problems, scope.fill).record(node, s.ConditionRecord)
        return None if record is None else self._record(record, node, scope, scene)

    def _sentence(self, node: Node, scope: Scope, scene: Scene) -> Finding | None:
        filled = scope.fill_words(node)
        if filled is None:
            return None
        condition = self._names.condition(filled, self._problems)
        if condition is None:
            return None
        return self._known(condition, filled, scene, text=filled.text)

    def _known(
        self, condition: goals.Condition, node: Node, scene: Scene, *, text: str
    ) -> Finding | None:
        """A condition in the form of the goals."""
        try:
            question, looks = question_of(condition, scene), look_of(condition, scene)
        except CannotMean as end:
            self._problems.add(node, end.failure.cause, end.failure.suggestion)
            return None
        found = [self._instead(one, scene) for one in goals.simple_conditions(condition)]
        known = [words for words in found if words is not None]
        if len(known) != len(found):
            self._problems.add(node, f"{text!r} names nothing in this world", "name an object")
            return None
        return Finding(text=text, question=question, found=_all_words(known), looks=looks)

    def _instead(self, condition: goals.Simple, scene: Scene) -> Words | None:
        """What is so instead of a condition, in words; None if it is about nothing here."""
        query = None if isinstance(condition, goals.State) else condition.object
        infos = scene.fitting(query) if query is not None else []
        if not infos:
            return None
        return self._hands if isinstance(condition, goals.Holding) else self._whereabouts(infos)

    def _record(
        self, record: s.ConditionRecord, node: Node, scope: Scope, scene: Scene
    ) -> Finding | None:
        kinds = ("seen", "holding", "robot_at", "not", "all", "any")
        given = [kind for kind in kinds if kind in node.entries]
        if len(given) != 1:
            text = f"exactly one of {', '.join(kinds)} should stand here"
            self._problems.add(node, text, f"given: {', '.join(given) or 'none'}")
        if record.on is not None and "seen" not in given:
            self._problems.add(node.key("on"), "'on' belongs to 'seen'", "leave it out")
        found = [self._of_kind(kind, record, node, scope, scene) for kind in given]
        alone = len(given) == 1 and (record.on is None or "seen" in given)
        return found[0] if alone else None

    def _of_kind(
        self, kind: str, record: s.ConditionRecord, node: Node, scope: Scope, scene: Scene
    ) -> Finding | None:
        value = node.entries[kind][1]
        match kind:
            case "seen":
                return self._seen(record, node, scene)
            case "holding":
                return self._holding(record.holding, value, scene)
            case "robot_at":
                return self._robot_at(text_node(record.robot_at or "", value))
            case "not":
                return self._negated(value, scope, scene)
            case _:
                return self._joined(kind, value, scope, scene)

    def _seen(self, record: s.ConditionRecord, node: Node, scene: Scene) -> Finding | None:
        where = text_node(record.seen or "", node.entries["seen"][1])
        query = self._names.object(where, self._problems)
        place = ""
        if record.on is not None:
            place = self._names.place(text_node(record.on, node.entries["on"][1]), self._problems)
        if query is None or place is None:
            return None
        text = f"the {record.seen} is seen"
        if place:
            query = goals.ObjectQuery(
                name=query.name, category=query.category, color=query.color, size=query.size,
                superlative=query.superlative, at=place, held=query.held,
            )  # fmt: skip
            text = f"the {record.seen} is on the {place}"
        return self._known(goals.Present(object=query), where, scene, text=text)

    def _holding(self, wanted: str | bool | None, node: Node, scene: Scene) -> Finding | None:
        if isinstance(wanted, bool):
            text = "something is held" if wanted else "the hands are empty"

            def asked(board: Blackboard) -> bool:
                return bool(board.read(HELD)) is wanted

            return Finding(text=text, question=asked, found=self._hands)
        query = self._names.object(text_node(str(wanted), node), self._problems)
        if query is None:
            return None
        text = f"the {wanted} is held"
        return self._known(goals.Holding(object=query), node, scene, text=text)

    def _robot_at(self, node: Node) -> Finding | None:
        name = self._names.place(node, self._problems)
        if name is None:
            return None
        places = self._names.knowledge.places(name)

        def asked(board: Blackboard) -> bool:
            world = board.read(WORLD)
            return world is not None and any(_at(world.X_WB.p, place) for place in places)

        return Finding(text=f"the robot is at the {name}", question=asked, found=_position)

    def _negated(self, node: Node, scope: Scope, scene: Scene) -> Finding | None:
        inner = self.read(node, scope, scene)
        if inner is None:
            return None
        question = inner.question
        return Finding(
            text=f"not: {inner.text}",
            question=lambda board: not question(board),
            found=inner.found,
            looks=inner.looks,
        )

    def _joined(self, kind: str, node: Node, scope: Scope, scene: Scene) -> Finding | None:
        if not node.items:
            self._problems.add(node, f"{kind!r} should hold a list of conditions", "fill it")
            return None
        inner = [self.read(item, scope, scene) for item in node.items]
        good = [finding for finding in inner if finding is not None]
        if len(good) != len(inner):
            return None
        join: Callable[..., bool] = all if kind == "all" else any
        questions: list[Predicate] = [finding.question for finding in good]
        word = " and " if kind == "all" else " or "
        return Finding(
            text=word.join(finding.text for finding in good),
            question=lambda board: join(question(board) for question in questions),
            found=_all_words([finding.found for finding in good if finding.found]),
            looks=tuple(look for finding in good for look in finding.looks),
        )

    # --- what is so instead, in words ---

    def _hands(self, board: Blackboard) -> str:
        held = board.read(HELD).values()
        infos = [self._names.knowledge.object(object_id) for object_id in held]
        names = " and ".join(info.full_name for info in infos if info is not None)
        return f"the robot holds {names or 'nothing'}"

    def _whereabouts(self, infos: list[ObjectInfo]) -> Words:
        """Where objects are believed to be."""
        knowledge = self._names.knowledge

        def words(board: Blackboard) -> str:
            world = board.read(WORLD)
            tracks = {track.id: track for track in world.tracks} if world else {}
            said: list[str] = []
            for info in infos:
                track = tracks.get(info.id)
                name = info.full_name
                if info.id in board.read(HELD).values():
                    said.append(f"{name} is in the hand")
                elif track is None or track.X_WO is None or track.missing:
                    said.append(f"{name} was not seen")
                else:
                    surface = knowledge.surface_under(track.X_WO)
                    x, y, z = track.X_WO.p
                    where = (
                        f"on the {surface.name}" if surface else f"at ({x:.2f}, {y:.2f}, {z:.2f})"
                    )
                    said.append(f"{name} is {where}")
            return ", ".join(said)

        return words


def _at(p_WB: tuple[float, float, float], place: Place) -> bool:
    """Whether the robot is in a room or on a spot, or within `NEAR_M` of furniture."""
    x, y, _ = (place.X_WP.inverse() @ SE3(p_WB)).p
    margin_m = 0.0 if place.floor else NEAR_M
    half_x, half_y = 0.5 * place.size_m[0] + margin_m, 0.5 * place.size_m[1] + margin_m
    return abs(x) <= half_x and abs(y) <= half_y


def _position(board: Blackboard) -> str:
    world = board.read(WORLD)
    if world is None:
        return "the robot does not know where it is"
    x, y, _ = world.X_WB.p
    return f"the robot is at ({x:.2f}, {y:.2f}) m"


def _all_words(several: list[Words]) -> Words:
    return lambda board: "; ".join(dict.fromkeys(words(board) for words in several))
