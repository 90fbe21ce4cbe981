"""Asking a person for help: the last remedy that there is."""

from __future__ import annotations

import re
from typing import Literal, get_args

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.stage import Stage
from intents.context import verdict_of

Answer = Literal["continue", "give up"]
ANSWERS: tuple[Answer, ...] = get_args(Answer)

PATIENCE_S = 300.0
"""How long a person may take to help."""
ALONE_S = 5.0
"""How long it is waited where nobody is said to be there."""


_MAY = re.compile(r"\bmay I ([a-z ]+)\?")
_LEAVE = {
    "get up": frozenset(("get up", "stand up", "get back up", "get on your feet", "rise", "up"))
}
"""What is asked for leave, and how people say it."""
_POLITE = re.compile(
    r"\b(?:please|now|then|robot|ok(?:ay)?|yes|sure|and|just|again|go ahead|you (?:may|can))\b"
)


def answer_of(text: str, question: str = "") -> Answer | None:
    """The answer that a line is, also as a mere yes or no; None if it is none.

    To say what is asked for leave gives it: "get up", where the question is "may I get up?".
    """
    wanted = text.casefold().strip(" .!")
    verdict = verdict_of(text)
    plain: Answer | None = next((answer for answer in ANSWERS if answer == wanted), None)
    if plain is not None:
        return plain
    if verdict is not None:
        return "continue" if verdict else "give up"
    return "continue" if _gives_leave(wanted, question) else None


def _gives_leave(text: str, question: str) -> bool:
    asked = _MAY.search(question)
    said = " ".join(re.findall(r"[a-z]+", _POLITE.sub(" ", text)))
    return asked is not None and said in _LEAVE.get(asked[1], {asked[1]})


class AskForHelp(Behaviour):
    """Asks a question and waits: SUCCESS on "continue", FAILURE on "give up" or no answer.

    The failure for which help was asked stays the job's failure, so a job that nobody helped
    ends with the code it would have had. Pauses do not use up the patience.
    """

    def __init__(self, question: str, *, stage: Stage, step_id: str = "") -> None:
        """Ask `question`, such as "please move the chair, then say continue"."""
        super().__init__("ask for help")
        self._question = question
        self._stage = stage
        self._since_s = 0.0
        self.step_id = step_id

    def initialise(self) -> None:
        """Begin to wait."""
        self._since_s = self._stage.scope.worked_s

    def update(self) -> Status:
        """Ask when no other question is open, then listen."""
        desk = self._stage.help
        if desk.asker is None:
            desk.ask(self, self._question)
            self._stage.record("help", id=self.step_id, question=self._question)
        self.feedback_message = self._question if desk.asker is self else "another question is open"
        if desk.asker is self and desk.answer is not None:
            return self._end(desk.answer, Status.SUCCESS if desk.answer == "continue" else None)
        if self._stage.scope.worked_s - self._since_s > (PATIENCE_S if desk.attended else ALONE_S):
            return self._end("nobody answered", None)
        return Status.RUNNING

    def _end(self, answer: str, status: Status | None) -> Status:
        self._stage.record("answer", id=self.step_id, answer=answer)
        self.feedback_message = answer
        return status or Status.FAILURE

    def terminate(self, new_status: Status) -> None:  # noqa: ARG002
        """The question is not open any more."""
        if self._stage.help.asker is self:
            self._stage.help.close()
