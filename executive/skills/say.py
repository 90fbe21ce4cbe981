"""Say something."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.motions.script import Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.parameters import SayParams


class Say(ScriptedSkill):
    """Hand a text to the voice."""

    resources = frozenset({"voice"})

    def __init__(self, parameters: SayParams, context: SkillContext) -> None:
        """What to say."""
        super().__init__(context)
        self.parameters = parameters
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
