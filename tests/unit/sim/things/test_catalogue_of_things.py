"""The catalogue: many kinds, closed, hollow, of sensible weight, the same again for a number."""

import mujoco
import numpy as np
import pytest

from robot.errors import ConfigError
from robot.messages import Shape
from sim import assembly, atlas
from sim.palette import COLORS
from sim.things import catalogue
from sim.things.making import made
from sim.things.materials import MATERIALS
from sim.world_schema import Furniture, Object, Room, World

KINDS = list(catalogue.kinds())
SETTLE_S, REST_S = 0.2, 10.0


def test_there_are_forty_kinds_in_seven_families():
    assert len(KINDS) >= 40
    assert len(catalogue.families()) == 7
    assert all(len(kinds) >= 5 for kinds in catalogue.families().values())


def test_no_two_kinds_are_called_the_same():
    assert len({catalogue.category(name) for name in KINDS}) == len(KINDS)


@pytest.mark.parametrize("name", KINDS)
def test_every_part_is_closed_and_weighs_something(name):
    for variant in (0, 3):
        thing = made(name, variant)
        for look in thing.looks:
            assert look.mesh.is_watertight()
            assert look.mesh.volume_m3 > 0.0
            assert look.color in COLORS
        assert 0.01 < thing.mass_kg < 1.0
        x, y, z = np.linalg.eigvalsh(thing.matter.inertia)
        assert x > 0.0
        assert x + y >= z * (1.0 - 1e-6)  # else no body has it


@pytest.mark.parametrize("name", KINDS)
def test_the_shape_that_is_told_holds_what_is_seen(name):
    """All but what sticks out is inside; it stands on its foot; pieces are within its height."""
    thing = made(name, 5)
    shape = Shape(kind=thing.shape, size_m=thing.size_m, pieces=thing.pieces)
    points = np.concatenate([look.mesh.points for look in thing.looks])
    assert points[:, 2].min() == pytest.approx(-thing.size_m[2] / 2, abs=0.001)
    assert np.linalg.norm(points[:, :2], axis=1).max() <= shape.radius_m + 0.004
    for piece in thing.pieces:
        assert abs(piece.X_ShapePiece.p[2]) + piece.size_m[2] / 2 <= thing.size_m[2] / 2 + 0.001


def test_a_number_is_always_the_same_thing_and_others_are_not():
    made.cache_clear()
    first = made("mug", 7)
    made.cache_clear()
    again, other = made("mug", 7), made("mug", 8)
    assert first.size_m == again.size_m
    assert first.mass_kg == again.mass_kg
    for one, two in zip(first.looks, again.looks, strict=True):
        assert np.array_equal(one.mesh.points, two.mesh.points)
        assert (one.picture is None) == (two.picture is None)
        assert one.picture is None or np.array_equal(one.picture, two.picture)
    assert other.size_m != first.size_m
    assert {made("mug", k).color for k in range(7)} == set(catalogue.kind("mug").colors)


def test_a_cup_is_hollow_and_a_full_bottle_heavier_than_an_empty_one():
    glass = made("tumbler")
    solid = MATERIALS["glass"].density_kg_m3 * np.pi * 0.036**2 * 0.11
    assert glass.mass_kg < 0.3 * solid
    masses = [made("water_bottle", k).mass_kg for k in range(1, 12)]
    assert max(masses) > 1.5 * min(masses)


def test_an_unknown_kind_is_told_with_the_nearest():
    with pytest.raises(ConfigError, match="did you mean 'mug'"):
        made("mugg")


@pytest.mark.parametrize(
    ("name", "held"),
    [("wine_bottle", 2), ("mug", 1), ("apple", 1), ("soup_can", 1), ("dinner_plate", 0)],
)
def test_a_hand_closes_on_upright_sides(name, held):
    shape = Shape(kind="cylinder", size_m=made(name).size_m, pieces=made(name).pieces)
    assert len(shape.held_pieces) == held


def test_only_what_has_a_handle_is_not_round():
    item = Object(id="it", category="", color="red", shape="cylinder", size_m=(1, 1, 1),
                  mass_kg=1.0, on="table")  # fmt: skip
    round_, bowed = (atlas.shape_of(_of(item, name)) for name in ("wine_bottle", "mug"))
    assert round_.is_round
    assert not round_.sticking_out
    assert not bowed.is_round
    assert len(bowed.sticking_out) == 1
    assert bowed.radius_m == pytest.approx(0.07, abs=0.005)


def _of(item: Object, name: str) -> Object:
    thing = made(name)
    return Object(id=item.id, category=thing.category, color=thing.color, shape=thing.shape,
                  size_m=thing.size_m, mass_kg=thing.mass_kg, on=item.on, at_m=(0.0, 0.0),
                  kind=name)  # fmt: skip


@pytest.mark.parametrize("name", ["mug", "orange", "wine_glass", "fork", "lemon", "milk_carton"])
def test_it_stands_where_it_is_put(name):
    """Awake for 10 s, it moves by less than 2 mm and turns by less than a degree."""
    item = _of(Object(id=name, category="", color="red", shape="box", size_m=(1, 1, 1),
                      mass_kg=1.0, on="table"), name)  # fmt: skip
    model = _scene(item, asleep=False)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=round(SETTLE_S / model.opt.timestep))
    body = data.body(f"object/{name}")
    at, way = body.xpos.copy(), body.xmat.copy()
    mujoco.mj_step(model, data, nstep=round(REST_S / model.opt.timestep))
    assert np.linalg.norm(body.xpos - at) < 0.002
    assert (body.xmat @ way - 1.0) / 2.0 > np.cos(np.radians(1.0))


def test_something_falls_into_a_cup_and_stays_there():
    mug = _of(Object(id="mug", category="", color="red", shape="box", size_m=(1, 1, 1),
                     mass_kg=1.0, on="table"), "mug")  # fmt: skip
    spec = _spec(mug, asleep=False)
    ball = spec.worldbody.add_body(name="ball", pos=[0.0, 0.0, 0.72 + 0.16])
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.015, 0, 0], mass=0.01, condim=6)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=2000)
    x, y, z = data.body("ball").xpos
    assert np.hypot(x, y) < 0.03
    assert 0.72 + 0.007 < z < 0.72 + 0.04


def _scene(item: Object, *, asleep: bool) -> mujoco.MjModel:
    return _spec(item, asleep=asleep).compile()


def _spec(item: Object, *, asleep: bool) -> mujoco.MjSpec:
    world = World(
        name="rest",
        rooms=(Room(id="room", at_m=(0.0, 0.0), size_m=(3.0, 3.0)),),
        furniture=(Furniture(id="table", kind="table", at_m=(0.0, 0.0)),),
        objects=(item,),
    )
    spec = mujoco.MjSpec()
    assembly.set_physics(spec)
    if not asleep:
        spec.option.enableflags &= ~mujoco.mjtEnableBit.mjENBL_SLEEP.value
    assembly.furnish(spec, world)
    return spec
