"""What is written of how everything moves: enough to draw it, and no more."""

from __future__ import annotations

import math

from executive.blackboard import BODY, HELD, WORLD, Blackboard
from executive.engine.motion_watch import MotionWatch
from executive.journal import motion
from executive.journal.files import LineFile
from robot.messages import Track, WorldState
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state
from tests.fakes.scripted_skills import SilentLink

CUP = SE3((1.0, 2.0, 0.8))


class Watched:
    """A watch on a board whose values are set by hand; `lines` are what it wrote."""

    def __init__(self, **how):
        self.board = Blackboard()
        self.sense = self.board.claim("sense")
        self.lines: list[motion.Moment] = []
        self.watch = MotionWatch(self.board, SilentLink(), self, **how)  # type: ignore[arg-type]

    def append(self, line: bytes) -> None:
        moment = motion.decode(line)
        assert moment is not None
        self.lines.append(moment)

    def tick(self, now_s: float, *, x_m=0.0, q=(0.0,), cup=CUP, missing=False, held=()):
        self.sense.set(BODY, body_state(now_s, SE3((x_m, 0.0, 0.6)), q_rad=q))
        track = Track(id="cup", X_WO=cup, seen_s=0.0, missing=missing)
        world = WorldState(
            stamp_s=now_s, X_WN=SE3((10.0, 0.0, 0.0)), X_WB=SE3(), fix_age_s=0.0, tracks=(track,)
        )
        self.sense.set(WORLD, world)
        self.sense.set(HELD, dict(zip(("left", "right"), held, strict=False)))
        self.watch.update(now_s)
        return self.lines


def test_a_robot_that_rests_gives_a_sign_of_life_a_second():
    watched = Watched()
    for tick in range(100):
        watched.tick(0.05 * tick, x_m=1e-4 * (tick % 2))
    assert [round(one.t_s) for one in watched.lines] == [0, 1, 2, 3, 4]


def test_whatever_moves_is_written_at_once_and_alone():
    watched = Watched()
    watched.tick(0.0)
    watched.tick(0.05, x_m=0.002)
    watched.tick(0.1, x_m=0.002, q=(0.01,))
    watched.tick(0.15, x_m=0.002, q=(0.01,), cup=SE3((1.0, 2.0, 0.9)))
    first, walked, turned, carried = watched.lines
    assert first.base[0] == 10.0 and walked.base[0] == 10.002  # of the world, not of the odometry
    assert turned.q == (0.01,)
    assert first.objects == {"cup": (1.0, 2.0, 0.8, 1.0, 0.0, 0.0, 0.0)}
    assert (walked.objects, turned.objects) == ({}, {})
    assert carried.objects["cup"] == (1.0, 2.0, 0.9, 1.0, 0.0, 0.0, 0.0)


def test_what_is_gone_and_what_is_held_is_said_once():
    watched = Watched()
    watched.tick(0.0)
    watched.tick(0.05, held=("cup",))
    watched.tick(0.1, held=("cup",))
    watched.tick(0.15, missing=True)
    watched.tick(0.2, missing=True)
    assert [one.held for one in watched.lines] == [None, ("cup",), ()]
    assert watched.lines[-1].objects == {"cup": None}


def test_what_stands_there_already_is_not_written_again(tmp_path):
    file = LineFile(tmp_path / motion.FILE, capacity=10)
    assert motion.last_s(tmp_path) == -math.inf
    first = Watched()
    for one in (first.tick(0.05), first.tick(0.1, x_m=1.0)):
        file.append(motion.encode(one[-1]))
    file.append(b'{"t_s": 0.15, "base"')  # a line that was cut
    assert motion.last_s(tmp_path) == 0.1
    again = Watched(after_s=motion.last_s(tmp_path))
    again.tick(0.05)
    again.tick(0.1)
    again.tick(0.15, x_m=0.5)
    assert [one.t_s for one in again.lines] == [0.15]


def test_a_file_is_read_in_the_order_of_time_and_without_what_makes_no_sense(tmp_path):
    watched = Watched()
    watched.tick(1.0)
    (line,) = map(motion.encode, watched.lines)
    odd = [b"[]", b'{"t_s":NaN}', b"{" * 5000, b"\xff\xfe", b"x" * (2 * motion.MAX_LINE)]
    late = line.replace(b'"t_s":1.0', b'"t_s":0.5')
    (tmp_path / motion.FILE).write_bytes(b"\n".join([line, *odd, late, line[:-5]]))
    assert [one.t_s for one in motion.read(tmp_path)] == [1.0]
