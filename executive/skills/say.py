"""Say something."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.script import Script
from executive.skills.parameters import SkillParams, sayable
from executive.skills.scripted import ScriptedSkill

SPEAK_S = 0.05
"""Handing a text to the voice, which then speaks while the robot goes on."""


class SayParams(SkillParams, frozen=True, kw_only=True):
    """Say a text."""

    text: str

    def __post_init__(self) -> None:
        """Check the length."""
        sayable(self.text)


class Say(ScriptedSkill[SayParams]):
    """Hand a text to the voice."""

    name = "say"
    summary = "say something aloud"
    takes = SayParams
    resources = frozenset({"voice"})

    @classmethod
    def forecast(cls, wanted: SayParams, outlook: Outlook) -> Forecast:
        """A moment."""
        return Forecast(SPEAK_S)

    def __init__(self, parameters: SayParams, context: SkillContext) -> None:
        """What to say."""
        super().__init__(parameters, context)
        self._said = False

    def script(self) -> Script[None]:
        """Say it; takes one tick."""
        self.body.phase = "speaking"
        self._said = True
        self.context.say(self.parameters.text)
        yield

    def remaining(self) -> SayParams | None:
        """Nothing, once it is said."""
        return None if self._said else self.parameters
