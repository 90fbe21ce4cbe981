"""A server on this machine that speaks the protocol of OpenAI-compatible endpoints, as told."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, NamedTuple

Answer = str | Callable[[dict[str, Any]], str]


class Reply(NamedTuple):
    """What the server does with one request.

    Attributes:
        content: The model's words, or a function from the request to them.
        status: HTTP status.
        raw: Bytes to send instead of a completion.
        delay_s: Wait before the first byte.
        drip_s: Wait between bytes.
        cut: Close the connection after so many bytes; -1 sends everything.
        location: Where to redirect to, with a status 30x.
    """

    content: Answer = ""
    status: int = 200
    raw: bytes | None = None
    delay_s: float = 0.0
    drip_s: float = 0.0
    cut: int = -1
    location: str = ""


class Server:
    """What was asked and what is to be answered; the last reply is given again and again."""

    def __init__(self, replies: list[Reply]) -> None:
        self.replies = replies
        self.requests: list[dict[str, Any]] = []
        self.headers: list[dict[str, str]] = []
        self.url = ""

    def next(self) -> Reply:
        """The reply to the request that came last."""
        return self.replies[min(len(self.requests), len(self.replies)) - 1]


@contextmanager
def serving(*replies: Reply) -> Generator[Server]:
    """A running server; `url` is its base_url."""
    server = Server(list(replies))

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        disable_nagle_algorithm = True

        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
            server.requests.append(json.loads(body))
            server.headers.append(dict(self.headers.items()))
            _answer(self, server.next(), server.requests[-1])

        def log_message(self, *_: object) -> None:  # type: ignore[override]
            """Say nothing."""

    listening = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    listening.daemon_threads = True
    server.url = f"http://127.0.0.1:{listening.server_address[1]}/v1"
    thread = threading.Thread(target=listening.serve_forever, args=(0.02,), daemon=True)
    thread.start()
    try:
        yield server
    finally:
        listening.shutdown()
        listening.server_close()
        thread.join()


def _answer(handler: BaseHTTPRequestHandler, reply: Reply, request: dict[str, Any]) -> None:
    content = reply.content if isinstance(reply.content, str) else reply.content(request)
    choice = {"index": 0, "message": {"role": "assistant", "content": content}}
    completion = {"choices": [{**choice, "finish_reason": "stop"}], "usage": {"total_tokens": 100}}
    data = reply.raw if reply.raw is not None else json.dumps(completion).encode()
    time.sleep(reply.delay_s)
    try:
        handler.send_response(reply.status)
        if reply.location:
            handler.send_header("Location", reply.location)
        handler.send_header("Content-Type", "application/json")
        handler.send_header("Content-Length", str(len(data)))
        handler.end_headers()
        sent = data if reply.cut < 0 else data[: reply.cut]
        step = 1 if reply.drip_s else len(sent) or 1
        for at in range(0, len(sent), step):
            handler.wfile.write(sent[at : at + step])
            time.sleep(reply.drip_s)
        handler.close_connection = reply.cut >= 0
    except OSError:
        pass  # the client has hung up, as it may
