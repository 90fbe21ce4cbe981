"""People in a simulated world: what they hear, what they do about it, how hard they pull."""

import math

import msgspec
import mujoco
import numpy as np
import pytest

from robot.model import description
from robot.se3 import SE3
from sim import world
from sim.grip import PULL_N, Grip
from sim.people import AGAIN_S, wish_in
from sim.person_arm import PersonArm, links
from sim.plant import Plant
from sim.somebody import LOST_M
from sim.standing_room import (
    BACK_M,
    DOORSTEP_M,
    LANE_M,
    ROBOT_M,
    WALKING_M,
    WIDE_LANE_M,
    Around,
    in_the_way,
    way_out,
)
from sim.world_schema import Behaviour, Door, Room

JUNO = description.load("juno")
BENCH = world.load("bench")


def bench(*, behind_m: float = 0.95, **behaviour) -> Plant:
    """Anna stands behind the robot."""
    anna = msgspec.structs.replace(
        BENCH.people[0], at_m=(-behind_m, 0.0), yaw_deg=0.0, behaviour=Behaviour(**behaviour)
    )
    return Plant(msgspec.structs.replace(BENCH, people=(anna,)), JUNO, seed=3)


def let_pass(plant: Plant, duration_s: float) -> list:
    """Let time pass; what was said."""
    said = []
    for _ in range(round(duration_s / 0.02)):
        plant.step(20)
        said += [m for topic, m in plant.sense() if topic.name == "oracle/heard"]
    return said


@pytest.mark.parametrize(
    ("text", "wish"),
    [
        ("Please take the red cup.", "take"),
        ("nobody took it; please take it out of my hand, then say continue", "take"),
        ("please take away what I touch, then say continue", ""),
        ("Excuse me.", "make room"),
        ("please step back from me, then say continue", "make room"),
        ("please clear the way at (1.0, 2.0) m, then say continue", "make room"),
        ("Would you like tea?", "answer"),
        ("Good morning.", ""),
    ],
)
def test_what_the_robot_wants_is_heard_in_its_words(text, wish):
    assert wish_in(text) == wish


def test_nobody_does_anything_before_they_are_spoken_to():
    plant = bench()
    before = plant.where("person/anna")
    plant.hear("Good morning.")
    let_pass(plant, 0.5)
    assert not plant.people.busy
    assert plant.where("person/anna") == before


def test_a_question_is_answered_after_a_moment_and_only_by_who_answers():
    said = let_pass(bench_asked(answers="No, thanks."), 5.0)
    assert [(m.text, m.person_id, m.source) for m in said] == [("No, thanks.", "anna", "oracle")]
    assert said[0].stamp_s > 0.5
    assert let_pass(bench_asked(answers=""), 5.0) == []


def bench_asked(**behaviour) -> Plant:
    plant = bench(**behaviour)
    plant.hear("Would you like tea?")
    return plant


def test_who_is_asked_to_steps_out_of_the_way_slowly_and_says_so():
    plant = bench(behind_m=0.7)
    X_WB = plant.oracle.X_WB()
    plant.hear("please step back from me, then say continue")
    before, fastest_m_s = plant.where("person/anna").p, 0.0
    said = []
    for _ in range(300):
        said += let_pass(plant, 0.02)
        after = plant.where("person/anna").p
        fastest_m_s = max(fastest_m_s, math.dist(before, after) / 0.02)
        before = after
    around = Around(X_WB.p[:2], X_WB.yaw_rad)
    assert not in_the_way(before[:2], around, within_m=2.0)
    assert fastest_m_s < 0.45
    assert [m.text for m in said] == ["continue"]


def test_who_is_told_to_step_back_does_so_also_from_beside_the_robot():
    anna = msgspec.structs.replace(BENCH.people[0], at_m=(-0.2, -1.05), behaviour=Behaviour())
    plant = Plant(msgspec.structs.replace(BENCH, people=(anna,)), JUNO, seed=3)
    plant.hear("Excuse me.")
    let_pass(plant, 4.0)
    assert plant.where("person/anna").p[:2] == pytest.approx((-0.2, -1.05))
    plant.hear("Please step back a little.")
    let_pass(plant, 5.0)
    assert math.dist(plant.where("person/anna").p[:2], plant.oracle.X_WB().p[:2]) >= BACK_M - 0.05


def test_who_does_not_step_aside_stays():
    plant = bench(behind_m=0.7, steps_aside=False)
    before = plant.where("person/anna")
    plant.hear("Excuse me.")
    let_pass(plant, 3.0)
    assert plant.where("person/anna") == before


@pytest.mark.parametrize("heading_rad", [0.0, 1.0, 2.5, -2.0])
def test_a_free_spot_is_out_of_the_lane_and_clear_of_everything(heading_rad):
    around = Around((0.0, 0.0), heading_rad)
    at = (1.1 * math.cos(heading_rad), 1.1 * math.sin(heading_rad))
    bare = world.empty()
    (spot,) = way_out(bare, at, around)
    assert math.dist(spot, around.robot) >= ROBOT_M
    across = spot[1] * math.cos(heading_rad) - spot[0] * math.sin(heading_rad)
    along = spot[0] * math.cos(heading_rad) + spot[1] * math.sin(heading_rad)
    assert along < 0.0 or abs(across) >= LANE_M


def test_who_has_to_leave_a_wide_lane_goes_farther():
    around, at = Around((0.0, 0.0), 0.0), (1.1, 0.0)
    (near,) = way_out(world.empty(), at, around)
    *_, far = way_out(world.empty(), at, around, lane_m=WIDE_LANE_M)
    assert not in_the_way(near, around, within_m=2.0)
    assert in_the_way(near, around, within_m=2.0, lane_m=WIDE_LANE_M)
    assert not in_the_way(far, around, within_m=2.0, lane_m=WIDE_LANE_M)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(("ahead_m", "aside_m"), [(1.0, 0.2), (1.2, 0.6), (1.5, 0.2)])
def test_nobody_crosses_before_the_robot_who_can_keep_to_their_side(ahead_m, aside_m, side):
    around = Around((0.0, 0.0), 0.0)
    way = way_out(_hall(2.2), (ahead_m, side * aside_m), around)
    assert all(side * spot[1] > 0.0 for spot in way)
    assert not in_the_way(way[-1], around, within_m=2.0)


def test_who_has_a_wall_beside_them_crosses():
    around = Around((0.0, 0.3), 0.0)
    *_, spot = way_out(_hall(2.0), (1.2, 0.6), around)
    assert spot[1] < 0.3
    assert not in_the_way(spot, around, within_m=2.0)


def _hall(wide_m: float):
    walls = ("north", "south", "east", "west")
    hall = Room(id="hall", at_m=(0.0, 0.0), size_m=(6.0, wide_m), walls=walls)
    return msgspec.structs.replace(world.empty(), rooms=(hall,))


def test_who_just_made_room_and_is_asked_again_makes_more():
    plant = bench(behind_m=0.7)
    places = []
    for _ in range(3):
        plant.hear("Excuse me.")
        let_pass(plant, 4.0)
        places.append(plant.where("person/anna").p)
    assert math.dist(places[0], places[1]) > 0.2
    let_pass(plant, AGAIN_S)
    plant.hear("Excuse me.")
    let_pass(plant, 4.0)
    assert math.dist(places[2], plant.where("person/anna").p) < 0.01


def test_nobody_steps_where_somebody_stands():
    around = Around((0.0, 0.0), 0.0)
    (spot,) = way_out(world.empty(), (1.1, 0.0), around)
    (again,) = way_out(world.empty(), (1.1, 0.0), Around((0.0, 0.0), 0.0, others=((spot, 0.3),)))
    assert math.dist(again, spot) > 0.3


@pytest.mark.parametrize("heading_deg", [-90, -65, -110])
def test_who_stands_in_a_doorway_steps_back_through_it_and_then_aside(heading_deg):
    hall = Room(
        id="hall", at_m=(0.0, 0.0), size_m=(6.0, 1.4), walls=("north", "south", "east", "west"),
        doors=(Door(wall="south", at_m=0.0, width_m=0.85),),
    )  # fmt: skip
    kitchen = Room(id="kitchen", at_m=(0.0, -2.3), size_m=(4.0, 3.0), walls=("south",))
    home = msgspec.structs.replace(world.empty(), rooms=(hall, kitchen))
    around = Around((0.0, -0.1), math.radians(heading_deg))
    *_, spot = way_out(home, (0.0, -0.66), around)
    assert not in_the_way(spot, around, within_m=2.0)


def test_nobody_makes_room_before_a_door_that_they_can_make_room_elsewhere():
    saloon = Room(
        id="saloon", at_m=(0.0, 0.0), size_m=(4.2, 4.2), walls=("west", "north", "south"),
        doors=(Door(wall="west", at_m=0.9, width_m=0.85),),
    )  # fmt: skip
    deck = Room(id="deck", at_m=(-3.4, 0.0), size_m=(2.4, 4.2), walls=("west", "north", "south"))
    home = msgspec.structs.replace(world.empty(), rooms=(saloon, deck))
    around = Around((0.0, -0.25), 3.1)
    *_, spot = way_out(home, (-1.3, 0.1), around)
    assert not in_the_way(spot, around, within_m=2.0)
    door = (-2.14, 0.9)
    assert math.dist(spot, door) > DOORSTEP_M
    to_the_door = Around((0.0, -0.25), math.atan2(door[1] + 0.25, door[0]))
    assert not in_the_way(spot, to_the_door, within_m=2.0)


@pytest.fixture(scope="module")
def arm():
    plant = bench()
    return plant, PersonArm(plant.model, "anna", "right")


def test_the_palm_goes_where_it_is_sent_and_the_arm_hangs_together(arm):
    plant, right = arm
    into = np.array([1.0, 0.0, 0.0])
    palm = right.shoulder + np.array([0.38, 0.05, -0.25])
    right.put(palm, into, half_m=0.035, closed=1.0)
    assert right.palm == pytest.approx(palm)
    upper, fore, *_ = (plant.model.geom(name).id for name in links("anna", "right"))
    ends = {g: ends_of(plant.model, g) for g in (upper, fore)}
    nearest = min(math.dist(a, b) for a in ends[upper] for b in ends[fore])
    assert nearest < 1e-6, "the forearm begins where the upper arm ends"
    right.hang()
    assert right.palm == pytest.approx(right.hanging)


def test_an_arm_is_no_longer_than_it_is(arm):
    _, right = arm
    into = np.array([1.0, 0.0, 0.0])
    right.put(right.shoulder + np.array([2.0, 0.0, 0.0]), into, half_m=0.035, closed=0.0)
    assert right.palm[0] - right.shoulder[0] == pytest.approx(right.reach_m + right.hand_m)
    right.hang()


def ends_of(model, geom):
    axis = np.zeros(3)
    mujoco.mju_rotVecQuat(axis, np.array([0.0, 0.0, 1.0]), model.geom_quat[geom])
    half = model.geom_size[geom, 1] * axis
    return model.geom_pos[geom] + half, model.geom_pos[geom] - half


def test_a_hand_pulls_and_never_harder_than_a_person_does():
    plant = bench()
    grip = Grip(plant.model, plant.data, int(plant.model.body("object/red_cup").id))
    for far_m in (0.0, 0.005, 0.02, 0.1, 10.0):
        grip.at = grip.where + np.array([far_m, 0.0, 0.0])
        assert np.linalg.norm(grip.pull_n) <= PULL_N + 1e-9
    assert np.linalg.norm(grip.pull_n) == pytest.approx(PULL_N)


def test_what_is_in_a_hand_is_carried_and_what_is_torn_out_is_dropped():
    plant = bench()
    anna = plant.people._everybody[0]
    grip = Grip(plant.model, plant.data, int(plant.model.body("object/red_cup").id))
    anna.grip, grip.share = grip, 1.0
    plant.hear("Would you like tea?")  # somebody has to look after the hand
    for _ in range(100):
        grip.at[2] += 0.001
        let_pass(plant, 0.02)
    assert plant.oracle.X_WO("red_cup").p[2] == pytest.approx(grip.at[2], abs=0.01)
    plant.pull("object/red_cup", (60.0, 0.0, 0.0), duration_s=0.3)
    let_pass(plant, 0.4)
    assert anna.grip is None
    assert math.dist(plant.oracle.X_WO("red_cup").p, grip.at) > LOST_M


def test_the_same_seed_gives_the_same_person():
    def told():
        plant = bench_asked(answers="Yes.")
        return [m.stamp_s for m in let_pass(plant, 3.0)]

    assert told() == told()


@pytest.mark.parametrize("leaves", [True, False])
def test_nobody_walks_into_a_robot_that_walks_on_as_they_make_room(leaves: bool):
    plant = bench(behind_m=0.7)
    plant.hear("please step back from me")
    let_pass(plant, 1.3)
    began = plant.where("person/anna")
    let_pass(plant, 0.3)
    at = plant.where("person/anna")
    way = [at.p[i] - began.p[i] for i in range(2)]
    there = [at.p[i] + 0.95 * way[i] / math.hypot(*way) for i in range(2)]
    plant.stand(SE3.from_xy_yaw(there[0], there[1], 0.0))
    nearest_m = math.inf
    for k in range(30):
        let_pass(plant, 0.1)
        apart_m = math.dist(plant.where("person/anna").p[:2], plant.oracle.X_WB().p[:2])
        nearest_m = min(nearest_m, apart_m)
        if leaves and k == 15:
            plant.stand(SE3.from_xy_yaw(1.0, -1.5, 0.0))
    assert nearest_m > WALKING_M - 0.1  # the robot slumps a little meanwhile
    moved_m = math.dist(plant.where("person/anna").p[:2], began.p[:2])
    assert (moved_m > 0.6) == leaves
