"""The server of the page: who is let in, and that no page holds up another."""

from __future__ import annotations

import asyncio
import json
import re
import socket
from contextlib import asynccontextmanager
from pathlib import Path

import msgspec
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from executive.frontends.console.address import HOST
from executive.frontends.console.page import page
from executive.frontends.console.server import BATCH, PageServer
from executive.journal import journal, motion
from executive.journal.motion import Moment
from tests.fakes.waiting import HANG_S

BASE = (0.0, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0)


def a_run(folder: Path, *, moments: int = 3, text: str = "wave") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    line = msgspec.json.encode({"n": 0, "t_s": 0.0, "event": "run", "text": text, "world": "w"})
    (folder / journal.FILE).write_bytes(line + b"\n")
    moves = [Moment(t_s=k / 20, base=BASE, q=(0.1,)) for k in range(1, moments + 1)]
    (folder / motion.FILE).write_bytes(b"".join(motion.encode(one) + b"\n" for one in moves))
    return folder


@asynccontextmanager
async def served(find, **how):
    """A console that is served, and followed."""
    console = PageServer(find, lambda about: f"no picture of {about.get('world')}", **how)
    server = await console.open(socket.create_server((HOST, 0)))
    following = asyncio.create_task(console.follow())
    try:
        yield console
    finally:
        following.cancel()
        server.close()


class Visitor:
    """A page that is open: what it was told, put together."""

    def __init__(self, console: PageServer, *, token: str | None = None, origin: str | None = None):
        self.host = re.findall("//([^/]+)/", console.url)[0]
        self.token = console.token if token is None else token
        self.origin = f"http://{self.host}" if origin is None else origin
        self.known: dict = {}
        self.moments: list = []

    async def __aenter__(self):
        self.socket = await connect(
            f"ws://{self.host}/", origin=self.origin or None, max_size=None, proxy=None
        )
        await self.say(token=self.token)
        return self

    async def __aexit__(self, *_):
        await self.socket.close()

    async def say(self, **wish):
        await self.socket.send(json.dumps(wish))

    async def until(self, *keys, count=0):
        async with asyncio.timeout(HANG_S):
            while not all(key in self.known for key in keys) or len(self.moments) < count:
                news = json.loads(await self.socket.recv())
                if "show" in news:
                    self.known, self.moments = {}, []
                self.known |= news
                self.moments += news.get("moments", [])
        return self.known


async def asked(console: PageServer, *lines: str) -> str:
    """What the server answers to a request."""
    port = int(re.findall(r":(\d+)/", console.url)[0])
    reader, writer = await asyncio.open_connection(HOST, port)
    writer.write("\r\n".join(lines).replace("PORT", str(port)).encode() + b"\r\n\r\n")
    answer = await asyncio.wait_for(reader.read(), HANG_S)
    writer.close()
    return answer.decode(errors="replace")


def test_a_page_is_told_all_of_a_run_and_then_what_is_new(tmp_path):
    folder = a_run(tmp_path / "run")

    async def play():
        async with served(lambda: folder) as console, Visitor(console) as visitor:
            known = await visitor.until("scene", "head", "tree", count=3)
            assert known["head"]["text"] == "wave"
            assert known["scene"] == {"problem": "no picture of w"}
            assert known["live"] is False
            with (folder / motion.FILE).open("ab") as file:
                file.write(motion.encode(Moment(t_s=9.0, base=BASE, q=(0.2,))) + b"\n")
            await visitor.until(count=4)
            assert [one["t_s"] for one in visitor.moments] == [0.05, 0.1, 0.15, 9.0]
            await visitor.say(at=0.0)
            assert (await visitor.until("then"))["then"]["t_s"] == 0.0

    asyncio.run(play())


def test_a_long_run_comes_in_pieces_and_the_newest_first(tmp_path):
    folder, count = a_run(tmp_path / "run", moments=3 * BATCH), 3 * BATCH

    async def play():
        async with served(lambda: folder) as console, Visitor(console) as first:
            await first.until(count=count)
            async with Visitor(console) as second:
                await second.until("latest")
                assert second.known["latest"]["t_s"] == first.moments[-1]["t_s"]
                await second.until(count=count)
            assert [one["t_s"] for one in second.moments] == [one["t_s"] for one in first.moments]

    asyncio.run(play())


def test_a_page_that_does_not_read_holds_nobody_up(tmp_path):
    folder = a_run(tmp_path / "run", moments=20 * BATCH)

    async def play():
        async with served(lambda: folder) as console, Visitor(console), Visitor(console) as other:
            await other.until("head", count=20 * BATCH)  # the first one never reads

    asyncio.run(play())


def test_a_robot_that_comes_later_is_shown_in_the_same_page(tmp_path):
    there: list[Path] = []

    async def play():
        find = lambda: there[-1] if there else None  # noqa: E731
        async with served(find) as console, Visitor(console) as visitor:
            assert (await visitor.until("show"))["show"] == ""
            there.append(a_run(tmp_path / "first"))
            assert (await visitor.until("head", count=3))["show"] == "first"
            there.append(a_run(tmp_path / "second", moments=1, text="again"))
            while visitor.known.get("show") != "second":
                visitor.known.pop("head", None)
                await visitor.until("head")
            await visitor.until("head", count=1)
            assert visitor.known["head"]["text"] == "again" and len(visitor.moments) == 1

    asyncio.run(play())


@pytest.mark.parametrize("token", ["", "wrong", "ü" * 40, "x" * 10_000])
def test_who_does_not_know_the_token_is_told_nothing(tmp_path, token):
    folder = a_run(tmp_path / "run")

    async def play():
        async with served(lambda: folder) as console, Visitor(console, token=token) as visitor:
            with pytest.raises(ConnectionClosed) as closed:
                await visitor.until("head")
            assert closed.value.rcvd and closed.value.rcvd.code == 4401
            assert visitor.known == {}

    asyncio.run(play())


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1", ""])
def test_another_sites_page_is_refused_though_it_knew_the_token(tmp_path, origin):
    async def play():
        async with served(lambda: None) as console:
            with pytest.raises(InvalidStatus):
                async with Visitor(console, origin=origin):
                    pass

    asyncio.run(play())


@pytest.mark.parametrize(
    ("lines", "status"),
    [
        (["GET / HTTP/1.1", "Host: 127.0.0.1:PORT"], 200),
        (["GET / HTTP/1.1", "Host: localhost:PORT"], 200),
        (["GET / HTTP/1.1", "Host: rebound.example:PORT"], 421),
        (["GET / HTTP/1.1", "Host: 127.0.0.1"], 421),
        (["GET / HTTP/1.1"], 421),
        (["GET / HTTP/1.1", "Host: 127.0.0.1:PORT", "Host: evil.example"], 421),
        (["GET /etc/passwd HTTP/1.1", "Host: 127.0.0.1:PORT"], 404),
        (["GET /../../etc/passwd HTTP/1.1", "Host: 127.0.0.1:PORT"], 404),
    ],
)
def test_the_page_has_one_address_and_one_name(lines, status):
    async def play():
        async with served(lambda: None) as console:
            answer = await asked(console, *lines)
            assert answer.startswith(f"HTTP/1.1 {status} "), answer[:200]
            assert ("<canvas" in answer) is (status == 200)
            assert console.token not in answer

    asyncio.run(play())


def test_what_makes_no_sense_is_passed_over(tmp_path):
    folder = a_run(tmp_path / "run")

    async def play():
        async with served(lambda: folder) as console, Visitor(console) as visitor:
            for odd in ("", "[]", "{", '{"at": "x"}', '{"at": 1e999}', '{"a": 1}', "[" * 9999):
                await visitor.socket.send(odd)
            await visitor.socket.send(b"\x00\xff")
            await visitor.say(at=-1e300)
            assert (await visitor.until("then"))["then"]["tree"] == []

    asyncio.run(play())


def test_the_page_asks_nobody_else_for_anything():
    text, policy = page()
    assert "default-src 'none'" in policy and "unsafe" not in policy
    written = text.decode()
    for reaching in ("https:", "innerHTML", "outerHTML", "insertAdjacentHTML", "eval(", "import("):
        assert reaching not in written
    assert "http:" not in written
