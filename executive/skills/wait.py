"""Do nothing for a while."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.motions.script import Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.parameters import WaitParams


class Wait(ScriptedSkill):
    """Wait for a time, or until stopped."""

    resources = frozenset()

    def __init__(self, parameters: WaitParams, context: SkillContext) -> None:
        """How long."""
        super().__init__(context)
        self.parameters = parameters
        self._begin_s: float | None = None

    def script(self) -> Script[None]:
        """Let the time pass."""
        span_s = self.parameters.duration_s
        self.body.phase = "waiting" if span_s is not None else "waiting until told to go on"
        begin_s = self._begin_s = self.body.now_s
        while span_s is None or self.body.now_s - begin_s < span_s - 1e-9:
            self.body.progress = 0.0 if not span_s else (self.body.now_s - begin_s) / span_s
            yield

    def remaining(self) -> WaitParams:
        """The time that is left."""
        span_s = self.parameters.duration_s
        if span_s is None or self._begin_s is None:
            return self.parameters
        return WaitParams(duration_s=max(0.0, span_s - (self.body.now_s - self._begin_s)))
