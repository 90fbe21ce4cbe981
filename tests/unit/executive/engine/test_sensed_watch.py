"""What is written of what is sensed and planned: enough to look at it, at a bounded rate."""

from __future__ import annotations

import io
import math

import msgspec
import numpy as np
import pytest
from PIL import Image

from executive.blackboard import BODY, GOAL, HELD, WORLD, Blackboard
from executive.engine.sensed_watch import MOST_WIDE, SensedWatch
from executive.journal import sensed
from executive.journal.sensed import Sensed
from robot import shots
from robot.failures import failure
from robot.messages import DepthImage, Landing, LidarScan, Track, WorldState
from robot.model import description
from robot.planning.requests import (
    ArmPlan,
    ArmRequest,
    BasePath,
    BasePathRequest,
    BodyPosture,
    PickPlan,
    PickRequest,
    Surroundings,
)
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state
from tests.fakes.scripted_skills import SilentLink
from tests.fakes.stage import kitchen

JUNO = description.load("juno")
AROUND = Surroundings(map=kitchen())
WAY = BasePath(waypoints=((1.0, 0.0, 0.0), (2.0, 1.0, 0.5)), length_m=2.4, clearance_m=0.5)
TO = BasePathRequest(start=(0.0, 0.0, 0.0), goal=(2.0, 1.0, 0.5), around=AROUND)
PICK = PickPlan(
    side="left",
    standoff=(1.0, 0.0, 0.0),
    stance=(1.2, 0.0, 0.0),
    posture=BodyPosture(),
    ready_rad=(0.0,) * 7,
    X_OG=SE3(),
    X_WG_pre=SE3((1.0, 0.0, 0.8)),
    X_WG_grasp=SE3((1.1, 0.0, 0.8)),
    X_WG_lift=SE3((1.1, 0.0, 0.9)),
    pre_rad=(0.0,) * 7,
    carry_rad=(0.0,) * 7,
    opening_m=0.07,
    margin=0.5,
)


class Lines(list[bytes]):
    """Takes lines, as a file does."""

    waiting = dropped = 0
    problem = ""

    def close(self) -> None:
        """Nothing to close."""


class Watched:
    """A watch on a board whose values are set by hand."""

    def __init__(self, **how):
        self.board = Blackboard()
        self.sense = self.board.claim("sense")
        self.task = self.board.claim("task")
        self.link, self.depths, self._lines = SilentLink(), Lines(), Lines()
        self.watch = SensedWatch(
            self.board, self.link, JUNO, lines=self._lines, depths=self.depths, **how
        )  # type: ignore[arg-type]

    @property
    def lines(self) -> list[Sensed]:
        found = [sensed.decode(line) for line in self._lines]
        assert None not in found
        return [one for one in found if one is not None]

    def tick(self, now_s, *, mode="stand", held=(), goal="go", seen_s=-math.inf, steps=()):
        body = msgspec.structs.replace(
            body_state(now_s, q_rad=(0.0, 0.0)),
            mode=mode, steps=steps, tau_nm=(1.234, -50.06), temperature_c=(25.04, 61.0),
        )  # fmt: skip
        self.sense.set(BODY, body)
        track = Track(id="cup", X_WO=SE3((1.0, 0.0, 0.8)), seen_s=seen_s)
        world = WorldState(
            stamp_s=now_s, X_WN=SE3((10.0, 0.0, 0.0)), X_WB=SE3(), fix_age_s=0.0, tracks=(track,)
        )
        self.sense.set(WORLD, world)
        self.sense.set(HELD, dict(zip(("left", "right"), held, strict=False)))
        self.task.set(GOAL, goal)
        self.watch.update(now_s)


def test_rates_are_bounded_however_often_it_ticks():
    watched = Watched()
    watched.link.messages["lidar"] = LidarScan(
        stamp_s=0.0,
        angle_min_rad=-1.0,
        angle_step_rad=0.5,
        ranges_m=(1.5, math.inf, 70.0, -1.0, math.nan),
    )
    watched.link.messages["depth"] = image(8, 6, 1.0)
    for tick in range(200):  # ten seconds
        watched.tick(0.05 * tick)
    lines = watched.lines
    assert sum(bool(one.torque) for one in lines) == 50
    assert sum(bool(one.heat) for one in lines) == 5
    assert sum(one.scan is not None for one in lines) == 20
    assert len(watched.depths) == 10
    assert lines[0].torque == (1.2, -50.1) and lines[0].heat == (25.0, 61.0)
    scan = lines[0].scan
    assert scan is not None
    assert np.frombuffer(scan.ranges_mm, "<u2").tolist() == [1500, 0, 0, 0, 0]


def test_a_picture_without_pixels_is_none():
    watched = Watched()
    watched.link.messages["depth"] = DepthImage(
        stamp_s=0.0, width=0, height=0, fovy_rad=1.0, depth_m=b""
    )
    watched.tick(0.0)
    assert watched.depths == []


def image(width: int, height: int, depth_m: float) -> DepthImage:
    pixels = np.full((height, width), depth_m, np.float32)
    pixels[0, 0] = 0.0
    return DepthImage(
        stamp_s=3.0, width=width, height=height, fovy_rad=math.pi / 2, depth_m=pixels.tobytes()
    )


@pytest.mark.parametrize("width", [40, 80, 160, 100])
def test_a_depth_image_is_kept_with_what_it_takes_to_make_points_of_it(width):
    watched = Watched()
    watched.link.messages["depth"] = image(width, 60, 2.0)
    watched.tick(0.0)
    shot = shots.decode(watched.depths[0])
    assert shot is not None and shot.t_s == 3.0 and shot.width <= MOST_WIDE
    grey = np.asarray(Image.open(io.BytesIO(shot.data)))
    assert grey.shape == (shot.height, shot.width)
    assert grey[0, 0] == 0  # nothing was measured there
    assert abs(grey[1, 1] / 255 * shot.range_m - 2.0) < shot.range_m / 255
    # A pixel that is kept looks where it looked: 45 degrees up at the upper edge.
    up = -shot.centre_px[1] / shot.focal_px[1]
    assert up == pytest.approx(-(0.5 * 59) / 30.0)


def test_a_way_is_told_until_it_is_walked():
    watched = Watched()
    watched.watch.planned(TO, WAY)
    watched.tick(0.0)
    watched.tick(0.05, mode="walk")
    watched.tick(0.1, mode="walk")
    watched.tick(0.15)
    watched.tick(0.2)
    assert [one.way for one in watched.lines if one.way is not None] == [WAY.waypoints, ()]


def test_a_new_way_takes_the_place_of_one_that_ends_in_the_same_tick():
    watched = Watched()
    watched.watch.planned(TO, WAY)
    watched.tick(0.0, mode="walk")
    other = msgspec.structs.replace(WAY, waypoints=((0.0, 1.0, 0.0),))
    watched.watch.planned(TO, other)
    watched.tick(0.05)
    assert [one.way for one in watched.lines if one.way is not None] == [
        WAY.waypoints,
        other.waypoints,
    ]


@pytest.mark.parametrize("how", [{"held": ("cup",)}, {"goal": ""}])
def test_a_grasp_is_told_until_the_hand_has_it_or_nothing_is_to_be_done(how):
    watched = Watched()
    watched.watch.planned(PickRequest(object_id="cup", around=AROUND, start=(0.0, 0.0, 0.0)), PICK)
    watched.tick(0.0)
    watched.tick(0.05, **how)
    watched.tick(0.1, **how)
    told, *_ = [one.reach for one in watched.lines if one.reach is not None]
    assert (told.thing, told.side, told.hand[1][:3]) == ("cup", "left", (1.1, 0.0, 0.8))
    assert [one.t_s for one in watched.lines if one.no_reach] == [0.05]


def test_a_motion_of_an_arm_names_its_motors():
    watched = Watched()
    arm = ArmPlan(
        side="right",
        times_s=(0.0, 1.0),
        positions_rad=((0.0,) * 7, (0.5,) * 7),
        duration_s=1.0,
        clearance_m=0.02,
    )
    request = ArmRequest(side="right", q_start_rad=(), X_WB=SE3(), goal=(0.5,) * 7, around=AROUND)
    watched.watch.planned(request, arm)
    watched.tick(0.0)
    told = watched.lines[0].arm
    assert told is not None
    names = [JUNO.motor_names[k] for k in told.motors]
    assert names == list(JUNO.groups["right_arm"]) and told.positions[-1] == (0.5,) * 7
    assert told.clear_m == 0.02


def test_numbers_of_numpy_are_written_as_numbers():
    """Planners and sensors calculate with them; one that cannot be written would end a tick."""
    watched = Watched()
    odd = np.float64(0.5)
    watched.watch.planned(TO, msgspec.structs.replace(WAY, waypoints=((odd, odd, odd),)))
    arm = ArmPlan(side="left", times_s=(odd,), positions_rad=((odd,) * 7,), duration_s=0.5)
    watched.watch.planned(
        ArmRequest(side="left", q_start_rad=(), X_WB=SE3(), goal=(0.5,) * 7, around=AROUND), arm
    )
    hand = SE3((odd, odd, odd), (np.float64(1.0), odd * 0, odd * 0, odd * 0))
    watched.watch.planned(
        PickRequest(object_id="cup", around=AROUND, start=(0.0, 0.0, 0.0)),
        msgspec.structs.replace(PICK, X_WG_grasp=hand, stance=(odd, odd, odd)),
    )
    watched.tick(0.0)
    told = watched.lines[0]
    assert told.way == ((0.5, 0.5, 0.5),) and told.arm is not None and told.reach is not None
    assert told.reach.hand[1][:3] == (0.5, 0.5, 0.5)


def test_a_plan_that_failed_is_no_plan():
    watched = Watched()
    watched.watch.planned(TO, failure("no_path", "there is none"))
    watched.tick(0.0)
    assert all(one.way is None for one in watched.lines)


def test_landings_are_of_the_world_and_told_when_they_change():
    watched = Watched()
    step = Landing(side="right", x_m=0.3, y_m=-0.1, yaw_rad=0.0)
    for tick, x_m in enumerate((0.3, 0.301, 0.35)):
        watched.tick(0.05 * tick, steps=(msgspec.structs.replace(step, x_m=x_m),))
    watched.tick(0.2)
    told = [one.steps for one in watched.lines if one.steps is not None]
    assert told == [((1, 10.3, -0.1, 0.0),), ((1, 10.35, -0.1, 0.0),), ()]


def test_what_is_seen_is_told_when_that_changes():
    watched = Watched()
    for now_s, seen_s in ((1.0, 0.9), (1.05, 1.05), (5.0, 1.05)):
        watched.tick(now_s, seen_s=seen_s)
    assert [(one.sees, one.source) for one in watched.lines if one.sees is not None] == [
        (("cup",), "oracle"),
        ((), "oracle"),
    ]


def test_what_stands_there_already_is_not_written_again():
    watched = Watched(after_s=1.0)
    watched.tick(0.5)
    assert watched.lines == []
    watched.tick(1.05)
    assert len(watched.lines) == 1


def test_half_a_line_is_none():
    whole = sensed.encode(Sensed(t_s=1.0, torque=(1.0,)))
    assert sensed.decode(whole) == Sensed(t_s=1.0, torque=(1.0,))
    for wrong in (whole[:-3], b"", b"[" * 9999, b'{"t_s": "x"}', b"\xff\xfe"):
        assert sensed.decode(wrong) is None
