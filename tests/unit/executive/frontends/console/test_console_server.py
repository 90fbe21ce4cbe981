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
from websockets.asyncio.server import Server
from websockets.exceptions import ConnectionClosed, InvalidStatus

from executive.frontends.console import server
from executive.frontends.console.address import HOST
from executive.frontends.console.door import MOST_OTHERS, MOST_OWN
from executive.frontends.console.pace import BURST, Pace
from executive.frontends.console.page import page
from executive.frontends.console.proof import CONSOLE, PAGE, proof
from executive.frontends.console.server import BATCH, MOST_PAGES, NOBODY, TOO_MUCH, PageServer
from executive.journal import journal, motion, sensed
from executive.journal.motion import Moment
from executive.journal.sensed import Sensed
from robot import shots
from robot.shots import Shot
from tests.fakes.waiting import HANG_S

NONCE = "0123456789abcdef"
CLOSES_S = 0.5
"""What a page that reads nothing waits for the other end to part: behind all that it was sent."""
BASE = (0.0, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0)


def a_run(folder: Path, *, moments: int = 3, text: str = "wave") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    line = msgspec.json.encode({"n": 0, "t_s": 0.0, "event": "run", "text": text, "world": "w"})
    (folder / journal.FILE).write_bytes(line + b"\n")
    moves = [Moment(t_s=k / 20, base=BASE, q=(0.1,)) for k in range(1, moments + 1)]
    (folder / motion.FILE).write_bytes(b"".join(motion.encode(one) + b"\n" for one in moves))
    return folder


SERVERS: dict[PageServer, Server] = {}
"""What serves each console that is served now."""


@asynccontextmanager
async def served(find, **how):
    """A console that is served, and followed."""
    console = PageServer(find, lambda about: f"no picture of {about.get('world')}", **how)
    serving = await console.open(socket.create_server((HOST, 0)))
    following = asyncio.create_task(console.follow())
    SERVERS[console] = serving
    try:
        yield console
    finally:
        following.cancel()
        serving.close()
        del SERVERS[console]


def pictures(folder: Path, count: int, *, size: int = 10, begin: int = 0) -> None:
    """Add pictures to a run, one a second."""
    with (folder / shots.COLOUR_FILE).open("ab") as file:
        for k in range(begin, begin + count):
            shot = Shot(
                t_s=k + 1.0, kind="colour", type="jpeg", data=bytes(size), width=4, height=3,
                focal_px=(2.0, 2.0), centre_px=(1.5, 1.0),
            )  # fmt: skip
            file.write(shots.encode(shot) + b"\n")


class Visitor:
    """A page that is open: what it was told, put together."""

    def __init__(self, console: PageServer, *, token: str | None = None, origin: str | None = None):
        self.host = re.findall("//([^/]+)/", console.url)[0]
        self.console = console
        self.token = console.token if token is None else token
        self.origin = f"http://{self.host}" if origin is None else origin
        self.known: dict = {}
        self.moments: list = []

    async def __aenter__(self):
        self.socket = await connect(
            f"ws://{self.host}/", origin=self.origin or None, max_size=None, proxy=None,
            close_timeout=CLOSES_S,
        )  # fmt: skip
        asked = json.loads(await self.socket.recv())["nonce"]
        code = proof(self.token, PAGE, self.host, asked, NONCE)
        await self.say(proof=code, nonce=NONCE)
        if self.token == self.console.token:
            shown = json.loads(await self.socket.recv())["proof"]
            assert shown == proof(self.token, CONSOLE, self.host, NONCE, asked)
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


def test_who_shows_no_token_keeps_nobody_out(tmp_path):
    folder = a_run(tmp_path / "run")

    async def play():
        async with served(lambda: folder) as console:
            host = re.findall("//([^/]+)/", console.url)[0]
            port = int(host.partition(":")[2])
            mute = [await asyncio.open_connection(HOST, port) for _ in range(100)]
            waiting = [
                await connect(f"ws://{host}/", origin=f"http://{host}", proxy=None)
                for _ in range(2 * MOST_PAGES)
            ]
            async with Visitor(console) as visitor:
                await visitor.until("head")
            assert len(console._door) <= MOST_OWN + MOST_OTHERS
            for _, writer in mute:
                writer.close()
            for one in waiting:
                await one.close()

    asyncio.run(play())


def test_no_message_of_a_page_holds_the_token_and_none_is_good_twice():
    first, second = (proof("token", PAGE, "127.0.0.1:1", asked, NONCE) for asked in "ab")
    assert first != second and "token" not in first
    assert first != proof("token", CONSOLE, "127.0.0.1:1", "a", NONCE)
    assert first != proof("token", PAGE, "127.0.0.1:2", "a", NONCE)


def test_a_folder_that_cannot_be_read_for_a_while_ends_nothing(tmp_path):
    folder, short = a_run(tmp_path / "run"), [True]

    def find():
        if short:
            raise OSError(24, "Too many open files")
        return folder

    async def play():
        async with served(find) as console, Visitor(console) as visitor:
            await visitor.until("show")
            short.clear()
            await visitor.until("head")

    asyncio.run(play())


def test_files_that_are_short_are_told_of_once(tmp_path, capsys):
    async def play():
        async with served(lambda: None):
            loop = asyncio.get_running_loop()
            for _ in range(3):
                loop.call_exception_handler(
                    {"message": "socket.accept() out of system resource", "exception": OSError(24)}
                )

    asyncio.run(play())
    assert capsys.readouterr().err.count("\n") == 1


def test_a_page_that_sends_too_much_is_told_so_once_and_is_shown_the_newest(tmp_path, monkeypatch):
    monkeypatch.setattr(server, "Pace", lambda: Pace(per_s=0.0))  # however long the sending takes
    run = a_run(tmp_path / "run", moments=20)

    async def visited():
        async with served(lambda: run) as console, Visitor(console) as page:
            await page.until("scene", count=20)
            for _ in range(BURST + 50):
                await page.say(line="what are you doing")
            for at_s in (0.1, 0.2, 0.3, 0.4):
                await page.say(at=at_s)
            words, looks = [], []
            async with asyncio.timeout(HANG_S):
                while not looks or looks[-1] != 0.4:
                    news = json.loads(await page.socket.recv())
                    words += [news["word"]["out"]] if "word" in news else []
                    looks += [news["then"]["t_s"]] if "then" in news else []
            assert words == [NOBODY] * BURST + [TOO_MUCH]
            assert looks == sorted(looks)

    asyncio.run(visited())


def test_what_is_sensed_is_told_all_and_pictures_to_who_wants_them(tmp_path):
    run = a_run(tmp_path / "run")
    lines = [sensed.encode(Sensed(t_s=0.2 * k, torque=(1.0,))) + b"\n" for k in range(1, 1000)]
    (run / sensed.FILE).write_bytes(b"".join(lines))
    pictures(run, 5)

    async def visited():
        async with served(lambda: run) as console, Visitor(console) as page:
            times: list[float] = []
            shown: list[float] = []

            async def told(until):
                async with asyncio.timeout(HANG_S):
                    while not until():
                        news = json.loads(await page.socket.recv())
                        times.extend(one["t_s"] for one in news.get("sensed", []))
                        shown.extend([news["shot"]["t_s"]] if "shot" in news else [])

            await told(lambda: len(times) == 999)
            assert times == sorted(times) and shown == []  # nobody has asked for a picture
            await page.say(pictures=["colour", "nonsense"])
            await told(lambda: shown == [5.0])
            await page.say(at=2.7)  # somebody looks back: the picture of that time
            await told(lambda: shown == [5.0, 2.0])
            await page.say(pictures=[])
            await page.say(at=4.0)
            await page.say(pictures=["colour"], at=4.5)
            await told(lambda: shown == [5.0, 2.0, 4.0])

    asyncio.run(visited())


def test_a_page_that_does_not_read_costs_bounded_memory_and_skips_pictures(tmp_path):
    """Counted: what waits for a page that stands still, and what it is told once it goes on."""
    run, count, size = a_run(tmp_path / "run"), 200, 100_000

    async def visited():
        async with (
            served(lambda: run) as console,
            Visitor(console) as slow,
            Visitor(console) as good,
        ):
            await slow.say(pictures=["colour"])
            await good.until("head", count=3)
            with (run / motion.FILE).open("ab") as file:
                for k in range(count):  # a robot at work, that waits for nobody
                    pictures(run, 1, size=size, begin=k)
                    file.write(motion.encode(Moment(t_s=1.0 + k, base=BASE, q=(0.2,))) + b"\n")
                    file.flush()
                    await asyncio.sleep(0.01)
            await good.until(count=3 + count)  # was told all, with the slow one beside it
            waiting = [
                one.transport.get_write_buffer_size() for one in SERVERS[console].connections
            ]
            assert max(waiting) < 5 * size * 4 / 3
            seen: list[float] = []
            async with asyncio.timeout(HANG_S):
                while not seen or seen[-1] != count:
                    news = json.loads(await slow.socket.recv())
                    seen += [news["shot"]["t_s"]] if "shot" in news else []
                    slow.moments += news.get("moments", [])
            assert len(seen) < count / 2 and seen == sorted(seen)
            await slow.until(count=3 + count)  # how all moved is left out for nobody

    asyncio.run(visited())
