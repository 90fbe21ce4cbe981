"""A language model behind any OpenAI-compatible endpoint, asked where the grammar gives up.

Its answer is data: goals of the closed set, checked by type, name and range like anyone's, and
read back to the person before anything moves (:mod:`intents.dialogue`). It can call nothing. What
goes wrong with it is a value in :attr:`LanguageModel.trouble`; the robot then goes on without it.

    model = LanguageModel(Endpoint(base_url=url, model=name), key=Key(secret))
    dialogue = Dialogue(vocabulary, fallback=model)
"""

import ipaddress
import time
from collections.abc import Callable
from typing import Any, cast

import httpx
import msgspec

from intents import allowed, prompt
from intents.context import Context
from intents.goals import Goal, from_builtins
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.vocabulary import Vocabulary
from intents.wire import Unusable, Wire

MAX_REPAIRS = 2
MAX_DEADLINE_S = 600.0
_FORBIDDEN = (401, 403)


class Key:
    """A secret that does not show itself in logs, tracebacks or journals."""

    __slots__ = ("_secret",)

    def __init__(self, secret: str = "") -> None:
        """Keep a secret; an empty one stands for none.

        Raises:
            ValueError: No header could carry it; the message does not show it.
        """
        if not (secret.isascii() and secret.isprintable()):
            raise ValueError("it holds more than one line of plain characters")
        self._secret = secret

    def __repr__(self) -> str:
        return "Key(...)"

    def __bool__(self) -> bool:
        """Whether there is one."""
        return bool(self._secret)

    def header(self) -> dict[str, str]:
        """The header of a request, empty without a key."""
        return {"Authorization": f"Bearer {self._secret}"} if self._secret else {}


class Endpoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the model is and what it may cost; a stranger may have written it.

    So it names no key: the user's own configuration says which host gets one.

    Attributes:
        base_url: Up to and without "/chat/completions"; no other host is ever spoken to. In the
            clear (http) on this machine only.
        model: Its name there.
        deadline_s: Time for one request, repairs included [s]; up to ten minutes.
        max_calls: Calls in one mission.
        max_tokens: Tokens in one mission, prompts included.
        answer_tokens: Tokens of one answer.
    """

    base_url: str
    model: str
    deadline_s: float = 15.0
    max_calls: int = 20
    max_tokens: int = 60_000
    answer_tokens: int = 1500

    def __post_init__(self) -> None:
        """Check what can be checked.

        Raises:
            ValueError: The address is none, or not a safe one, or a limit is not positive.
        """
        url = _address(self.base_url)
        if url.scheme != "https" and not _is_this_machine(url.host):
            raise ValueError(f"base_url {self.base_url!r}: only https leaves this machine")
        if min(self.deadline_s, self.max_calls, self.max_tokens, self.answer_tokens) <= 0:
            raise ValueError("deadline_s and the limits have to be more than 0")
        if not self.deadline_s <= MAX_DEADLINE_S:  # nor NaN
            raise ValueError(f"deadline_s: at most {MAX_DEADLINE_S:g} s are waited for an answer")

    @property
    def host(self) -> str:
        """Who is spoken to, as keys are kept for it: "host", or "host:port" for an odd port."""
        return _address(self.base_url).netloc.decode("ascii").lower()


def _address(base_url: str) -> httpx.URL:
    """The address as the client understands it; raises ValueError if it is none to send to."""
    try:
        url = httpx.URL(base_url)
        url.raw_host.decode("ascii").encode("idna")  # as who looks it up will: labels of 63 letters
    except (httpx.InvalidURL, UnicodeError):
        raise ValueError(f"base_url {base_url!r} is no http address") from None
    if url.scheme not in ("http", "https") or not url.host or (url.port or 0) > 65535:
        raise ValueError(f"base_url {base_url!r} is no http address")
    if url.userinfo or url.query or url.fragment:
        raise ValueError(f"base_url {base_url!r} may not hold more than a host and a path")
    return url


def _is_this_machine(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


class _Answer(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a model says; the goals are converted after their names are turned inward."""

    outcome: str
    goals: list[dict[str, Any]] = []
    text: str | None = None


class LanguageModel:
    """Asks the endpoint; a :data:`intents.parser.Fallback`.

    Attributes:
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
    ) -> None:
        """Make ready; nothing is sent yet.

        Args:
            endpoint: Where it is.
            key: What its host knows us by; none by default.
            clock: The time for deadlines [s].
            transport: In place of the network.
        """
        self._endpoint = endpoint
        self._key = key or Key()
        self._clock = clock
        self._wire = Wire(clock=clock, transport=transport)
        self._barred = False
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
        talk = prompt.messages(text, vocabulary, context)
        schema = prompt.answer_schema(vocabulary)
        try:
            for _ in range(1 + MAX_REPAIRS):
                said = self._ask(talk, schema, until_s)
                outcome = _read(said, vocabulary)
                if not isinstance(outcome, str):
                    return outcome
                self.trouble = f"the language model's answer was no use: {outcome}"
                told = f"That is not valid: {outcome}. Answer again, with one JSON object."
                talk = [
                    *talk,
                    {"role": "assistant", "content": said[:4000]},
                    {"role": "user", "content": told},
                ]
        except Unusable as why:
            self.trouble = str(why)
        return None

    def _ask(self, talk: list[dict[str, str]], schema: dict[str, Any], until_s: float) -> str:
        """One call.

        Raises:
            Unusable: No budget or time is left, or the endpoint does not answer as it should.
        """
        self._may_ask(until_s)
        self.calls += 1
        body = {
            "model": self._endpoint.model,
            "messages": talk,
            "temperature": 0,
            "max_tokens": self._endpoint.answer_tokens,
            "response_format": {
                "type": "json_schema",
                "json_schema": {"name": "robot_goals", "schema": schema},
            },
        }
        raw = self._post(body, until_s)
        said, used = _content(raw)
        self.tokens += used or (len(str(talk)) + len(raw)) // 3
        return said

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

    def _post(self, body: dict[str, Any], until_s: float) -> bytes:
        """The body of the reply, within the deadline and a limit of size."""
        url = self._endpoint.base_url.rstrip("/") + "/chat/completions"
        reply = self._wire.post(url, body, headers=self._key.header(), until_s=until_s)
        if reply.status in _FORBIDDEN:
            self._barred = True
            raise self._unwelcome()
        if not httpx.codes.is_success(reply.status):
            raise Unusable(f"the language model answered {reply.status}")
        return reply.content


class _Message(msgspec.Struct):
    content: str | None = None


class _Choice(msgspec.Struct):
    message: _Message
    finish_reason: str | None = None


class _Usage(msgspec.Struct):
    total_tokens: int = 0


class _Completion(msgspec.Struct):
    choices: list[_Choice] = []
    usage: _Usage | None = None


def _content(raw: bytes) -> tuple[str, int]:
    """The words of the first choice, and the tokens used.

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
    return completion.choices[0].message.content or "", used


def _read(said: str, vocabulary: Vocabulary) -> Outcome | str:
    """The outcome that an answer stands for, or what is wrong with it."""
    try:
        answer = msgspec.json.decode(_json_in(said), type=_Answer)
    except (msgspec.DecodeError, UnicodeError, RecursionError) as error:
        return str(error)[:300]
    text = allowed.spoken(answer.text or "")
    if answer.outcome == "refusal":
        return Refusal(reason=text or "I cannot do that.", parser="model")
    if answer.outcome == "question":
        return Question(question=text, parser="model") if text else "a question has no text"
    if answer.outcome != "goals":
        return "outcome is to be goals, question or refusal"
    goals = _goals(answer.goals)
    if isinstance(goals, str):
        return goals
    wrong = allowed.fault(goals, vocabulary)
    return wrong or Goals(goals=goals, parser="model")


def _json_in(said: str) -> str:
    """The answer without a fence of back quotes around it."""
    plain = said.strip()
    if plain.startswith("```"):
        plain = plain.removeprefix("```json").removeprefix("```").rstrip("`").strip()
    return plain


def _goals(data: object) -> tuple[Goal, ...] | str:
    try:
        return from_builtins(cast("list[dict[str, Any]]", data))
    except (msgspec.ValidationError, RecursionError) as error:
        return str(error)[:300]
