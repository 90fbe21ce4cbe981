"""What the texts of a mission mean in its world: things, places, people, sentences, conditions.

Every text is looked up once and remembered, so that long missions are checked fast.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from executive.meaning.knowledge import Knowledge
from executive.missions import steering_words
from executive.missions.problems import Problems
from intents import goals, parser
from intents.context import Context
from intents.outcomes import Goals, Question
from robot.errors import Problem
from robot.files.config import nearest
from robot.files.yaml_nodes import Node

T = TypeVar("T")

MAX_SENTENCES = 2000
"""Different sentences in one mission: understanding takes about a third of a millisecond each."""

_ARTICLES = ("the ", "a ", "an ", "all ", "both ", "every ", "any ", "some ", "two ", "three ")
IT = goals.ObjectQuery(held=True)


class Wrong(Exception):
    """A text means nothing here: what is wrong, and the cure. Never leaves the lookup."""

    def __init__(self, message: str, cure: str = "") -> None:
        """Carry both."""
        super().__init__(message)
        self.message, self.cure = message, cure


class Names:
    """Looks texts up in one world."""

    def __init__(self, knowledge: Knowledge) -> None:
        """Know the names of `knowledge`."""
        self.knowledge = knowledge
        self._vocabulary = knowledge.vocabulary()
        self._context = Context(entities=knowledge.entities())
        self._known: dict[tuple[str, str], object] = {}
        self._reasons: dict[str, str] = {}
        self._notes: dict[Problem, None] = {}
        self._sentences = 0

    @property
    def notes(self) -> tuple[Problem, ...]:
        """What was taken for something else than is written: words that are misspelt."""
        return tuple(self._notes)

    def object(self, node: Node, problems: Problems) -> goals.ObjectQuery | None:
        """The description of an object (or of several)."""
        return self._look_up("object", self._object, node, problems)

    def member(self, node: Node, problems: Problems) -> goals.ObjectQuery | None:
        """An object of a list in which places and people may stand, too."""
        return self._look_up("member", self._member, node, problems)

    def place(self, node: Node, problems: Problems) -> str | None:
        """The name of a place."""
        return self._look_up("place", self._place, node, problems)

    def person(self, node: Node, problems: Problems) -> goals.Person | None:
        """A person by name."""
        return self._look_up("person", self._person, node, problems)

    def sample(self, kind: str) -> str | None:
        """Something that fits a type of parameter, for a check without values."""
        world = self.knowledge.map
        surfaces = [place.name for place in world.places if not place.floor]
        plain = {"text": "text", "number": "1.0", "integer": "1", "flag": "true"}
        if kind in plain:
            return plain[kind]
        several = {
            "object": [info.name for info in world.objects],
            "place": surfaces,
            "person": [person.name for person in world.people],
        }.get(kind, [])
        return several[0] if several else None

    def is_place(self, text: str) -> bool:
        """Whether a place is called so."""
        return bool(self.knowledge.places(text.removeprefix("the ")))

    def is_person(self, text: str) -> bool:
        """Whether a person is called so."""
        return text in ("me", "operator") or self.knowledge.person(text) is not None

    def text(self, node: Node, _problems: Problems) -> str | None:
        """Any text."""
        return node.text

    def sentence(self, node: Node, problems: Problems) -> tuple[goals.Goal, ...] | None:
        """The goals of a sentence."""
        return self._look_up("sentence", self._sentence, node, problems)

    def condition(self, node: Node, problems: Problems) -> goals.Condition | None:
        """The condition that a sentence states."""
        return self._look_up("condition", self._condition, node, problems)

    def _look_up(
        self, kind: str, look: Callable[[str], T], node: Node, problems: Problems
    ) -> T | None:
        """What a text means, out of memory where it was asked before."""
        key = (kind, node.text)
        found = self._known.get(key)
        if found is None:
            try:
                found = look(node.text)
            except Wrong as wrong:
                found = wrong
            self._known[key] = found
        if isinstance(found, Wrong):
            problems.add(node, found.message, found.cure)
            return None
        if kind in ("sentence", "condition") and node.text in self._reasons:
            self._notes[node.problem(self._reasons[node.text])] = None
        return found  # pyright: ignore[reportReturnType]

    def _object(self, text: str) -> goals.ObjectQuery:
        found = self._described(text)
        if found is None:
            raise Wrong(
                f"there is no object {text!r} in this world", _nearest(text, self._things())
            )
        return found

    def _member(self, text: str) -> goals.ObjectQuery:
        found = self._described(text)
        if found is None:
            world = self.knowledge.map
            names = {*self._things(), *(one.name for one in (*world.places, *world.people))}
            what = f"there is no thing, place or person {text!r} in this world"
            raise Wrong(what, _nearest(text, sorted(names)))
        return found

    def _described(self, text: str) -> goals.ObjectQuery | None:
        """The description of an object, or None if no thing of this world is called so."""
        wanted = " ".join(text.split())
        if wanted.casefold() in ("it", "them"):
            return IT
        for info in self.knowledge.map.objects:
            if wanted in (info.id, info.name):
                return goals.ObjectQuery(name=info.id)
        article = "" if wanted.casefold().startswith(_ARTICLES) else "the "
        outcome = parser.parse(
            f"pick up {article}{wanted}", self._vocabulary, context=self._context
        )
        if isinstance(outcome, Goals) and len(outcome.goals) == 1 and not outcome.reason:
            goal = outcome.goals[0]
            if isinstance(goal, goals.Pick):
                return goal.object
        if isinstance(outcome, Question) and outcome.choices:  # else it was not even heard of
            raise Wrong(f"{text!r} is not clear", outcome.question)
        return None

    def _things(self) -> list[str]:
        return [info.full_name.removeprefix("the ") for info in self.knowledge.map.objects]

    def _place(self, text: str) -> str:
        wanted = " ".join(text.split()).removeprefix("the ")
        if self.knowledge.places(wanted):
            return wanted
        names = sorted({place.name for place in self.knowledge.map.places})
        raise Wrong(f"there is no place {text!r} in this world", _nearest(wanted, names))

    def _person(self, text: str) -> goals.Person:
        if text.casefold() in ("me", "operator"):
            return goals.Person(who="operator")
        if self.knowledge.person(text) is not None:
            return goals.Person(name=text)
        names = [person.name for person in self.knowledge.map.people]
        raise Wrong(f"there is nobody called {text!r} in this world", _nearest(text, names))

    def _sentence(self, text: str) -> tuple[goals.Goal, ...]:
        self._sentences += 1
        if self._sentences > MAX_SENTENCES:
            text = f"more than {MAX_SENTENCES} different sentences"
            raise Wrong(text, "use parameters, or split it into missions that call one another")
        outcome = parser.parse(text, self._vocabulary, context=self._context)
        if isinstance(outcome, Goals):
            if wrong := steering_words.problem(outcome.goals):
                raise Wrong(*wrong)
            if outcome.reason:
                self._reasons[text] = outcome.reason
            return outcome.goals
        if isinstance(outcome, Question):
            raise Wrong(f"this sentence leaves a question open: {outcome.question}", "say which")
        cure = "" if "nearest" in outcome.reason else self._hint(text)
        raise Wrong(f"this sentence was not understood: {outcome.reason}", cure)

    def _condition(self, text: str) -> goals.Condition:
        said = " ".join(text.split()).removeprefix("if ").rstrip(".")
        order = f"if {said}, squat"  # whatever needs no words of its own
        try:
            found = self._sentence(order)
        except Wrong as wrong:
            raise self._no_condition(text, wrong.message.replace(f"{said}, squat", said)) from None
        if order in self._reasons:
            self._reasons[text] = self._reasons[order]
        squat = (goals.Balance(mode="squat"),)
        if len(found) == 1 and isinstance(found[0], goals.If) and found[0].then == squat:
            return found[0].condition
        raise self._no_condition(text, "")

    def _no_condition(self, text: str, why: str) -> Wrong:
        """What is wrong with a text that says of nothing whether it is so."""
        outcome = parser.parse(text, self._vocabulary, context=self._context)
        if isinstance(outcome, Goals):
            whither = (goal.place for goal in outcome.goals if isinstance(goal, goals.GoTo))
            place = next((place for place in whither if place), "table")
            cure = f"say what is so then: the red cup is on the table, or {{robot_at: {place}}}"
            return Wrong(f"{text!r} is no condition: it is something to do", cure)
        return Wrong(why or f"{text!r} is no condition", "for example: the red cup is on the table")

    def _hint(self, text: str) -> str:
        """A cure for a sentence: what skill it may have meant."""
        first = text.split(maxsplit=1)[0].casefold() if text.split() else ""
        verbs = ["go", "walk", "find", "pick", "put", "bring", "look", "say", "greet", "wait",
                 "count", "squat", "stand", "turn", "place", "meet", "tell", "repeat",
                 "if"]  # fmt: skip
        if first not in verbs:
            return _nearest(first, verbs)
        return "say it another way, or as a goal: {bring: {object: ..., to: ...}}"


def _nearest(name: str, valid: list[str]) -> str:
    return nearest(name, valid) if valid else "there are none in this world"


class NoNames(Names):
    """Knows nothing and notes nothing: for what needs no world, where there is none to ask."""

    def is_place(self, text: str) -> bool:
        """Nobody knows."""
        del text
        return False

    def is_person(self, text: str) -> bool:
        """Nobody knows."""
        del text
        return False

    def sample(self, kind: str) -> str | None:
        """Nothing fits, but numbers."""
        return super().sample(kind) if kind in ("text", "number", "integer", "flag") else None

    def _look_up(
        self, kind: str, look: Callable[[str], T], node: Node, problems: Problems
    ) -> T | None:
        del kind, look, node, problems
        return None
