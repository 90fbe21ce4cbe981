"""Come to rest."""

from __future__ import annotations

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.rest import come_to_rest
from executive.skills.motions.script import Script
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill

REST_S = 0.05
"""Of coming to rest where the robot stands already: for the forecast."""


class StopParams(SkillParams, frozen=True, kw_only=True):
    """Come to rest: finish the step, stand, hold the arms where they are."""


class Stop(ScriptedSkill[StopParams]):
    """Finish the step, stand, and hold the arms where they are."""

    name = "stop"
    summary = "finish the step, stand, and hold the arms where they are"
    takes = StopParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def forecast(cls, wanted: StopParams, outlook: Outlook) -> Forecast:
        """A moment, from standing."""
        return Forecast(REST_S)

    def script(self) -> Script[None]:
        """The same as what ends every skill."""
        yield from come_to_rest(self.body, self.resources)
