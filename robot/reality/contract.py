"""What the software asks of reality: a world to read, and a plant that a robot is tried out in.

`sim.simulation.Simulation` fulfils it; it is chosen in one place
(`executive.frontends.composition_root`), and everybody else is handed it. What stands here is all
that is known outside of what lies behind it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from robot.bus.topics import Topic
from robot.closing import Closing
from robot.drivers.wiring import SimulatedPlant
from robot.messages import AskedEyes, EyesBy, LocalisedBy, Message, WorldMap
from robot.model.description import RobotDescription
from robot.reality.faults import Fault
from robot.reality.studio import Renderer, RobotCamera, Studio
from robot.reality.truth import Check, Verdict
from robot.reality.visual_scene import VisualScene
from robot.se3 import SE3, Vector3

IDEAL = "ideal"
"""The profile in which nothing is off but for white noise."""
USUAL = "real"
"""Where nothing else is said: no kinder than what a robot lives in (docs/realities.md)."""


class Reality(Protocol):
    """Where worlds come from. A value without a state: it can be pickled, and sent to a worker."""

    @property
    def profile(self) -> str:
        """How far robots and senses there are from their descriptions, by name."""
        ...

    @property
    def eyes(self) -> AskedEyes:
        """Who is to tell robots there where the things are (docs/perception.md).

        "auto" is settled where world and robot come together (`executive.meaning.request`).
        """
        ...

    @property
    def localisation(self) -> LocalisedBy:
        """Who tells robots there where they are (docs/localisation.md)."""
        ...

    def under(
        self, profile: str, *, eyes: AskedEyes = "oracle", localisation: LocalisedBy = "oracle"
    ) -> Reality:
        """The same with another profile (docs/realities.md), other eyes, another localisation.

        Raises:
            ConfigError: there is none of that name, with the nearest one.
        """
        ...

    def names(self) -> list[str]:
        """Names of the shipped worlds."""
        ...

    def world(self, name_or_path: str, *, vary_seed: int | None = None) -> World:
        """A world by name or path, with its start and objects shuffled if a seed is given.

        `flat:7` is the home that is made of the kind `flat` and the seed 7.

        Raises:
            ConfigError: with everything that is wrong in the file.
        """
        ...

    def home_kinds(self) -> list[str]:
        """Kinds of homes that can be made."""
        ...

    def home(
        self,
        kind: str,
        *,
        seed: int,
        file: str,
        rooms: int | None = None,
        things: int | None = None,
        is_lived_in: bool = False,
        has_forms: bool = False,
    ) -> Home:
        """Make a home, always the same of a kind and a seed.

        Args:
            kind: one of `home_kinds`.
            seed: of everything random.
            file: the world's file, as the tasks name it.
            rooms: how many; None: as usual for the kind.
            things: how many; None: as usual.
            is_lived_in: as untidy as where people live.
            has_forms: with things that have their real forms.

        Raises:
            ConfigError: there is no such kind, with the nearest name, or none of that size.
        """
        ...

    def things(self) -> list[ThingKind]:
        """Kinds of things with real forms that a world may have."""
        ...

    def save_sheet(self, path: Path, *, variant: int = 0) -> None:
        """Draw all of them, and write that as PNG, or as JPEG where its name says so.

        Raises:
            OSError: if the file cannot be written.
        """
        ...

    def cast(self, kind: str, *, seed: int) -> Cast:
        """Who plays the roles of a campaign's cases in a home that is made.

        Raises:
            ConfigError: as `home` does.
        """
        ...

    def check_motors(self, robot: RobotDescription, driver: str) -> None:
        """Whether it can emulate the motors of a robot behind their buses.

        Args:
            robot: with joint maps that can be read.
            driver: of its motors; one that needs no bus needs no emulation.

        Raises:
            ConfigError: with all that it cannot.
        """
        ...

    def motors(
        self, file: Path, *, flaws: Mapping[str, str], is_still: bool = False
    ) -> EmulatedBuses:
        """Emulate the motors of a joint map; it begins by entering.

        Args:
            file: the joint map.
            flaws: what is wrong with whom, by joint.
            is_still: whether they rest, and do not swing a little.

        Raises:
            ConfigError: with everything that is wrong in the file or in the flaws.
        """
        ...


class EmulatedBuses(Closing, Protocol):
    """Emulated buses or ports of a joint map, in a process of their own until closed."""

    @property
    def channels(self) -> Mapping[str, str]:
        """What each bus of the joint map is reached by there."""
        ...


class Home(NamedTuple):
    """A made home: the texts of a world file, and of a file of tasks in it."""

    world: str
    tasks: str


class ThingKind(NamedTuple):
    """A kind of thing: its name in a world file, and what people call it.

    Attributes:
        size_m: of the usual one, without what sticks out of it.
        mass_kg: from and to.
        colors: that it has, the usual one first.
        source: where its size is from.
    """

    name: str
    category: str
    family: str
    size_m: Vector3
    mass_kg: tuple[float, float]
    colors: tuple[str, ...]
    source: str


class Cast(NamedTuple):
    """What the roles of a campaign's cases stand for in a home (`executive.evaluation.roles`).

    Attributes:
        roles: plain data by role.
        vacant: roles that nothing there can play, and why.
    """

    roles: Mapping[str, Any]
    vacant: Mapping[str, str]


class Begin(NamedTuple):
    """Where an object is before anything moved: its pose, and the id of the place it is on."""

    X_WO: SE3
    place_id: str


class World(Protocol):
    """A world as it was read: the robot is told its map, and nothing else of it."""

    @property
    def name(self) -> str:
        """As it was asked for: the name of a shipped world, or the path of a file."""
        ...

    @property
    def vary_seed(self) -> int | None:
        """What it was shuffled by; with the name all that another process needs to read it."""
        ...

    @property
    def profile(self) -> str:
        """Of the reality it was read from (`Reality.under`)."""
        ...

    @property
    def eyes(self) -> EyesBy:
        """Of the reality it was read from."""
        ...

    @property
    def localisation(self) -> LocalisedBy:
        """Of the reality it was read from."""
        ...

    @property
    def map(self) -> WorldMap:
        """The prior map: what is there, but not where the objects are."""
        ...

    def content(self) -> bytes:
        """Everything in it, for a hash: the same worlds give the same bytes."""
        ...

    def objects(self) -> Mapping[str, Begin]:
        """Where every object begins (oracle), by id."""
        ...

    def nudged(self, seed: int, *, start: tuple[float, float, float] | None = None) -> World:
        """The same world, begun a little otherwise: for many runs of one short mission.

        Args:
            seed: of the draw; the same seed gives the same world.
            start: where the robot starts (x [m], y [m], heading [deg]) in place of its start.
        """
        ...

    def seen_by(self, eyes: EyesBy) -> World:
        """The same world, in which another tells robots where the things are."""
        ...

    def localised(self, by: LocalisedBy) -> World:
        """The same world, in which robots are told by another where they are."""
        ...

    def verify(self, fault: Fault, robot: RobotDescription) -> None:
        """Check every name in a fault. Raises ConfigError with the nearest name."""
        ...

    def scene(self, robot: RobotDescription) -> VisualScene:
        """What it looks like with a robot in it. Raises RobotError if they do not fit together."""
        ...

    def studio(self, robot: RobotDescription, *, width: int, height: int) -> Studio:
        """Where pictures of it are taken, of so many pixels.

        Raises:
            RobotError: if they do not fit together; on entering, if nothing can be rendered here.
        """
        ...

    def plant(self, robot: RobotDescription, *, seed: int, physics_ms: int = 1) -> Plant:
        """The world with a robot in it, which stands at its start.

        Args:
            robot: who is there.
            seed: of everything random.
            physics_ms: time step of the physics, 1 or 2.

        Raises:
            RobotError: if they do not fit together.
        """
        ...


class Plant(SimulatedPlant, Protocol):
    """A robot in its world: `step` advances whole milliseconds, `sense` gives what is due."""

    def step(self, count: int = 1) -> None:
        """Advance; raises DriverError if the physics diverged."""
        ...

    def sense(self, now_s: float) -> Sequence[tuple[Topic[Any], Message]]:
        """Topics and messages of the sensors that are due."""
        ...

    def hear(self, text: str) -> None:
        """Let the people who stand near hear what the robot says."""
        ...

    def suffer(self, fault: Fault) -> None:
        """Let a fault happen now. Raises ConfigError if it names what is not there."""
        ...

    def watch(self) -> None:
        """Note from now on, for `judge`, where the robot goes, what it touches and says."""
        ...

    def leave_trail(self, path: Path) -> Closing:
        """Write how everything truly moves into a file (`robot.reality.trail`) until closed."""
        ...

    def judge(self, checks: Iterable[Check]) -> Verdict:
        """How it truly is, and was since `watch`.

        Raises:
            ConfigError: if a check names what is not there.
        """
        ...

    def X_WB(self) -> SE3:
        """Where its base truly is now: for recordings and judges; no robot reads it."""
        ...

    def stand(self, X_WS: SE3) -> None:
        """Put the robot, at rest, with its soles' midpoint at X_WS (x, y, yaw)."""
        ...

    def pose(self, angles: Mapping[str, float]) -> None:
        """Put motors that turn, at rest, to such angles [rad] at once: for pictures.

        Raises:
            ConfigError: there is no such motor, with the nearest name, or it does not go so far.
        """
        ...

    def camera(
        self, *, renderer: Renderer = "auto", size: tuple[int, int] | None = None
    ) -> RobotCamera:
        """The robot's camera, which takes pictures only when asked to.

        Args:
            renderer: how it is imitated.
            size: width and height [px] in place of the description's, the same field of view.
        """
        ...

    def save_picture(self, path: Path) -> None:
        """Write a picture of all of it as PNG, or as JPEG where its name says so.

        Raises:
            ConfigError: if nothing can be rendered here, with the cure.
            OSError: if the file cannot be written.
        """
        ...

    def show(self) -> None:
        """Open a window on it, until that is closed. Raises ConfigError if there can be none."""
        ...
