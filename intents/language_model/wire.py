"""One request to a server that may be anybody's: it ends in time, and its answer is bounded."""

import queue
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

import httpx

MAX_ANSWER_BYTES = 256 * 1024
MAX_COMPLAINT_BYTES = 4096
_PLAIN = {"Accept-Encoding": "identity"}
_LATE = "the language model did not answer in time"
_UNWANTED = "nobody waits for the language model's answer any more"


class Unusable(Exception):
    """The endpoint did not give an answer; asking it again now is no use."""


class Reply(NamedTuple):
    """What came back; of what is no success only the beginning."""

    status: int
    content: bytes


class Wire:
    """Connections to one server."""

    def __init__(
        self,
        *,
        clock: Callable[[], float] = time.monotonic,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        """Make ready; nothing is sent yet.

        Args:
            clock: The time for deadlines [s].
            transport: In place of the network.
        """
        self._clock = clock
        self._transport = transport
        self._client = self._fresh()
        self._awaited: queue.SimpleQueue[Reply | Exception] | None = None

    def close(self) -> None:
        """Give connections back."""
        self._client.close()

    def give_up(self) -> None:
        """Let who waits for an answer wait no more; from any thread."""
        awaited = self._awaited
        if awaited is not None:
            awaited.put(Unusable(_UNWANTED))

    def post(self, url: str, body: object, *, headers: dict[str, str], until_s: float) -> Reply:
        """Send a body as JSON, and wait for the answer until a time of the clock.

        httpx bounds each read, not all of them: a server that sends a header now and then would
        hold its reader for ever. So a thread reads, and is left behind when the time is over.

        Raises:
            Unusable: There is no answer, or none in time, or it is too long, or compressed.
        """
        came: queue.SimpleQueue[Reply | Exception] = queue.SimpleQueue()
        request = self._client.build_request(
            "POST", url, json=body, headers={**headers, **_PLAIN},
            timeout=max(until_s - self._clock(), 0.001),
        )  # fmt: skip
        work = (self._client, request, until_s, came)
        self._awaited = came  # first: whoever sees the request on its way may give it up
        threading.Thread(target=self._exchange, args=work, name="wire", daemon=True).start()
        try:
            answer = came.get(timeout=max(until_s - self._clock(), 0.001))
        except queue.Empty:
            self._hang_up()
            raise Unusable(_LATE) from None
        except BaseException:  # whoever waited was interrupted
            self._hang_up()
            raise
        finally:
            self._awaited = None
        if isinstance(answer, Unusable):
            self._hang_up()
        if isinstance(answer, httpx.HTTPError | httpx.InvalidURL | OSError):
            name = type(answer).__name__
            raise Unusable(f"the language model cannot be reached ({name})") from None
        if not isinstance(answer, Reply):
            raise answer
        return answer

    def _fresh(self) -> httpx.Client:
        return httpx.Client(transport=self._transport, follow_redirects=False, trust_env=False)

    def _hang_up(self) -> None:
        """The thread that reads finds its connection closed, and ends."""
        self._client.close()
        self._client = self._fresh()

    def _exchange(
        self,
        client: httpx.Client,
        request: httpx.Request,
        until_s: float,
        came: queue.SimpleQueue[Reply | Exception],
    ) -> None:
        try:
            came.put(self._answer(client, request, until_s))
        except Exception as error:  # whatever it is, it is for the one who waits
            came.put(error)

    @staticmethod
    def _complaint(reply: httpx.Response) -> bytes:
        """The beginning of what a server says of a request that it does not answer."""
        if reply.headers.get("Content-Encoding", "identity").strip().lower() != "identity":
            return b""
        return next(reply.iter_raw(MAX_COMPLAINT_BYTES), b"")

    def _answer(self, client: httpx.Client, request: httpx.Request, until_s: float) -> Reply:
        reply = client.send(request, stream=True)
        try:
            if not reply.is_success:
                return Reply(reply.status_code, self._complaint(reply))
            if reply.headers.get("Content-Encoding", "identity").strip().lower() != "identity":
                raise Unusable("the language model's answer is compressed, which was not asked for")
            received = bytearray()
            for chunk in reply.iter_raw():
                received += chunk
                if len(received) > MAX_ANSWER_BYTES:
                    raise Unusable("the language model's answer is too long")
                if self._clock() >= until_s:
                    raise Unusable(_LATE)
            return Reply(reply.status_code, bytes(received))
        finally:
            reply.close()
