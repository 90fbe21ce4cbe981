"""Serves the page on this machine alone, and tells every page that is open what is new.

Nothing is kept for a page but how far it has been told: one that is slow is told less often, and
one that is gone is forgotten. What others could send a browser here for is refused: a request under
another host's name, or from another site's page, and whoever does not know the token. Who has not
shown it waits at a door (`door.py`) that is bounded; no shortage of files ends the server.
"""

from __future__ import annotations

import asyncio
import secrets
import socket
from collections.abc import Callable
from contextlib import closing, suppress
from http import HTTPStatus
from pathlib import Path
from typing import Any, Literal

import msgspec
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from executive.frontends.console.address import HOST, Address, url
from executive.frontends.console.desk import Order
from executive.frontends.console.door import TOKEN_S, Door
from executive.frontends.console.faults import forms
from executive.frontends.console.hearing import Hearing, Said
from executive.frontends.console.pace import Pace
from executive.frontends.console.page import page
from executive.frontends.console.peer import Peers
from executive.frontends.console.pictures import Place
from executive.frontends.console.proof import CONSOLE, PAGE, fresh, holds, proof
from executive.frontends.console.showing import MakeScene, Show
from executive.frontends.console.steering import Steering
from executive.frontends.console.telling import told
from executive.frontends.output import say
from executive.frontends.since_boot import now_s
from robot.errors import RobotError
from robot.person_distances import PERSON_RADIUS_M, ZONE_M

PERIOD_S = 0.05
"""Between two messages to a page: as often as the robot thinks."""
LOOK_SHARE = 0.1
"""Of the time, what looking back for one page may take: others wait for it."""
BATCH = 1000
"""Moments of a message, of the many of a run that has gone on for a while."""
BATCH_SENSED = 300
"""Lines of what was sensed, of 300 bytes each."""
MOST_PAGES = 16
MAX_MESSAGE = 1 << 16
NOBODY = "Nobody takes orders from this page: no robot is at work here."
TOO_MUCH = "Too much at once: until this page sends less, only a stop is heeded."
UNHEARD = "Nothing was heard: hold the button while you speak."
BACKLOG = 16
"""Connections taken at a time: what comes at once costs no more files than that."""


class Wish(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a page sends: its `proof` first (proof.py), then when it looks at, or an `Order`.

    `pictures` are the kinds of pictures that it shows now, of that time. `talk` says that the
    button of its microphone was pressed or let go, `sound` is what is said meanwhile (hearing.py).
    """

    proof: str = ""
    nonce: str = ""
    at: float | None = None
    pictures: tuple[str, ...] | None = None
    line: str = ""
    do: str = ""
    talk: Literal["begin", "end", ""] = ""
    sound: bytes = b""


class PageServer:
    """The server, inside an event loop.

    Attributes:
        url: of the page, with its token.
    """

    def __init__(
        self,
        find: Callable[[], Path | None],
        make_scene: MakeScene,
        *,
        token: str = "",
    ) -> None:
        """Serve nothing yet.

        Args:
            find: gives the folder of the run to be shown, None while there is none.
            make_scene: what a run's world looks like.
            token: that pages have to know; a new one by default.
        """
        self.token = token or secrets.token_urlsafe(18)
        self.url = ""
        self.show: Show | None = None
        self._find = find
        self._make_scene = make_scene
        self._page, self._policy = page()
        self._hosts: frozenset[str] = frozenset()
        self._pages = 0
        self._door = Door(Peers())
        self._short = False
        self._hearing = Hearing(self._heard_said, self._tell_all)

    async def open(self, listening: socket.socket) -> Server:
        """Serve on a socket that listens, on this machine alone."""
        door = self._door

        class Watched(ServerConnection):
            """A connection that waits at the door."""

            def connection_made(self, transport: asyncio.BaseTransport) -> None:
                super().connection_made(transport)
                door.come(self, self.transport)

            def connection_lost(self, exc: Exception | None) -> None:
                door.leave(self)
                super().connection_lost(exc)

        asyncio.get_running_loop().set_exception_handler(self._heard)
        server = await serve(
            self._serve, sock=listening, backlog=BACKLOG, create_connection=Watched,
            process_request=self._answer, max_size=MAX_MESSAGE, compression=None,
            open_timeout=TOKEN_S, ping_interval=10, ping_timeout=20, server_header=None,
        )  # fmt: skip
        number = int(listening.getsockname()[1])
        self._hosts = frozenset({f"{HOST}:{number}", f"localhost:{number}"})
        self.url = url(Address(port=number, token=self.token))
        return server

    async def follow(self) -> None:
        """Read the run that is to be shown, for ever."""
        clock, look_s = asyncio.get_running_loop().time, 0.0
        with closing(self._hearing):
            while True:
                begun_s = clock()
                with suppress(OSError, RobotError):  # no file can be opened now: it is looked again
                    if begun_s >= look_s:
                        look_s = begun_s + 1.0
                        self._choose()
                    if self.show is not None:
                        await self.show.look(begun_s)
                await asyncio.sleep(max(0.0, begun_s + PERIOD_S - clock()))

    async def follow_to_the_end(self) -> None:
        """Read the rest of the run that is shown, which is over."""
        with suppress(OSError, RobotError):
            if self.show is not None:
                await self.show.look_last()

    def _choose(self) -> None:
        folder = self._find()
        if folder is None or (self.show and self.show.following.folder == folder):
            return
        if self.show is not None:
            self.show.close()
        self.show = Show(folder, self._make_scene)

    def _heard(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """Say once that files are short; asyncio tries it again by itself each second."""
        if not str(context.get("message")).startswith("socket.accept()"):
            loop.default_exception_handler(context)
        elif not self._short:
            self._short = True
            say("No further page can be opened now: this process has no files left.", err=True)

    # --- what browsers ask for ---

    def _answer(self, _connection: ServerConnection, request: Request) -> Response | None:
        """The page, or a refusal; None lets the page's own connection through."""
        hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
        if len(hosts) != 1 or hosts[0] not in self._hosts:
            return _plain(HTTPStatus.MISDIRECTED_REQUEST, "this page has another name")
        if "Upgrade" in request.headers:
            if origins != [f"http://{hosts[0]}"]:
                return _plain(HTTPStatus.FORBIDDEN, "another site's page steers no robot")
            return None
        if request.path != "/":
            return _plain(HTTPStatus.NOT_FOUND, "there is nothing here")
        return _response(HTTPStatus.OK, self._page, "text/html; charset=utf-8", self._policy)

    async def _serve(self, connection: ServerConnection) -> None:
        """One page, until it is closed."""
        with suppress(ConnectionClosed, TimeoutError):
            if not await self._is_known(connection):
                await connection.close(4401, "not the token of this page")
                return
            self._door.leave(connection)
            if self._pages >= MOST_PAGES:
                await connection.close(1013, "too many pages")
                return
            self._pages += 1
            viewer = Viewer(self, connection)
            telling = asyncio.create_task(viewer.tell())
            try:
                await self._hear(connection, viewer)
            finally:
                telling.cancel()
                self._hearing.end(viewer, replying=False)
                self._pages -= 1

    async def _is_known(self, connection: ServerConnection) -> bool:
        """Whether a page knows the token; it is shown then that this server knows it, too."""
        host = connection.request.headers["Host"] if connection.request else ""
        asked = fresh()
        await connection.send(_json({"nonce": asked}), text=True)
        wish = _wish(await asyncio.wait_for(connection.recv(), TOKEN_S))
        if wish is None or not holds(wish.proof, self.token, PAGE, host, asked, wish.nonce):
            return False
        own = proof(self.token, CONSOLE, host, wish.nonce, asked)
        await connection.send(_json({"proof": own}), text=True)
        return True

    async def _hear(self, connection: ServerConnection, viewer: Viewer) -> None:
        pace = Pace()
        async for message in connection:
            wish = _wish(message)
            if wish is None:
                continue
            if wish.talk or wish.sound:
                if answer := self._listened(viewer, wish):
                    await connection.send(_json({"word": {"out": answer}}), text=True)
                continue
            if not (wish.do or wish.line):
                viewer.wishes(wish)
                continue
            order = Order(do=wish.do, line=wish.line, begun_s=now_s())
            if not pace.heeds(order, asyncio.get_running_loop().time()):
                if pace.refused == 1:
                    await connection.send(_json({"word": {"out": TOO_MUCH}}), text=True)
            elif self.show is None or not self.show.steering.send(order):
                await connection.send(_json({"word": {"out": NOBODY}}), text=True)

    # --- what is said into a page ---

    def _listened(self, viewer: Viewer, wish: Wish) -> str:
        """Take what a page's microphone hears; what the page is to be told, or empty."""
        show = self.show
        if wish.talk == "begin":
            if show is None or not show.steering.reaches:
                return NOBODY
            return self._hearing.begin(viewer, show.following.run.about)
        replying = show is not None and show.steering.asked
        answer = self._hearing.push(viewer, wish.sound, replying=replying) if wish.sound else ""
        if wish.talk == "end":
            self._hearing.end(viewer, replying=replying)
        return answer

    def _heard_said(self, said: Said, begun_s: float) -> None:
        """Hand on what was said; a halt before the end of what is being said comes with that."""
        if said.kind == "ignored":
            self._tell_all(f"“{said.text}” passed over: {said.why}." if said.text else UNHEARD)
        elif said.kind != "halt" and self.show is not None:
            cry = "stop" if said.kind == "stop" else ""
            order = Order(
                do=cry, heard="" if cry else said.text, sure=said.sure, doubtful=said.doubtful,
                begun_s=begun_s,
            )  # fmt: skip
            if not self.show.steering.send(order):
                self._tell_all(NOBODY)

    def _tell_all(self, text: str) -> None:
        if self.show is not None:
            self.show.steering.say(text)


class Viewer:
    """What one page has been told.

    Attributes:
        looks_at_s: when it wants to look at, once; the last that it wished. None: it was told.
    """

    def __init__(self, console: PageServer, connection: ServerConnection) -> None:
        """Nothing yet."""
        self.looks_at_s: float | None = None
        self._looks_again_s = 0.0
        self._at_s: float | None = None
        self._wanted: tuple[str, ...] = ()
        self._shown: dict[str, Place] = {}
        self._sensed = 0
        self._console = console
        self._connection = connection
        self._show: Show | None = None
        self._greeted = False
        self._scene = False
        self._moments = self._truth = 0
        self._parts: dict[str, bytes] = {}
        self._live: bool | None = None
        self._steers: bool | None = None
        self._asks = b""
        self._words = 0

    def wishes(self, wish: Wish) -> None:
        """Take what the page wants to look at."""
        self._at_s = wish.at
        if wish.pictures is not None:
            self._wanted = wish.pictures
            self._shown = {}
        else:
            self.looks_at_s = wish.at

    async def tell(self) -> None:
        """Tell what is new, for ever; each message waits until the page has taken the last."""
        loop = asyncio.get_running_loop()
        while True:
            begun_s = loop.time()
            show = self._console.show
            if show is not self._show or not self._greeted:
                self._greeted = True
                self._show, self._scene, self._moments, self._sensed = show, False, 0, 0
                self._truth = 0
                self._shown = {}
                self._parts, self._live, self._steers, self._asks = {}, None, None, b""
                self._words = show.steering.first if show else 0
                name = show.following.folder.name if show else ""
                begun = _json({"show": name, "zone_m": ZONE_M + PERSON_RADIUS_M, "faults": forms()})
                await self._connection.send(begun, text=True)
            more = False
            if show is not None:
                message = self._news(show)
                if message:
                    await self._connection.send(message, text=True)
                for word in self._said(show.steering):
                    await self._connection.send(word, text=True)
                if self.looks_at_s is not None and begun_s >= self._looks_again_s:
                    at_s, self.looks_at_s = self.looks_at_s, None
                    then = _json({"then": {"t_s": at_s, **told(show.following.run, at_s)}})
                    took_s = loop.time() - begun_s
                    self._looks_again_s = begun_s + took_s / LOOK_SHARE
                    await self._connection.send(then, text=True)
                for shot in self._pictures(show):
                    await self._connection.send(shot, text=True)
                more = self._scene and (
                    self._moments < len(show.following.moments)
                    or self._sensed < len(show.following.sensed)
                    or self._truth < len(show.following.truth)
                )
            if not more:
                await asyncio.sleep(max(0.0, begun_s + PERIOD_S - loop.time()))

    def _news(self, show: Show) -> bytes:
        """What this page does not know yet, as JSON; empty if there is nothing."""
        news: list[bytes] = []
        if show.scene and not self._scene:
            self._scene = True
            news.append(b'"scene":' + show.scene)
        moments = show.following.moments
        if self._scene and self._moments < len(moments):
            if not self._moments:  # first of all the picture as it is now
                latest, _ = moments.batch(len(moments) - 1, most=1)
                news += [b'"latest":' + line for line in latest]
            batch, self._moments = moments.batch(self._moments, most=BATCH)
            news.append(b'"moments":[' + b",".join(batch) + b"]")
        sensed = show.following.sensed
        if self._scene and self._sensed < len(sensed):
            batch, self._sensed = sensed.batch(self._sensed, most=BATCH_SENSED)
            news.append(b'"sensed":[' + b",".join(batch) + b"]")
        truth = show.following.truth
        if self._scene and self._truth < len(truth):
            batch, self._truth = truth.batch(self._truth, most=BATCH)
            news.append(b'"truth":[' + b",".join(batch) + b"]")
        for key, part in show.parts.items():
            if self._parts.get(key) != part:
                self._parts[key] = part
                news.append(b'"%b":%b' % (key.encode(), part))
        if show.live is not self._live:
            self._live = show.live
            news.append(b'"live":' + _json(show.live))
        steering = show.steering
        steers = steering.reaches
        if steers is not self._steers:
            self._steers = steers
            news.append(b'"steers":' + _json(steers))
        if steering.asks != self._asks:
            self._asks = steering.asks
            news.append(b'"asks":' + steering.asks)
        return b"{" + b",".join(news) + b"}" if news else b""

    def _pictures(self, show: Show) -> list[bytes]:
        """The pictures that the page wants and has not got: of each kind the newest alone."""
        found: list[bytes] = []
        for kind, pictures in show.following.pictures.items():
            place = pictures.at(self._at_s) if kind in self._wanted else None
            if place is None or self._shown.get(kind) == place:
                continue
            self._shown[kind] = place
            line = pictures.line(place)
            if line:
                found.append(b'{"shot":' + line + b"}")
        return found

    def _said(self, steering: Steering) -> list[bytes]:
        """What was said since this page was told; of much, the newest."""
        behind = min(steering.count - self._words, len(steering.words))
        self._words = steering.count
        return list(steering.words)[len(steering.words) - behind :]


def _json(value: object) -> bytes:
    return msgspec.json.encode(value)


def _wish(message: str | bytes) -> Wish | None:
    try:
        return msgspec.json.decode(message, type=Wish)
    except (msgspec.DecodeError, UnicodeError, RecursionError):
        return None


def _plain(status: HTTPStatus, text: str) -> Response:
    return _response(
        status, f"{text}\n".encode(), "text/plain; charset=utf-8", "default-src 'none'"
    )


def _response(status: HTTPStatus, body: bytes, kind: str, policy: str) -> Response:
    headers = Headers(
        {
            "Content-Type": kind,
            "Content-Length": str(len(body)),
            "Content-Security-Policy": policy,
            "Cache-Control": "no-store",
            "Cross-Origin-Opener-Policy": "same-origin",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
            "X-Frame-Options": "DENY",
            "Connection": "close",
        }
    )
    return Response(status.value, status.phrase, headers, body)
