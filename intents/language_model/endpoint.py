"""Where a language model is, what it may cost, and the secret that its host knows us by."""

import ipaddress
import re
import unicodedata

import httpx
import msgspec

MAX_DEADLINE_S = 600.0


class Key:
    """A secret that does not show itself in logs, tracebacks or journals."""

    __slots__ = ("_secret", "_shown")

    def __init__(self, secret: str = "") -> None:
        """Keep a secret; an empty one stands for none.

        Raises:
            ValueError: No header could carry it; the message does not show it.
        """
        if not (secret.isascii() and secret.isprintable()):
            raise ValueError("it holds more than one line of plain characters")
        self._secret = secret
        # Also with what cannot be seen between its letters, or with wide ones.
        self._shown = re.compile(r"[^!-~]*".join(map(re.escape, secret.replace(" ", ""))))

    def __repr__(self) -> str:
        return "Key(...)"

    def __bool__(self) -> bool:
        """Whether there is one."""
        return bool(self._secret)

    def header(self) -> dict[str, str]:
        """The header of a request, empty without a key."""
        return {"Authorization": f"Bearer {self._secret}"} if self._secret else {}

    def hidden(self, text: str) -> str:
        """A text of the server's without the secret, which it may have sent back."""
        return self._shown.sub("(key)", unicodedata.normalize("NFKC", text)) if self else text


class Endpoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the model is and what it may cost; a stranger may have written it.

    So it names no key: the user's own configuration says which host gets one.

    Attributes:
        base_url: Up to and without "/chat/completions"; no other host is ever spoken to. In the
            clear (http) on this machine only.
        model: Its name there.
        deadline_s: Time for one request, a repair included [s]; up to ten minutes.
        max_calls: Calls in one mission.
        max_tokens: Tokens in one mission, prompts included.
        answer_tokens: Tokens of one answer, thoughts included.
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
