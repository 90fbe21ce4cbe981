"""Where to look from, where people close the way: past them if that is worth asking them."""

import pytest

from executive.skills.motions import past_people
from executive.skills.motions.script import GaveUp
from robot.failures import failure
from robot.messages import Obstacle, Shape
from robot.planning.requests import BasePath, BasePathRequest, LookPlan, LookRequest, Surroundings
from robot.se3 import SE3
from tests.fakes.stage import kitchen

NEAR, FAR = (0.5, 0.0, 0.0), (3.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("here_per_s", "behind_per_s", "taken"),
    [(0.0, 0.1, FAR), (0.1, 0.5, FAR), (0.1, 0.12, NEAR), (0.1, 0.1, NEAR)],
)
def test_it_is_looked_behind_people_where_that_is_worth_asking_them(
    monkeypatch, here_per_s, behind_per_s, taken
):
    def look(body, asked: LookRequest, plan):
        del body, plan
        yield
        if asked.around.ignored:
            return LookPlan(stance=FAR, sees=(1,), worth_per_s=behind_per_s)
        near = NEAR if here_per_s else None
        return LookPlan(stance=near, sees=(0,), worth_per_s=here_per_s, cut_off=(1,))

    monkeypatch.setattr(past_people, "ask", look)
    request = LookRequest(
        start=(0.0, 0.0, 0.0),
        points_W=((1.0, 0.0, 0.8), (4.0, 0.0, 0.8)),
        worth=(1.0, 4.0),
        around=Surroundings(map=kitchen()),
    )
    script = past_people.ask_view_past_people(None, request)  # pyright: ignore[reportArgumentType]
    with pytest.raises(StopIteration) as end:
        while True:
            next(script)
    assert end.value.value.stance == taken


@pytest.mark.parametrize(("y_m", "asked"), [(3.1, True), (2.0, False)])
def test_what_is_seen_of_somebody_stands_for_them_where_it_closes_a_way(monkeypatch, y_m, asked):
    """Ann stands at y = 3 m; a lidar sees legs, which are no less her than her outline is."""
    shape = Shape(kind="box", size_m=(0.2, 0.2, 1.0))
    legs = Obstacle(id="in_view_1", name="something", X_WO=SE3((0.0, y_m, 0.5)), shapes=(shape,))

    def way(body, request: BasePathRequest, plan):
        del body, plan
        yield
        if "in_view_1" in request.around.ignored:
            return BasePath(waypoints=(FAR,), length_m=2.5, clearance_m=0.3)
        raise GaveUp(failure("goal_in_collision", "legs", blocked_by="in_view_1"))

    monkeypatch.setattr(past_people, "ask", way)
    request = BasePathRequest(
        start=(0.0, 0.0, 0.0), goal=FAR, around=Surroundings(map=kitchen(), unmapped=(legs,))
    )
    script = past_people.ask_past_people(None, request, BasePath)  # pyright: ignore[reportArgumentType]
    with pytest.raises(StopIteration if asked else GaveUp):
        while True:
            next(script)
