"""Ask somebody something, and wait for what they say."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.script import Script, give_up
from executive.skills.parameters import SkillParams, sayable
from executive.skills.scripted import ScriptedSkill

LISTEN_S = 8.0
"""How long an answer may take to begin: people think, and turn to who asks them."""
TRIES = 2
"""Who says nothing at first may not have heard it."""


class AskParams(SkillParams, frozen=True, kw_only=True):
    """Say a question to a person, and wait for the answer."""

    text: str
    person_id: str

    def __post_init__(self) -> None:
        """Check the length."""
        sayable(self.text)


class Ask(ScriptedSkill[AskParams]):
    """Say it, wait for words of that person, and say it once more if none come."""

    name = "ask"
    summary = "ask somebody something and wait for the answer"
    takes = AskParams
    resources = frozenset({"voice"})

    @classmethod
    def forecast(cls, wanted: AskParams, outlook: Outlook) -> Forecast:
        """Most people answer within two seconds."""
        return Forecast(2.0)

    def __init__(self, parameters: AskParams, context: SkillContext) -> None:
        """What to ask, and whom."""
        super().__init__(parameters, context)
        self._answered = False

    def script(self) -> Script[None]:
        """Ask; ends with the answer, or with `no_answer`."""
        body, wanted = self.body, self.parameters
        person = body.person(wanted.person_id)
        begin_s = body.now_s
        for _ in range(TRIES):
            body.phase = f"asking {person.name}"
            self.context.say(wanted.text)
            end_s = body.now_s + LISTEN_S
            body.phase = f"waiting for what {person.name} says"
            while body.now_s < end_s:
                yield
                if self.context.hearing.since(person.id, begin_s):
                    self._answered = True
                    return
        raise give_up(
            "no_answer", f"{person.name} did not answer", person=person.id, asked=wanted.text,
            waited_s=TRIES * LISTEN_S,
        )  # fmt: skip

    def remaining(self) -> AskParams | None:
        """Nothing, once there is an answer."""
        return None if self._answered else self.parameters
