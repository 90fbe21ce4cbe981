"""Do nothing for a while."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.script import Script
from executive.skills.parameters import SkillParams, lasting
from executive.skills.scripted import ScriptedSkill


class WaitParams(SkillParams, frozen=True, kw_only=True):
    """Do nothing for a while; without a duration until stopped."""

    duration_s: float | None = None

    def __post_init__(self) -> None:
        """Check the span."""
        if self.duration_s is not None:
            lasting(self.duration_s)


class Wait(ScriptedSkill[WaitParams]):
    """Wait for a time, or until stopped."""

    name = "wait"
    summary = "do nothing for a while"
    takes = WaitParams
    resources = frozenset()

    @classmethod
    def forecast(cls, wanted: WaitParams, outlook: Outlook) -> Forecast:
        """The span; nothing if it is until told."""
        return Forecast(wanted.duration_s or 0.0)

    def __init__(self, parameters: WaitParams, context: SkillContext) -> None:
        """How long."""
        super().__init__(parameters, context)
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
