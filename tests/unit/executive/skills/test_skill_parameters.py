"""Parameters check themselves: nothing wrong gets as far as a skill."""

import math

import msgspec
import pytest

from executive.skills import parameters as p
from robot.se3 import SE3


@pytest.mark.parametrize(
    "build",
    [
        p.NavigateParams,
        lambda: p.NavigateParams(place_id="table", person_id="ann"),
        lambda: p.NavigateParams(pose=p.FloorPose(x_m=math.nan, y_m=0.0)),
        lambda: p.NavigateParams(by=p.Step(forward_m=1000.0)),
        lambda: p.NavigateParams(by=p.Step(turn_rad=math.inf)),
        lambda: p.PlaceParams(object_id="cup"),
        lambda: p.PlaceParams(object_id="cup", place_id="table", X_WO=SE3()),
        p.LookParams,
        lambda: p.BalanceParams(mode="stand", duration_s=-1.0),
        lambda: p.BalanceParams(mode="stand", duration_s=1e6),
        lambda: p.BalanceParams(mode="one_leg", side="forward"),
        lambda: p.WaitParams(duration_s=math.nan),
        lambda: p.SayParams(text="x" * 5000),
    ],
)
def test_what_cannot_be_meant_is_refused(build):
    with pytest.raises(ValueError):
        build()


@pytest.mark.parametrize(
    "good",
    [
        p.NavigateParams(pose=p.FloorPose(x_m=1.0, y_m=2.0)),
        p.NavigateParams(by=p.Step(forward_m=-0.5)),
        p.PickParams(object_id="cup", side="left"),
        p.PlaceParams(object_id="cup", X_WO=SE3((1.0, 0.0, 0.7))),
        p.LookParams(p_W=(1.0, 2.0, 0.5)),
        p.BalanceParams(mode="lean", side="forward"),
        p.WaitParams(),
        p.StopParams(),
    ],
)
def test_parameters_survive_json(good):
    text = msgspec.json.encode(good)
    assert msgspec.json.decode(text, type=p.SkillParams) == good
