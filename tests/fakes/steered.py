"""A shell that only notes what it is told, before a robot whose jobs end when a test says so."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import msgspec

from executive.engine.jobs import Job
from executive.frontends.prompt.view import View
from executive.frontends.since_boot import now_s
from intents.vocabulary import Vocabulary
from robot.errors import RobotError
from robot.failures import Failure
from tests.fakes.waiting import HANG_S


class Teleoperated:
    """Takes velocities, and says why they are not walked if it is told to."""

    def __init__(self):
        self.told: list[tuple[float, float, float]] = []
        self.answer = ""

    def tell(self, velocity, now_s):
        self.told.append(velocity)
        return self.answer


class Robot:
    """A robot with jobs, of which none goes on by itself."""

    def __init__(self):
        self.jobs: dict[int, Job] = {}
        self.on_submit = lambda number: None
        self.view = View()
        self.ended_before = ()
        self.lost: Failure | None = None
        self.executive = Executive(self.jobs)
        self.session = SimpleNamespace(teleoperation=Teleoperated(), now_s=0.0)

    @property
    def busy(self):
        return any(job.state == "running" for job in self.jobs.values())


class Executive:
    """Those jobs as an executive tells of them."""

    def __init__(self, jobs):
        self._jobs = jobs
        self.state = "idle"
        self.estop = SimpleNamespace(latched=False)

    @property
    def jobs(self):
        return tuple(self._jobs.values())


class Told:
    """A shell that only notes what it is told; lines say what comes of them."""

    def __init__(self):
        self.robot = Robot()
        self.said: list[str] = []
        self.out = self.said.append
        self.did: list[str] = []
        self.read_back: list[object] = []
        self.stops = self.refused = self.asked_back = 0
        self.stopped_s: list[float] = []
        self.asked: tuple[str, tuple[str, ...]] | None = None
        self.commands = {}
        self.dialogue = SimpleNamespace(vocabulary=Vocabulary())
        self.go_on = threading.Event()
        self.go_on.set()

    def stops_by(self, begun_s):
        return self.stops - sum(begun_s is not None and at_s > begun_s for at_s in self.stopped_s)

    def stop(self, why):
        self.stops += 1
        self.stopped_s.append(now_s())
        self.did.append("stop")
        self.out("Stopping.")

    def stop_unsaid(self, why):
        self.stops += 1
        self.did.append("stop, unsaid")

    def stop_at_once(self, text):
        if text.startswith("estop"):
            self.did.append(text)
            if text == "estop reset":
                raise RobotError("it is pressed")
            return True
        if text == "stop":
            self.stop("")
        return text == "stop"

    @property
    def asks(self):
        return self.asked is not None

    def halt_at_once(self, text, *, busy=None, spoken=False):
        if text == "wait":
            self.did.append("halt")
        return text == "wait"

    def command(self, name):
        self.did.append(name)
        self.out(f"of {name}")

    def line(self, text, *, stops=None, afar=False):
        self.go_on.wait(HANG_S)
        self.did.append(f"{text} ({stops})")
        match text:
            case "a mistake":
                raise ValueError("a mistake of this software")
            case "nonsense":
                self.refused += 1
                self.out("Not understood: nonsense")
            case "the cup":
                self.asked_back += 1
                self.asked = ("Which cup?", ("the red one", "the blue one"))
                self.out("Which cup?")
            case "where are you?":
                self.out("Here.")
            case _:
                self.begin(text)

    def hear(self, text, *, stops, risk=None):
        self.read_back.append(risk)
        self.line(text, stops=stops)

    def help(self, text):
        return False

    def begin(self, text):
        number = len(self.robot.jobs) + 1
        self.robot.jobs[number] = Job(number=number, text=text, state="running")
        self.robot.on_submit(number)

    def end(self, number, state="done", code=""):
        failure = Failure(code=code, cause="of that") if code else None
        job = msgspec.structs.replace(self.robot.jobs[number], state=state, failure=failure)
        self.robot.jobs[number] = job


class Log:
    """What would be written."""

    def __init__(self):
        self.lines: list[str] = []
        self.append = self.lines.append
