"""The simulation as the rest of the software knows it: `robot.reality.contract`, fulfilled."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from robot.messages import AskedEyes, EyesBy, LocalisedBy
from robot.model.description import RobotDescription
from robot.reality.contract import IDEAL, USUAL, Begin, Cast, EmulatedBuses, Home, ThingKind
from robot.reality.faults import Fault
from robot.reality.studio import Studio
from robot.reality.visual_scene import VisualScene
from sim import atlas, placing, realities, world
from sim.homes import catalogue
from sim.things import catalogue as things
from sim.things.making import made
from sim.world_schema import World

if TYPE_CHECKING:
    from sim.judged_plant import JudgedPlant

_MADE = re.compile(r"(?P<kind>[a-z_]+):(?P<seed>[0-9]{1,9})")
"""The name of a home that is made."""
SOME = 8
"""Variants that say between what a kind weighs."""


class Simulation:
    """Shipped worlds, and anybody's own (docs/worlds.md), in MuJoCo.

    Attributes:
        profile: how far what is felt and done there is from what is described (`sim.realities`).
        eyes: who tells robots where the things are.
        localisation: who tells robots where they are.
    """

    def __init__(
        self,
        profile: str = USUAL,
        *,
        eyes: AskedEyes = "oracle",
        localisation: LocalisedBy = "oracle",
    ) -> None:
        """Raises ConfigError for a profile that is none."""
        realities.profile(profile)
        self.profile = profile
        self.eyes: AskedEyes = eyes
        self.localisation: LocalisedBy = localisation

    def under(
        self, profile: str, *, eyes: AskedEyes = "oracle", localisation: LocalisedBy = "oracle"
    ) -> Simulation:
        """The same under other conditions. Raises ConfigError, with the nearest name."""
        return Simulation(profile, eyes=eyes, localisation=localisation)

    def names(self) -> list[str]:
        """Names of the shipped worlds."""
        return world.available()

    def world(self, name_or_path: str, *, vary_seed: int | None = None) -> SimulatedWorld:
        """A world by name or path, or `KIND:SEED`; shuffled if a seed is given.

        Raises:
            ConfigError: as the contract says.
        """
        by_seed = _MADE.fullmatch(name_or_path)
        if by_seed:
            from sim.homes.home import home  # scipy's graphs, which nothing else here needs

            entries = home(by_seed["kind"], int(by_seed["seed"])).world
        else:
            entries = world.load(name_or_path)
        if vary_seed is not None:
            entries = placing.variation(entries, vary_seed)
        return SimulatedWorld(
            entries, name=name_or_path, vary_seed=vary_seed, profile=self.profile,
            eyes="oracle" if self.eyes == "auto" else self.eyes,
            localisation=self.localisation,
        )  # fmt: skip

    def home_kinds(self) -> list[str]:
        """Kinds of homes that can be made (sim/homes/kinds)."""
        return catalogue.names()

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
        """Make a home. Raises ConfigError for an unknown kind, and where none is that large."""
        from sim.homes.home import Size
        from sim.homes.made import made as made_home

        size = Size(rooms, things)
        return made_home(
            kind, seed, file=file, size=size, is_lived_in=is_lived_in, has_forms=has_forms
        )

    def things(self) -> list[ThingKind]:
        """What the catalogue of things has (sim/things/kinds)."""
        return [
            ThingKind(
                name=name, category=thing.category, family=family, size_m=thing.size_m,
                mass_kg=(min(masses), max(masses)), colors=kind.colors, source=kind.source,
            )
            for family, kinds in things.families().items()
            for name, kind in kinds.items()
            for thing in [made(name)]
            for masses in [[made(name, variant).mass_kg for variant in range(SOME)]]
        ]  # fmt: skip

    def save_sheet(self, path: Path, *, variant: int = 0) -> None:
        """Draw all of them. Raises OSError where the file cannot be written."""
        from sim.render import save_picture  # MuJoCo
        from sim.thing_sheet import sheet

        save_picture(path, sheet(things.kinds(), variant=variant))

    def cast(self, kind: str, *, seed: int) -> Cast:
        """Fill the roles of a campaign in a home. Raises ConfigError for an unknown kind."""
        from sim.homes.casting import cast
        from sim.homes.home import home

        return cast(home(kind, seed), seed)

    def check_motors(self, robot: RobotDescription, driver: str) -> None:
        """Whether it emulates a robot's motors. Raises ConfigError with all that it does not."""
        from sim import plant_buses  # and with it python-can, which nothing else here needs

        for joints in plant_buses.maps(robot, driver):
            if joints is not None:
                plant_buses.check(joints)

    def motors(
        self, file: Path, *, flaws: Mapping[str, str], is_still: bool = False
    ) -> EmulatedBuses:
        """Emulate the motors of a joint map. Raises ConfigError as `sim.devices.bench.build`."""
        from sim.devices.emulated import EmulatedMotors

        return EmulatedMotors(file, flaws=flaws, is_still=is_still)


class SimulatedWorld:
    """A world file as it was read and shuffled.

    Attributes:
        entries: of the file.
        name: by which it was asked for.
        vary_seed: what it was shuffled by.
        profile: of the reality it is in.
        eyes: who tells robots in it where the things are.
        localisation: who tells robots in it where they are.
        map: the prior map; where that is their own eyes, without sizes and masses of things.
    """

    def __init__(
        self,
        entries: World,
        *,
        name: str = "",
        vary_seed: int | None = None,
        profile: str = IDEAL,
        eyes: EyesBy = "oracle",
        localisation: LocalisedBy = "oracle",
    ) -> None:
        """Make the map."""
        self.entries = entries
        self.name = name or entries.name
        self.vary_seed = vary_seed
        self.profile = profile
        self.eyes: EyesBy = eyes
        self.localisation: LocalisedBy = localisation
        known = atlas.world_map(entries)
        self.map = known if eyes == "oracle" else known.told()

    def content(self) -> bytes:
        """Everything in it; keys that came later count only where they are used."""
        content = msgspec.to_builtins(self.entries)
        for item in content["objects"]:
            if not item["kind"]:
                del item["kind"], item["variant"]
        for person in content["people"]:
            if person["posture"] == "stands":
                del person["posture"]
        return msgspec.json.encode(content)

    def objects(self) -> Mapping[str, Begin]:
        """Where every object begins, by id."""
        poses = placing.object_poses(self.entries)
        return {item.id: Begin(poses[item.id], item.on) for item in self.entries.objects}

    def nudged(
        self, seed: int, *, start: tuple[float, float, float] | None = None
    ) -> SimulatedWorld:
        """The same, begun a little otherwise."""
        entries = placing.nudged(self.entries, seed, start=start)
        return SimulatedWorld(
            entries, name=self.name, vary_seed=self.vary_seed, profile=self.profile,
            eyes=self.eyes, localisation=self.localisation,
        )  # fmt: skip

    def seen_by(self, eyes: EyesBy) -> SimulatedWorld:
        """The same, with who tells robots in it where the things are."""
        return SimulatedWorld(
            self.entries, name=self.name, vary_seed=self.vary_seed, profile=self.profile,
            eyes=eyes, localisation=self.localisation,
        )  # fmt: skip

    def localised(self, by: LocalisedBy) -> SimulatedWorld:
        """The same, with who tells robots in it where they are."""
        return SimulatedWorld(
            self.entries, name=self.name, vary_seed=self.vary_seed, profile=self.profile,
            eyes=self.eyes, localisation=by,
        )  # fmt: skip

    def verify(self, fault: Fault, robot: RobotDescription) -> None:
        """Check every name in a fault. Raises ConfigError with the nearest name."""
        from sim import faults

        faults.verify(fault, self.entries, robot)

    def scene(self, robot: RobotDescription) -> VisualScene:
        """What it looks like. Raises RobotError as `sim.plant.Plant`."""
        from sim.scenery import scene

        return scene(self.plant(robot, seed=0))

    def studio(self, robot: RobotDescription, *, width: int, height: int) -> Studio:
        """Where pictures of it are taken. Raises RobotError as `sim.plant.Plant`."""
        from sim.filming import FilmStudio

        return FilmStudio(self.plant(robot, seed=0), width=width, height=height)

    def plant(self, robot: RobotDescription, *, seed: int, physics_ms: int = 1) -> JudgedPlant:
        """Build the scene and stand the robot in it. Raises RobotError as `sim.plant.Plant`."""
        from sim.judged_plant import JudgedPlant  # MuJoCo, which a list of worlds needs not

        return JudgedPlant(
            self.entries, robot, seed=seed, physics_ms=physics_ms, reality=self.profile,
            eyes=self.eyes, localisation=self.localisation,
        )  # fmt: skip
