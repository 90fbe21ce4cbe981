"""Where to look from, where people close the way: past them if that is worth asking them."""

import pytest

from executive.skills.motions import past_people
from robot.planning.requests import LookPlan, LookRequest, Surroundings
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
