"""A map with two cups, a bottle, a box too wide to hold, a shelf with two boards, two people."""

from __future__ import annotations

from executive.meaning.request import Setting
from robot import messages as m
from robot.model.description import load
from robot.reality.contract import Reality
from robot.se3 import SE3
from tests.fakes.puppet import Thing
from tests.fakes.puppet_runtime import SensingPuppet

JUNO = load("juno")


def world_map() -> m.WorldMap:
    """The map itself."""

    def surface(place_id: str, name: str, x_m: float, z_m: float, **more: object) -> m.Place:
        X_WP = SE3((x_m, 0.0, z_m))
        return m.Place(id=place_id, name=name, X_WP=X_WP, size_m=(0.6, 1.0), **more)  # type: ignore

    def item(object_id: str, name: str, color: str, size: float, **more: object) -> m.ObjectInfo:
        shape = m.Shape(kind="cylinder", size_m=(size, size, 0.1))
        category = str(more.get("category", "dish"))
        mass_kg = float(more.get("mass_kg", 0.2))  # type: ignore
        return m.ObjectInfo(
            id=object_id, name=name, category=category, color=color, shape=shape, mass_kg=mass_kg
        )

    room = m.Place(
        id="kitchen", name="kitchen", X_WP=SE3(), size_m=(6, 6), room="kitchen", floor=True
    )
    return m.WorldMap(
        stamp_s=0.0,
        name="test world",
        obstacles=(m.Obstacle(id="shelf", name="shelf", X_WO=SE3((-2, 0, 0)), shapes=()),),
        places=(
            surface("table", "table", 2.0, 0.7, of="table", synonyms=("desk",)),
            surface("shelf_lower", "lower shelf", -2.0, 0.35, of="shelf"),
            surface("shelf_upper", "upper shelf", -2.0, 0.85, of="shelf", clearance_m=0.4),
            surface("loft", "loft", -1.0, 1.9, of="loft"),
            room,
        ),
        objects=(
            item("cup_red", "cup", "red", 0.07),
            item("cup_blue", "blue cup", "blue", 0.07),
            item("bottle", "bottle", "green", 0.06, category="drink", mass_kg=0.4),
            item("crate", "crate", "brown", 0.3, category="box"),
            item("anvil", "anvil", "black", 0.08, category="tool", mass_kg=9.0),
        ),
        people=(
            m.PersonInfo(id="ann", name="Ann", X_WO=SE3((0.0, 2.0, 0.0))),
            m.PersonInfo(id="operator", name="operator", X_WO=SE3((0.0, -2.0, 0.0))),
        ),
        categories={"dish": "dishes", "drink": "drinks", "box": "boxes", "tool": "tools"},
        bounds_m=(-3, -3, 3, 3),
    )


def puppet() -> SensingPuppet:
    """A puppet in that world, cups and bottle on the table."""
    things = {
        name: Thing(name, SE3((1.8, y_m, 0.75)), seen_s=0.0)
        for name, y_m in (("cup_red", 0.2), ("cup_blue", -0.2), ("bottle", 0.0))
    }
    return SensingPuppet(JUNO, things, world_map())


EYES: m.EyesBy = "oracle"
LOCALISATION: m.LocalisedBy = "oracle"


class MappedWorld:
    """A world that is a map and nothing more: for what is meant, not for what is done."""

    def __init__(self, name: str = "test", *, localisation: m.LocalisedBy = LOCALISATION) -> None:
        self.name = name
        self.vary_seed = None
        self.profile, self.eyes = "ideal", EYES
        self.localisation: m.LocalisedBy = localisation
        self.map = world_map()

    def content(self) -> bytes:
        return b""

    def seen_by(self, _eyes: m.EyesBy) -> MappedWorld:
        return self

    def localised(self, by: m.LocalisedBy) -> MappedWorld:
        return MappedWorld(self.name, localisation=by)


class Mapped:
    """A reality of such worlds, whatever is asked for."""

    profile, eyes = "ideal", EYES

    def __init__(self, localisation: m.LocalisedBy = LOCALISATION) -> None:
        self.localisation: m.LocalisedBy = localisation

    def under(
        self,
        profile: str,
        *,
        eyes: m.EyesBy = EYES,
        localisation: m.LocalisedBy = LOCALISATION,
    ) -> Mapped:
        return Mapped(localisation)

    def names(self) -> list[str]:
        return ["test"]

    def world(self, name_or_path: str, *, vary_seed: int | None = None) -> MappedWorld:
        return MappedWorld(name_or_path, localisation=self.localisation)


def mapped(
    reality: Reality | None, world: str, *, robot: str = "juno", vary_seed: int | None = None
) -> Setting:
    """In place of `executive.meaning.request.setting`: such a world, whatever is asked for."""
    there = Mapped(LOCALISATION if reality is None else reality.localisation)
    return Setting(
        reality=there, world=there.world(world), description=load(robot), robot_name=robot
    )


WHERE = mapped(None, "test")
