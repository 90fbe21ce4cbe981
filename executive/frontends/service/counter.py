"""The executive's end: heeds what other terminals ask for, by the prompt's own shell.

So a stop is a stop and words mean what they mean at the prompt. Buttons, stops and halts act in the
thread that reads them, whatever else is being worked off; lines are worked off one after another.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from typing import NamedTuple

import msgspec

from executive.engine.jobs import OVER
from executive.engine.teleoperation import Velocity
from executive.frontends.emergency import AT_THE_ROBOT, undoes
from executive.frontends.line_server import Client, LineServer, is_own
from executive.frontends.output import as_mistake
from executive.frontends.prompt.shell import Shell
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service import views
from executive.frontends.service.place import Place, Running
from executive.frontends.service.readiness import is_ready
from executive.frontends.service.telling import Log
from robot.closing import Closing
from robot.errors import RobotError
from robot.exit_status import ExitStatus, exit_status
from robot.printable import printable_line

MOST_CLIENTS = 16
MOST_LINES = 50
"""Lines that may wait; who types faster is told."""
MOST_WAITS = 64
"""That one client may have open: more than lines that may wait."""
LOOK_S = 0.1
KEPT_WORDS = 100
"""What was said last; who begins to watch is told."""
LEAVING = ("quit", "exit")
ELSEWHERE = "the operator said stop in another terminal"
NOT_LEFT = "That is for a prompt; `humanoid down` ends this robot."
LEAVES = "leave; the robot goes on (also Ctrl-D), `humanoid down` ends it"
"""What those of `LEAVING` do at another terminal, where leaving stops nothing."""


class _Asker(NamedTuple):
    """Who asked, by which number; `aside`: the answer is for nobody else."""

    client: Client
    number: int
    aside: bool


class _Wait(NamedTuple):
    client: Client
    number: int
    jobs: tuple[int, ...]


class Counter(Closing):
    """A context manager: takes requests inside.

    Attributes:
        left: is set when somebody wants the robot to be down.
    """

    def __init__(self, shell: Shell, *, place: Place, running: Running, log: Log) -> None:
        """Listen at a place.

        Raises:
            OSError: if there is no room for a socket.
        """
        self.left = threading.Event()
        self._shell = shell
        self._place = place
        self._running = running
        self._log = log
        self._here = threading.local()
        self._watching: dict[Client, m.Watch] = {}
        self._waits: list[_Wait] = []
        self._lock = threading.Lock()
        self._telling = threading.Lock()
        self._recent: deque[str] = deque(maxlen=KEPT_WORDS)
        self._asks = m.Asks()
        self._seen: views.Seen | None = None
        self._stops = shell.stops
        self._open_lines = 0
        self._closing = threading.Event()
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lines")
        self._out, shell.out = shell.out, self._say
        for name in shell.commands.keys() & set(LEAVING):
            shell.commands[name] = replace(shell.commands[name], summary=LEAVES, run=self._not_left)
        shell.robot.on_submit = self._note_job
        self._server = LineServer(
            places.listen(place, running, backlog=MOST_CLIENTS),
            heed=self._heed,
            is_welcome=is_own,
            gone=self._forget,
            most_clients=MOST_CLIENTS,
            longest=m.MAX_REQUEST,
        )
        self._looker = threading.Thread(target=self._look_on, name="counter", daemon=True)
        self._looker.start()

    def close(self) -> None:
        """Take no more requests; who waits for something is told that it ended."""
        if self._closing.is_set():
            return
        self._closing.set()
        self._looker.join()
        self._look()
        for wait in self._waits:
            self._end(wait.client, wait.number, ExitStatus.FAILED)
        self._server.close()
        self._shell.out = self._out
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _not_left(self, _rest: str) -> None:
        """What becomes of a line that ends a prompt."""
        self._say(NOT_LEFT)

    # --- what is told ---

    def tell(self, text: str) -> None:
        """Tell watchers, and the log, of something that is printed by somebody else."""
        self._log.append(text)
        self._recent.append(text)
        self._tell_watchers(m.Words(text=text))

    def _say(self, text: str) -> None:
        """What the shell says: to who asked, and, unless it is aside, to everybody."""
        asker: _Asker | None = getattr(self._here, "asker", None)
        if asker is not None:
            asker.client.send(m.line_of(m.Words(number=asker.number, text=text)))
            if asker.aside:
                return
        self._out(text)
        self._log.append(text)
        self._recent.append(text)
        self._tell_watchers(m.Words(text=text), but=asker.client if asker else None)

    def _tell_watchers(
        self, told: m.Words | m.Asks | m.Stopped | views.Seen, *, but: Client | None = None
    ) -> None:
        with self._lock:
            watching = dict(self._watching)
        line, view = m.line_of(told) if watching else b"", isinstance(told, views.Seen)
        for client, watch in watching.items():
            if client is not but and (watch.views or not view):
                client.send(line, supersedes=view)

    def _end(self, client: Client, number: int, status: int, **more: m.Standing) -> None:
        stops = self._shell.stops
        client.send(m.line_of(m.Ended(number=number, status=status, stops=stops, **more)))

    def _look_on(self) -> None:
        while not self._closing.wait(LOOK_S):
            try:
                self._look()
            except Exception as error:  # in this software: the robot goes on
                self._out(as_mistake(error))

    def _look(self) -> None:
        """Tell what changed, and who need not wait any more."""
        with self._telling:
            self._tell_changes()
        with self._lock:
            waits = tuple(self._waits)
        for wait in waits:
            status = self._status_of(wait.jobs)
            if status is None:
                continue
            with self._lock:
                if wait not in self._waits:  # whoever waited has gone
                    continue
                self._waits.remove(wait)
            self._end(wait.client, wait.number, status)

    def _tell_changes(self) -> None:
        """What is asked, how often it was told to stop, and how the robot is."""
        question, choices = self._shell.asked or ("", ())
        asks = m.Asks(question=question, choices=choices)
        if asks != self._asks:
            self._asks = asks
            self._tell_watchers(asks)
        stops = self._shell.stops
        if stops != self._stops:
            self._stops = stops
            self._tell_watchers(m.Stopped(stops=stops))
        seen = views.Seen(view=self._shell.robot.view, busy=self._busy)
        if seen != self._seen:
            self._seen = seen
            self._tell_watchers(seen)

    @property
    def _busy(self) -> bool:
        """Whether there is something to stop, also a line that may come to something."""
        return self._shell.robot.busy or self._open_lines > 0

    def _status_of(self, numbers: tuple[int, ...]) -> ExitStatus | None:
        """How jobs ended, the worst of them; None while one is not over."""
        robot = self._shell.robot
        if robot.lost is not None:
            return ExitStatus.BROKEN
        known = {job.number: job for job in robot.executive.jobs}
        before = {number: state for number, state, _ in robot.ended_before}
        worst = ExitStatus.DONE
        for number in numbers:
            job = known.get(number)
            if job is None:
                done = before.get(number) == "done"
                worst = max(worst, ExitStatus.DONE if done else ExitStatus.FAILED)
            elif job.state not in OVER:
                return None
            else:
                worst = max(worst, exit_status(job.failure))
        return worst

    # --- what is asked ---

    def _heed(self, client: Client, line: bytes) -> None:
        """Do what can be done at once, here; a mistake in it ends nothing."""
        try:
            asked = m.request(line)
        except (msgspec.DecodeError, RecursionError):
            client.drop()  # whoever speaks otherwise is none of ours
            return
        aside = not isinstance(asked, m.Say | m.Press)
        self._here.asker = _Asker(client, asked.number, aside)
        try:
            self._answer(client, asked)
        except RobotError as error:
            self._say(f"Not done: {error}")
            self._end(client, asked.number, ExitStatus.INVALID)
        except Exception as error:
            self._say(as_mistake(error))
            self._end(client, asked.number, ExitStatus.BROKEN)
        finally:
            self._here.asker = None

    def _answer(self, client: Client, asked: m.Request) -> None:
        match asked:
            case m.Press(button="stop"):
                self._stop(asked)
            case m.Press(button=button):
                self._press(button)
            case m.Say():
                self._take(client, asked)
                return
            case m.Halt(text=text):
                self._shell.halt_at_once(text, busy=self._busy)
            case m.Status():
                self._shell.command("status")
                self._end(client, asked.number, ExitStatus.DONE, standing=self._standing())
                return
            case m.Queue():
                self._shell.command("goals")
                self._end(client, asked.number, ExitStatus.DONE, standing=self._standing())
                return
            case m.Drive():
                velocity = Velocity(asked.forward_m_s, asked.left_m_s, asked.turn_rad_s)
                session = self._shell.robot.session
                refused = session.teleoperation.tell(velocity, session.now_s)
                if refused:
                    self._say(f"Not driven: {refused}.")
                self._end(client, asked.number, ExitStatus.FAILED if refused else ExitStatus.DONE)
                return
            case m.Await(jobs=jobs):
                self._wait(client, asked.number, jobs)
                return
            case m.Watch():
                self._begin_to_watch(client, asked)
            case m.Down():
                self._shell.stop("the robot is to be down")
                self.left.set()
        self._end(client, asked.number, ExitStatus.DONE)

    def _stop(self, asked: m.Press) -> None:
        why = printable_line(asked.why) or ELSEWHERE
        if asked.quiet and not self._busy and self._shell.asked is None:
            self._shell.stop_unsaid(why)
        else:
            self._shell.stop(why)

    def _press(self, button: m.Button) -> None:
        shell = self._shell
        match button:
            case "stop":
                shell.stop(ELSEWHERE)
            case "estop":
                shell.stop_at_once("estop")
            case "release" | "reset":
                shell.stop_at_once(f"estop {button}")
            case "pause" | "resume" | "cancel":
                shell.command(button)

    def _take(self, client: Client, asked: m.Say) -> None:
        """A line: a stop and a halt act here, whatever else is being worked off."""
        shell = self._shell
        stops = shell.stops_by(asked.begun_s) if asked.stops is None else asked.stops
        told = f"(shell) > {printable_line(asked.text)}"
        self._out(told)
        self._log.append(told)
        self._recent.append(told)
        self._tell_watchers(m.Words(text=told), but=client)
        if (asked.spoken or asked.afar) and undoes(asked.text):
            self._say(AT_THE_ROBOT)
            self._end(client, asked.number, ExitStatus.INVALID)
            return
        if shell.stop_at_once(asked.text):
            self._end(client, asked.number, ExitStatus.DONE)
            return
        if asked.text.strip().casefold() in LEAVING:
            self._say(NOT_LEFT)
            self._end(client, asked.number, ExitStatus.INVALID)
            return
        shell.halt_at_once(asked.text, busy=self._busy)
        with self._lock:
            full = self._open_lines >= MOST_LINES
            self._open_lines += not full
        if full:
            self._here.asker = _Asker(client, asked.number, aside=True)
            self._say("Too many lines at once: that one is left out.")
            self._end(client, asked.number, ExitStatus.INVALID)
            return
        self._worker.submit(self._line, client, asked, stops)

    def _line(self, client: Client, asked: m.Say, stops: int) -> None:
        """One line, in the worker's thread, which alone works lines off."""
        shell = self._shell
        self._here.asker = _Asker(client, asked.number, aside=False)
        jobs: list[int] = []
        self._here.jobs = jobs
        refused, asked_back, open_before = shell.refused, shell.asked_back, shell.asked
        status = ExitStatus.DONE
        try:
            if not asked.spoken:
                shell.line(asked.text, stops=stops, afar=asked.afar)
            elif not shell.help(asked.text):
                shell.hear(asked.text, stops=stops)
        except Exception as error:  # in this software: the robot goes on
            self._say(as_mistake(error))
            status = ExitStatus.BROKEN
        finally:
            self._here.asker = None
            with self._lock:
                self._open_lines -= 1
        asks = shell.asked_back > asked_back or (shell.asked and shell.asked != open_before)
        if shell.refused > refused or (asks and not jobs):
            stopped = shell.stops != stops
            status = max(status, ExitStatus.FAILED if stopped else ExitStatus.INVALID)
        if jobs:
            client.send(m.line_of(m.Queued(number=asked.number, jobs=tuple(jobs))))
        if jobs and asked.wait and not status:
            self._wait(client, asked.number, tuple(jobs))
        else:
            self._end(client, asked.number, status)

    def _note_job(self, number: int) -> None:
        """A job that a line led to, in the thread of that line."""
        with suppress(AttributeError):  # another thread's has none
            self._here.jobs.append(number)

    def _wait(self, client: Client, number: int, jobs: tuple[int, ...]) -> None:
        with self._lock:
            is_taken = sum(wait.client is client for wait in self._waits) < MOST_WAITS
            if is_taken:
                self._waits.append(_Wait(client, number, jobs))
        if not is_taken:
            text = f"Not waited for: you wait for {MOST_WAITS} things already."
            client.send(m.line_of(m.Words(number=number, text=text)))
            self._end(client, number, ExitStatus.INVALID)

    def _begin_to_watch(self, client: Client, asked: m.Watch) -> None:
        shell = self._shell
        rows = tuple(
            views.Row(
                name=one.name, usage=one.usage, summary=one.summary,
                choices=tuple(one.choices()), takes_sentence=one.takes_sentence,
            )
            for one in shell.commands.values()
        )  # fmt: skip
        hello = views.Hello(
            number=asked.number, pid=os.getpid(), run=self._running.run, robot=self._running.robot,
            world=self._running.world, vocabulary=shell.dialogue.vocabulary, commands=rows,
            stops=shell.stops, stops_begun=shell.stops_by(asked.begun_s),
        )  # fmt: skip
        client.send(m.line_of(hello))
        for text in tuple(self._recent) if asked.views and asked.recent else ():
            client.send(m.line_of(m.Words(number=asked.number, text=text)))
        with self._telling:  # so that no change is missed, nor told before what was so before
            self._tell_changes()
            client.send(m.line_of(self._seen or views.Seen(view=shell.robot.view, busy=True)))
            client.send(m.line_of(self._asks))
            client.send(m.line_of(m.Stopped(stops=self._stops)))
            with self._lock:
                self._watching[client] = asked

    def _forget(self, client: Client) -> None:
        with self._lock:
            self._watching.pop(client, None)
            self._waits = [wait for wait in self._waits if wait.client is not client]

    def _standing(self) -> m.Standing:
        robot, view, running = self._shell.robot, self._shell.robot.view, self._running
        asked = self._shell.asked
        return m.Standing(
            name=self._place.name, run=running.run, robot=running.robot, world=running.world,
            runtime=running.runtime, pid=running.pid,
            state="gone" if robot.lost else robot.executive.state,
            mode=view.mode, health=view.unwell, asks=asked[0] if asked else "",
            ready=is_ready(view, fast=running.runtime == "fast"),
            estop=robot.executive.estop.latched, time_s=round(view.time_s, 2), pose=view.pose,
            held=view.held,
            jobs=tuple(
                m.Waiting(number=job.number, state=job.state, text=job.text, urgent=job.urgent)
                for job in robot.executive.jobs
                if job.state not in OVER
            ),
        )  # fmt: skip
