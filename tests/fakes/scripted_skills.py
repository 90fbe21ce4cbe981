"""Skills that do what a test says: how many steps they take, how they end, how long to stop."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

from executive.behaviours.run_skill import DEFAULT_LIMIT_S
from executive.skills.parameters import SkillParams
from executive.skills.skill import Resource, SkillReport
from robot.failures import failure
from robot.messages import Heard, WorldMap


@dataclass
class Script:
    """One skill's life: `steps` running reports, then `code` (None: success)."""

    steps: int = 0
    code: str | None = None
    stop_steps: int = 0
    resources: frozenset[Resource] = frozenset({"legs"})
    raises: bool = False
    limit_s: float = DEFAULT_LIMIT_S


@dataclass
class FakeSkill:
    """Plays a script and counts how it was called."""

    script: Script
    params: SkillParams
    attempt: int
    resources: frozenset[Resource] = frozenset()
    calls: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.resources = self.script.resources

    def limit_s(self) -> float:
        return self.script.limit_s

    def start(self, now_s: float) -> None:
        self.calls.append("start")

    def step(self, now_s: float) -> SkillReport:
        self.calls.append("step")
        if self.script.raises:
            raise RuntimeError("a bug")
        if self.calls.count("step") <= self.script.steps:
            return SkillReport(status="running", phase="working")
        if self.script.code is None:
            return SkillReport(status="succeeded")
        reason = failure(self.script.code, f"scripted {self.script.code}")
        return SkillReport(status="failed", failure=reason)

    def stop(self, now_s: float) -> SkillReport:
        self.calls.append("stop")
        if self.calls.count("stop") <= self.script.stop_steps:
            return SkillReport(status="running", phase="stopping")
        return SkillReport(status="failed", failure=failure("cancelled", "stopped"))


class Troupe:
    """Makes fake skills: scripts by the type of the parameters, in turn, the last one for ever."""

    def __init__(self, scripts: dict[type, Sequence[Script]] | None = None) -> None:
        self.scripts = {kind: list(turns) for kind, turns in (scripts or {}).items()}
        self.made: list[FakeSkill] = []

    def make(self, params: SkillParams, attempt: int) -> FakeSkill:
        turns = self.scripts.get(type(params), [Script()])
        script = turns.pop(0) if len(turns) > 1 else turns[0]
        skill = FakeSkill(script, params, attempt)
        self.made.append(skill)
        return skill

    def names(self) -> list[str]:
        return [type(skill.params).__name__.removesuffix("Params").lower() for skill in self.made]


@dataclass
class SilentLink:
    """A link that has only what a test puts there."""

    messages: dict[str, object] = field(default_factory=lambda: defaultdict(lambda: None))
    sent: list[object] = field(default_factory=list)
    spoken: list[str] = field(default_factory=list)
    says: list[Heard] = field(default_factory=list)
    time_s: float = 0.0

    def send(self, command: object) -> None:
        self.sent.append(command)

    def next_id(self) -> int:
        return len(self.sent) + 1

    def now_s(self) -> float:
        return self.time_s

    def body(self):
        return self.messages["body"]

    def world(self):
        return self.messages["world"]

    def map(self) -> WorldMap | None:
        return self.messages["map"]

    def lidar(self):
        return self.messages["lidar"]

    def depth(self):
        return self.messages["depth"]

    def camera(self):
        return self.messages.get("camera")

    def power(self):
        return self.messages["power"]

    def timing(self):
        return self.messages["timing"]

    def speak(self, text: str) -> None:
        self.spoken.append(text)

    def heard(self) -> list[Heard]:
        heard, self.says = self.says, []
        return heard
