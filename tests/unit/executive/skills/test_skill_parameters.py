"""Parameters check themselves: nothing wrong gets as far as a skill."""

import math
import operator
from functools import reduce

import msgspec
import pytest

from executive.skills.balance import BalanceParams
from executive.skills.catalogue import SKILLS
from executive.skills.look import LookParams
from executive.skills.navigate import FloorPose, NavigateParams, Step
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.skills.stop import StopParams
from executive.skills.wait import WaitParams
from robot.se3 import SE3

ANY = reduce(operator.or_, (skill.takes for skill in SKILLS))


@pytest.mark.parametrize(
    "build",
    [
        NavigateParams,
        lambda: NavigateParams(place_id="table", person_id="ann"),
        lambda: NavigateParams(pose=FloorPose(x_m=math.nan, y_m=0.0)),
        lambda: NavigateParams(by=Step(forward_m=1000.0)),
        lambda: NavigateParams(by=Step(turn_rad=math.inf)),
        lambda: PlaceParams(object_id="cup"),
        lambda: PlaceParams(object_id="cup", place_id="table", X_WO=SE3()),
        LookParams,
        lambda: LookParams(towards="left", around=True),
        lambda: BalanceParams(mode="stand", duration_s=-1.0),
        lambda: BalanceParams(mode="stand", duration_s=1e6),
        lambda: BalanceParams(mode="one_leg", side="forward"),
        lambda: WaitParams(duration_s=math.nan),
        lambda: SayParams(text="x" * 5000),
    ],
)
def test_what_cannot_be_meant_is_refused(build):
    with pytest.raises(ValueError):
        build()


@pytest.mark.parametrize(
    "good",
    [
        NavigateParams(pose=FloorPose(x_m=1.0, y_m=2.0)),
        NavigateParams(by=Step(forward_m=-0.5)),
        PickParams(object_id="cup", side="left"),
        PlaceParams(object_id="cup", X_WO=SE3((1.0, 0.0, 0.7))),
        LookParams(p_W=(1.0, 2.0, 0.5)),
        LookParams(towards="left"),
        BalanceParams(mode="lean", side="forward"),
        WaitParams(),
        StopParams(),
    ],
)
def test_parameters_survive_json(good):
    text = msgspec.json.encode(good)
    assert msgspec.json.decode(text, type=ANY) == good
