"""How a thing is taken depends on where it is to go."""

import math

import pytest
from msgspec.structs import replace

from executive.skills.pick import PickParams
from robot.failures import failure
from robot.planning.requests import PickRequest, PlaceRequest
from robot.se3 import SE3
from tests.fakes.oracle_planner import RulePlanner
from tests.fakes.stage import Stage

STEEP_RAD = 1.2
NOT_SO = failure("goal_in_collision", "the hand touches the board")


class FromAbove(RulePlanner):
    """Takes things from as far above as it may."""

    def _pick(self, request):
        plan = super()._pick(request)
        tilt = SE3.from_rpy(0.0, min(STEEP_RAD, request.most_tilt_rad), 0.0, (0.0, 0.0, 0.0))
        X_WG = plan.X_WG_grasp @ tilt
        return replace(plan, X_WG_grasp=X_WG, X_OG=plan.X_OG @ tilt)


def asked(put, to="counter"):
    """Most tilts of the picks, and the holds of the places, that the planner was asked for."""
    stage = Stage(planner=FromAbove(failures={PlaceRequest: put}))
    stage.run(PickParams(object_id="cup", for_place_id=to), until_phase="walking")
    requests = stage.planner.requests
    tilts = [r.most_tilt_rad for r in requests if isinstance(r, PickRequest)]
    return tilts, [r for r in requests if isinstance(r, PlaceRequest)]


def test_a_thing_that_could_not_be_put_down_so_is_taken_with_a_leveller_hand():
    tilts, puts = asked([NOT_SO])
    assert tilts == pytest.approx([math.inf, STEEP_RAD / 2])
    assert [put.place.id for put in puts] == ["counter", "counter"]
    assert all("cup" in put.around.ignored for put in puts)  # it stands there no more by then


@pytest.mark.parametrize("reason", ["no_free_spot", "no_stance"])
def test_what_another_grasp_would_not_change_is_left_to_the_placing(reason):
    tilts, _ = asked([failure(reason, "there is no room")])
    assert tilts == [math.inf]


@pytest.mark.parametrize("to", [None, "nowhere"])
def test_without_a_place_to_go_to_nothing_more_is_planned(to):
    tilts, puts = asked([], to=to)
    assert (tilts, puts) == ([math.inf], [])
