"""Come to rest."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.motions.rest import come_to_rest
from executive.skills.motions.script import Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.parameters import StopParams


class Stop(ScriptedSkill):
    """Finish the step, stand, and hold the arms where they are."""

    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    def __init__(self, parameters: StopParams, context: SkillContext) -> None:
        """Nothing to choose."""
        super().__init__(context)
        self.parameters = parameters

    def script(self) -> Script[None]:
        """The same as what ends every skill."""
        yield from come_to_rest(self.body, self.resources)
