"""A request ends in time and within bounds, whatever the server does."""

import gzip
import itertools
import socket
import threading
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager

import httpx
import pytest

from intents.language_model.wire import Unusable, Wire

HEAD = b"HTTP/1.1 200 OK\r\n"
ENDLESS: dict[str, Callable[[], Iterator[bytes]]] = {
    "headers": lambda: itertools.chain([HEAD], (b"X-%d: a\r\n" % i for i in itertools.count())),
    "one header": lambda: itertools.chain([HEAD + b"X: "], itertools.repeat(b"a")),
    "status": lambda: itertools.repeat(b"H"),
    "continue": lambda: itertools.repeat(b"HTTP/1.1 100 Continue\r\n\r\n"),
    "body": lambda: itertools.chain(
        [HEAD + b"Content-Length: 9999\r\n\r\n"], itertools.repeat(b" ")
    ),
    "silence": lambda: iter(()),
}  # fmt: skip


@contextmanager
def trickling(parts: Iterator[bytes]) -> Generator[tuple[str, threading.Event]]:
    """A server that says one part each 10 ms; the event is set when its client has hung up."""
    gone, over = threading.Event(), threading.Event()

    def serve() -> None:
        connection, _ = listening.accept()
        with connection:
            connection.recv(65536)
            connection.settimeout(0.01)
            while not over.is_set():
                try:
                    connection.sendall(next(parts, b""))
                    if not connection.recv(1):
                        break
                except TimeoutError:
                    continue
                except OSError:
                    break
            gone.set()

    with socket.create_server(("127.0.0.1", 0)) as listening:
        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        try:
            yield f"http://127.0.0.1:{listening.getsockname()[1]}/", gone
        finally:
            over.set()
            thread.join()


@pytest.mark.parametrize("parts", ENDLESS.values(), ids=ENDLESS.keys())
def test_a_server_that_never_ends_is_left_behind(parts: Callable[[], Iterator[bytes]]) -> None:
    before = set(threading.enumerate())
    with trickling(parts()) as (url, gone):
        wire = Wire(clock=lambda: 0.0)
        with pytest.raises(Unusable):
            wire.post(url, {}, headers={}, until_s=0.1)
        for thread in set(threading.enumerate()) - before:
            if thread.name == "wire":
                thread.join()  # it ends, since its connection is closed
        gone.wait()
        wire.close()


def replying(content: bytes, encoding: str) -> Wire:
    def handle(request: httpx.Request) -> httpx.Response:
        assert request.headers["Accept-Encoding"] == "identity"
        headers = {"Content-Encoding": encoding} if encoding else {}
        return httpx.Response(200, headers=headers, stream=httpx.ByteStream(content))

    return Wire(transport=httpx.MockTransport(handle))


@pytest.mark.parametrize("encoding", ["gzip", "gzip, gzip", "deflate", "br", "identity, gzip"])
def test_nothing_is_unpacked(encoding: str) -> None:
    bomb = gzip.compress(gzip.compress(bytes(1_000_000)))
    with pytest.raises(Unusable, match="compressed"):
        replying(bomb, encoding).post("http://localhost/", {}, headers={}, until_s=1e9)


@pytest.mark.parametrize("encoding", ["", "identity", "Identity"])
def test_what_is_plain_is_read(encoding: str) -> None:
    wire = replying(b"{}", encoding)
    assert wire.post("http://localhost/", {}, headers={}, until_s=1e9).content == b"{}"
