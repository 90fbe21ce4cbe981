"""World files that name things of the catalogue: what they may leave out, and what is wrong."""

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest

from executive.skills.pick import Pick, PickParams
from robot.errors import ConfigError
from robot.model.description import load
from sim import atlas, placing, world
from sim.camera.by_rays import Tracer
from sim.camera.scene_view import Pinhole
from sim.homes import formed
from sim.homes.home import home
from sim.homes.writing import world_yaml
from sim.simulation import SimulatedWorld, Simulation
from sim.thing_bodies import TOUCHING
from sim.things.making import made

TEXT = """\
name: parlour
rooms:
  - {id: parlour, at_m: [0, 0], size_m: [4, 4]}
furniture:
  - {id: table, kind: table, at_m: [1.0, 0]}
objects:
  - {id: my_mug, kind: mug, color: teal, on: table, at_m: [0.1, -0.3], yaw_deg: 90}
  - {id: merlot, kind: wine_bottle, variant: 4, on: table, at_m: [0, 0]}
  - {id: apple, kind: apple, on: table, at_m: [0.1, 0.3]}
"""


@pytest.fixture
def read(tmp_path: Path):
    def read_text(text: str) -> world.World:
        path = tmp_path / "parlour.yaml"
        path.write_text(text, encoding="utf-8")
        return world.load(str(path))

    return read_text


def test_a_kind_says_what_the_file_leaves_out(read):
    mug, wine, apple = read(TEXT).objects
    assert (mug.category, mug.color, mug.shape) == ("mug", "teal", "cylinder")
    assert mug.size_m == made("mug").size_m
    assert wine.category == "wine bottle"
    assert wine.size_m == made("wine_bottle", 4).size_m != made("wine_bottle").size_m
    assert wine.mass_kg == pytest.approx(made("wine_bottle", 4).mass_kg, abs=1e-4)
    assert apple.color == "red"


def test_the_map_has_form_and_words(read):
    found = atlas.world_map(read(TEXT))
    assert found.categories["wine bottle"] == "wine bottles"
    mug, wine, _ = found.objects
    assert len(mug.shape.sticking_out) == 1
    assert len(wine.shape.held_pieces) == 2


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("kind: mug", "kind: mugg", 7, "unknown kind 'mugg' (did you mean 'mug'?)"),
        ("kind: mug", "kind: mug, mass_kg: 0.3", 7, "a thing of a kind has its own mass_kg"),
        ("kind: mug", "kind: mug, shape: box", 7, "a thing of a kind has its own shape"),
        ("variant: 4", "variant: -1", 8, "variant is -1, and must be"),
        ("variant: 4", "variant: four", 8, "variant is 'four'"),
        ("color: teal", "color: teel", 7, "unknown color 'teel'"),
        ("yaw_deg: 90", "lies: true", 7, "my mug is not round all about, and does not lie"),
        ("at_m: [0.1, -0.3]", "at_m: [0.28, -0.3]", 7, "does not fit there on the table"),
        ("on: table, at_m: [0, 0]", "on: tabel, at_m: [0, 0]", 8, "unknown place 'tabel'"),
    ],
)
def test_every_mistake_has_its_line(read, old, new, line, message):
    with pytest.raises(ConfigError) as error:
        read(TEXT.replace(old, new, 1))
    assert f"parlour.yaml:{line}:" in str(error.value)
    assert message in str(error.value)
    assert len(error.value.problems) == 1


def test_a_handle_needs_room(read):
    mug, wine, _ = read(TEXT).objects
    assert placing.radius_m(mug) > mug.size_m[0] / 2 + 0.02
    assert placing.radius_m(wine) == pytest.approx(wine.size_m[0] / 2, abs=0.002)


def test_a_world_without_kinds_is_told_as_before(read):
    """What is hashed of a world has no keys that it does not use: journals stay comparable."""
    plain = json.loads(SimulatedWorld(world.load("kitchen")).content())
    assert all("kind" not in item and "variant" not in item for item in plain["objects"])
    formed_ = json.loads(SimulatedWorld(read(TEXT)).content())
    assert [item["kind"] for item in formed_["objects"]] == ["mug", "wine_bottle", "apple"]


def test_the_body_has_the_things_mass_and_inertia(read):
    plant = SimulatedWorld(read(TEXT)).plant(load("juno"), seed=0)
    body = plant.model.body("object/merlot")
    matter = made("wine_bottle", 4).matter
    assert body.mass[0] == pytest.approx(matter.mass_kg, rel=1e-6)
    assert body.ipos == pytest.approx(matter.middle, abs=1e-9)
    wanted = np.sort(np.linalg.eigvalsh(matter.inertia))
    assert np.sort(body.inertia) == pytest.approx(wanted, rel=1e-5)


def test_what_is_seen_is_the_form_and_what_touches_is_not_seen(read):
    """From above, one looks into the mug down to its floor; its contacts are in a hidden group."""
    plant = SimulatedWorld(read(TEXT)).plant(load("juno"), seed=0)
    model, data = plant.model, plant.data
    at = data.body("object/my_mug").xpos
    own = model.geom_bodyid == model.body("object/my_mug").id
    assert set(model.geom_group[own & (model.geom_contype > 0)]) == {TOUCHING}
    eye, down = at + np.array([0.0, 0.0, 0.3]), np.array([0.0, 0.0, -1.0])
    groups = np.array([1, 1, 1, 0, 1, 0], dtype=np.uint8)
    geom = np.zeros(1, dtype=np.int32)
    far = mujoco.mj_ray(model, data, eye, down, groups, True, -1, geom)
    assert own[geom[0]]
    assert far == pytest.approx(0.3 + 0.095 / 2 - 0.007, abs=0.002)


def test_a_print_is_seen_by_rays_the_right_way_round():
    """A ray at each quarter of a banded can sees what the picture has there."""
    spec = mujoco.MjSpec()
    thing = made("soup_can")
    look = next(look for look in thing.looks if look.picture is not None)
    picture = np.zeros((8, 64, 3), dtype=np.uint8)
    for quarter, color in enumerate(((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255))):
        picture[:, 16 * quarter : 16 * (quarter + 1)] = color
    from sim.paint import Paint
    from sim.thing_bodies import shape

    body = spec.worldbody.add_body(name="can")
    banded = thing._replace(looks=(look._replace(picture=picture),))
    shape(body, spec, banded, Paint(spec))
    spec.visual.headlight.ambient[:] = [1.0, 1.0, 1.0]
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    tracer = Tracer(model, data, Pinhole(5, 5, 50.0))
    for quarter, brightest in enumerate(({0}, {1}, {2}, {0, 1, 2})):
        angle = (quarter + 0.5) * np.pi / 2
        out = np.array([np.cos(angle), np.sin(angle), 0.0])
        right, below = np.array([-out[1], out[0], 0.0]), np.array([0.0, 0.0, -1.0])
        seen = tracer.look(0.5 * out, np.column_stack([right, below, -out])).light[2, 2]
        assert {k for k in range(3) if seen[k] > 0.5 * seen.max()} == brightest


def test_a_home_with_real_things_is_a_world_again(read):
    made_home = home("cafe", 5, has_forms=True)
    assert sum(bool(item.kind) for item in made_home.world.objects) >= 5
    again = read(world_yaml(made_home, head="made"))
    assert {item.id: item.mass_kg for item in again.objects} == pytest.approx(
        {item.id: item.mass_kg for item in made_home.world.objects}, abs=1e-3
    )
    assert [item.kind for item in again.objects] == [o.kind for o in made_home.world.objects]


def test_homes_without_them_have_none():
    assert not any(item.kind for item in home("cafe", 5).world.objects)


def test_every_form_of_a_good_is_one_that_a_hand_can_take():
    for name in (*formed.FORMS.values(), *formed.MORE):
        thing = made(name)
        widths = [min(piece.size_m[:2]) for piece in thing.pieces if piece.is_held]
        assert min(widths or [min(thing.size_m[:2])]) <= 0.088


def test_the_list_says_what_each_kind_weighs():
    found = {one.name: one for one in Simulation().things()}
    assert len(found) >= 40
    low, high = found["milk_carton"].mass_kg
    assert 0.05 < low < high < 1.0
    assert all(one.source for one in found.values())


@pytest.mark.parametrize(
    ("kind", "cause"),
    [("dinner_plate", "26 cm wide, the hand opens"), ("cereal_bowl", "16 cm wide"), ("mug", "")],
)
def test_what_no_hand_takes_is_refused_with_the_reason(read, kind, cause):
    text = TEXT.replace("kind: apple", f"kind: {kind}").replace(
        "at_m: [0.1, 0.3]", "at_m: [0, 0.4]"
    )
    found = SimulatedWorld(read(text)).map
    refusal = Pick.refusal(PickParams(object_id="apple"), found, load("juno"))
    assert (refusal is not None) is bool(cause)
    assert refusal is None or cause in refusal.cause
