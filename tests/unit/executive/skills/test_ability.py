"""What a body cannot do is refused at once, by the check of a task and by the skill itself."""

import pytest
from msgspec.structs import replace

from executive.skills.balance import BalanceParams
from executive.skills.catalogue import make, unable
from executive.skills.context import SkillContext
from executive.skills.gesture import GestureParams
from executive.skills.give import GiveParams
from executive.skills.look import LookParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from robot.model.body import SIDES
from robot.planning.requests import ArmPlan, ArmRequest, BodyPosture, PickRequest
from robot.planning.solve import Solver
from tests.fakes import bodies
from tests.fakes.planning_room import START, surroundings

PICK = PickParams(object_id="cup")
ALL = (
    PICK,
    PlaceParams(object_id="cup", place_id="table"),
    GiveParams(object_id="cup", person_id="ann"),
    LookParams(around=True),
    SearchParams(object_id="cup"),
    *(BalanceParams(mode=mode) for mode in ("stand", "squat", "lean", "one_leg", "get_up")),
    *(GestureParams(kind=kind) for kind in ("wave", "nod", "bow", "raise_both_arms")),
    GestureParams(kind="point", object_id="cup"),
)


@pytest.fixture(scope="module")
def neckless(tmp_path_factory):
    return bodies.neckless(tmp_path_factory.mktemp("neckless"))


def refused(robot) -> list[str]:
    return [failure.cause for params in ALL if (failure := unable(params, robot))]


def test_juno_can_do_everything():
    assert refused(bodies.JUNO) == []


def test_without_hands_nothing_is_taken_given_or_pointed_at():
    no_hands = ["handless has no hands"]
    assert refused(bodies.handless()) == [
        *3 * no_hands,
        "handless knows no way to get up",
        *no_hands,
    ]


def test_without_a_neck_it_does_not_nod_but_looks_with_its_waist(neckless):
    assert refused(neckless) == ["neckless knows no way to get up", "neckless has no neck"]
    stiff = replace(neckless, gaze=replace(neckless.gaze, waist_yaw_rad=0.0))
    assert "neckless has no neck, and does not turn its waist to see" in refused(stiff)


def test_one_hand_is_enough_unless_the_other_is_asked_for():
    robot = replace(bodies.JUNO, hands={"left": bodies.JUNO.hands["left"]})
    assert refused(robot) == []
    assert (
        unable(PickParams(object_id="cup", side="right"), robot).cause == "juno has no right hand"
    )


def test_the_skill_itself_fails_at_its_first_step():
    context = SkillContext(link=None, planner=None, description=bodies.handless())  # type: ignore
    skill = make(PICK, context)
    skill.start(0.0)
    report = skill.step(0.0)
    assert (report.status, report.failure.code) == ("failed", "unsupported")
    assert skill.stop(0.0).status == "failed"


def test_planners_answer_for_a_body_without_hands():
    solver = Solver(bodies.handless())
    refusal = solver.solve(PickRequest(object_id="cup", around=surroundings(), start=START))
    assert (refusal.code, refusal.cause) == ("unsupported", "handless has no hands")


@pytest.mark.parametrize("side", SIDES)
def test_arms_without_hands_are_planned_for(side):
    robot = bodies.handless()
    solver = Solver(robot)
    standing = solver.body.standing(BodyPosture())
    raised = tuple(robot.posture("raised")[i] for i in robot.indices(f"{side}_arm"))
    plan = solver.solve(
        ArmRequest(
            side=side, q_start_rad=tuple(standing.q.tolist()), X_WB=standing.X_SB, goal=raised,
            around=surroundings(),
        )
    )  # fmt: skip
    assert isinstance(plan, ArmPlan), plan
    assert plan.positions_rad[-1] == pytest.approx(raised)
