"""Asking a language model: one call, one more where its answer cannot be used, and that is all.

What goes wrong is a value in :attr:`LanguageModel.trouble`; the robot then goes on without it.
"""

import time
from collections.abc import Callable
from typing import Any

import httpx
import msgspec

from intents import allowed
from intents.context import Context
from intents.goals import Goal
from intents.grounding import Unknown, ground, queries
from intents.language_model import misfits
from intents.language_model.answers import answer_in
from intents.language_model.endpoint import Endpoint, Key
from intents.language_model.mending import goals_from
from intents.language_model.prompt import FORMS, Talk, talk_of
from intents.language_model.wire import Reply, Unusable, Wire
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.prohibitions import broken
from intents.vocabulary import Vocabulary

MAX_REPAIRS = 1
_FORBIDDEN = (401, 403)
_FORM_UNKNOWN = (400, 415, 422, 500, 501)
"""What servers answer that do not know a form: llama-cpp-python has a 500 for it."""
_CUT_OFF = "it was cut off; be shorter"


class LanguageModel:
    """Asks the endpoint; a :data:`intents.parser.Fallback`.

    Attributes:
        unable: Why goals cannot be done here, in words; empty if they can.
        trouble: Why the last request led to nothing; empty if it did not go wrong.
        calls: Calls made in this mission.
        tokens: Tokens used in this mission.
    """

    def __init__(
        self,
        endpoint: Endpoint,
        *,
        key: Key | None = None,
        clock: Callable[[], float] = time.monotonic,
        transport: httpx.BaseTransport | None = None,
        shown: Callable[[dict[str, Any]], None] | None = None,
    ) -> None:
        """Make ready; nothing is sent yet.

        Args:
            endpoint: Where it is.
            key: What its host knows us by; none by default.
            clock: The time for deadlines [s].
            transport: In place of the network.
            shown: Is given the body of each request, before it is sent.
        """
        self._endpoint = endpoint
        self._key = key or Key()
        self._clock = clock
        self._wire = Wire(clock=clock, transport=transport)
        self._barred = False
        self._form = 0
        self._shown = shown
        self.unable: Callable[[tuple[Goal, ...]], str] = lambda _goals: ""
        self.trouble = ""
        self.calls = 0
        self.tokens = 0

    def begin_mission(self) -> None:
        """Begin the budget of calls and tokens anew."""
        self.calls = self.tokens = 0

    def give_up(self) -> None:
        """Let a sentence that is being asked about come to nothing, at once; from any thread."""
        self._wire.give_up()

    def close(self) -> None:
        """Give connections back."""
        self._wire.close()

    def __call__(self, text: str, vocabulary: Vocabulary, context: Context) -> Outcome | None:
        """What the model makes of a sentence; None if it is of no help, with ``trouble`` set."""
        self.trouble = ""
        until_s = self._clock() + self._endpoint.deadline_s
        talk = talk_of(text, vocabulary, context)
        try:
            for _ in range(1 + MAX_REPAIRS):
                said, cut_off = self._ask(talk, until_s)
                outcome = _read(said, text, vocabulary, context)
                if isinstance(outcome, Goals):
                    outcome = self.unable(outcome.goals) or outcome
                if not isinstance(outcome, str):
                    self.trouble = ""
                    return outcome
                wrong = _CUT_OFF if cut_off else outcome
                self.trouble = f"the language model's answer was no use: {wrong}"
                talk = talk.retold(said, wrong)
        except Unusable as why:
            self.trouble = f"{self.trouble}; then {why}" if self.trouble else str(why)
        return None

    def _ask(self, talk: Talk, until_s: float) -> tuple[str, bool]:
        """What the model says, and whether it was cut off, in the strictest form the server knows.

        Raises:
            Unusable: No budget or time is left, or the endpoint does not answer as it should.
        """
        reply = Reply(0, b"")
        for form in FORMS[self._form :]:
            self._may_ask(until_s)
            self.calls += 1
            endpoint = self._endpoint
            body = talk.body(endpoint.model, form=form, answer_tokens=endpoint.answer_tokens)
            if self._shown is not None:
                self._shown(body)
            reply = self._post(body, until_s)
            if reply.status not in _FORM_UNKNOWN:
                self._form = FORMS.index(form)
                break
        if not httpx.codes.is_success(reply.status):
            raise Unusable(f"the language model answered {reply.status}{self._told(reply)}")
        said, used, cut_off = _content(reply.content)
        self.tokens += used or (len(str(talk.messages)) + len(reply.content)) // 3
        return said, cut_off

    def _may_ask(self, until_s: float) -> None:
        if self._barred:
            raise self._unwelcome()
        if self.calls >= self._endpoint.max_calls or self.tokens >= self._endpoint.max_tokens:
            raise Unusable("the language model's budget for this mission is spent")
        if self._clock() >= until_s:
            raise Unusable("the language model did not answer in time")

    def _unwelcome(self) -> Unusable:
        host = self._endpoint.host
        if self._key:
            return Unusable(f"the language model at {host} does not accept the key")
        return Unusable(f"the language model wants a key, and none is kept for {host!r}")

    def _post(self, body: dict[str, Any], until_s: float) -> Reply:
        """The reply, within the deadline and a limit of size."""
        url = self._endpoint.base_url.rstrip("/") + "/chat/completions"
        reply = self._wire.post(url, body, headers=self._key.header(), until_s=until_s)
        if reply.status in _FORBIDDEN:
            self._barred = True
            raise self._unwelcome()
        return reply

    def _told(self, reply: Reply) -> str:
        """Why a server does not answer, in its own words: ": model not found"."""
        words = reply.content.decode(errors="replace")
        try:
            error = msgspec.json.decode(reply.content, type=_Error).error
            words = error if isinstance(error, str) else error.message
        except (msgspec.DecodeError, UnicodeError, RecursionError):
            words = "" if "<" in words else words  # a page for a browser
        words = allowed.spoken(self._key.hidden(words))[:_MAX_ERROR]
        return f": {words}" if words else ""


_MAX_ERROR = 160


class _Complaint(msgspec.Struct):
    message: str = ""


class _Error(msgspec.Struct):
    error: _Complaint | str


class _Text(msgspec.Struct):
    text: str = ""


class _Message(msgspec.Struct):
    content: str | list[_Text] | None = None


class _Choice(msgspec.Struct):
    message: _Message
    finish_reason: str | None = None


class _Usage(msgspec.Struct):
    total_tokens: int = 0


class _Completion(msgspec.Struct):
    choices: list[_Choice] = []
    usage: _Usage | None = None


def _content(raw: bytes) -> tuple[str, int, bool]:
    """The words of the first choice, the tokens used, and whether there were too few of them.

    Raises:
        Unusable: It is no completion.
    """
    try:
        completion = msgspec.json.decode(raw, type=_Completion)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        raise Unusable("the language model's endpoint does not speak the protocol") from None
    used = max(completion.usage.total_tokens, 0) if completion.usage else 0
    if not completion.choices:
        raise Unusable("the language model gave no answer")
    choice = completion.choices[0]
    content = choice.message.content or ""
    said = content if isinstance(content, str) else "".join(part.text for part in content)
    return said, used, choice.finish_reason == "length"


def _read(said: str, text: str, vocabulary: Vocabulary, context: Context) -> Outcome | str:
    """The outcome that an answer to a text stands for, or what is wrong with it."""
    answer = answer_in(said)
    if answer is None:
        return "there is no whole JSON object in it"
    spoken = allowed.spoken(answer.text)
    if answer.kind == "refusal":
        return Refusal(reason=spoken or "I cannot do that.", parser="model")
    if answer.kind == "question":
        return Question(question=spoken, parser="model") if spoken else "a question has no text"
    try:
        goals = goals_from(answer.goals, vocabulary)
    except (msgspec.ValidationError, RecursionError) as error:
        return misfits.in_words(error)
    wrong = (
        allowed.fault(goals, vocabulary)
        or allowed.steering(goals)
        or _not_there(goals, context)
        or broken(goals, (*_standing(context), text), vocabulary)
    )
    return wrong or Goals(goals=goals, parser="model")


def _standing(context: Context) -> list[str]:
    """What a person has said by itself; what was said of a plan has changed that plan."""
    turns = zip(context.said, context.said[1:], strict=False)
    return [
        one.text for one, reply in turns if one.who == "person" and "Shall I?" not in reply.text
    ]


def _not_there(goals: tuple[Goal, ...], context: Context) -> str:
    """Which thing there is none of, as far as it is known what is there; empty if all are."""
    if not context.entities:
        return ""
    found = (ground(query, context.entities, view=context.view) for query in queries(goals))
    return next((one.reason for one in found if isinstance(one, Unknown)), "")
