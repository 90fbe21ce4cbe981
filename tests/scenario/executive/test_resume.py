"""Runs that were cut off are gone on with: to the same journal in `fast`, to the same end live."""

import json
import shutil
from pathlib import Path

import msgspec
import pytest

from executive.journal import journal
from executive.journal.journal import Event
from executive.meaning import request
from executive.meaning.knowledge import Knowledge
from executive.runs.again import agreement, continuation
from robot import messages as m
from robot.failures import failure
from robot.model import description
from robot.planning.requests import PickRequest
from robot.se3 import SE3
from tests.fakes.worlds import mapped, world_map
from tests.scenario.executive.test_replay import anew  # noqa: F401 - a fixture
from tests.scenario.test_cli import runtime  # noqa: F401 - a fixture

WORDS = "bring the red cup to the table"


def cut(source: str, target: str, share: float) -> bytes:
    """Leave a share of a run's journal, as kill -9 would; returns the whole."""
    whole = Path(source, "journal.jsonl").read_bytes()
    Path(target).mkdir()
    Path(target, "journal.jsonl").write_bytes(whole[: int(share * len(whole))])
    Path(target, "run.json").write_bytes(Path(source, "run.json").read_bytes())
    return whole


def summed_up(folder: str) -> dict[str, object]:
    """What the summary says of a run, but for where it lies and what the wall's clock measured."""
    told = json.loads(Path(folder, "summary.json").read_text())
    return {key: value for key, value in told.items() if key not in ("wall_s", "folder")}


@pytest.mark.parametrize("share", [0.4, 0.9])
def test_a_fast_run_ends_with_the_journal_of_one_that_was_never_cut(
    runtime, humanoid, anew, share  # noqa: F811
):  # fmt: skip
    runtime.planner.failures[PickRequest] = [failure("grasp_missed", "closed on air")]
    assert humanoid("do", WORDS, "--fast", "--run-dir", "runs/a")[0] == 0
    whole = cut("runs/a", "runs/b", share)
    anew()
    runtime.planner.failures[PickRequest] = [failure("grasp_missed", "closed on air")]
    status, text = humanoid("resume", "runs/b")
    assert status == 0, text
    assert text.count("Done.") == 1
    assert Path("runs/b/journal.jsonl").read_bytes() == whole
    assert summed_up("runs/b") == summed_up("runs/a")
    lines = Path("runs/b/wall.jsonl").read_text().splitlines()
    numbers = [json.loads(line)["n"] for line in lines]
    assert numbers == sorted(set(numbers))
    assert numbers[-1] == len(whole.splitlines()) - 1


def test_what_a_mission_found_before_it_was_cut_off_is_in_its_summary(
    runtime, humanoid, anew  # noqa: F811
):  # fmt: skip
    Path("m.yaml").write_text("name: m\nsteps: [say: hello]\nexpect: [holding: false]\n")
    begun = ("mission", "run", "m.yaml", "--fast", "--eyes", "oracle", "--run-dir", "runs/a")
    assert humanoid(*begun)[0] == 0
    lines = Path("runs/a/journal.jsonl").read_bytes().splitlines(keepends=True)
    found = next(at for at, line in enumerate(lines) if b'"event":"expect"' in line)
    shutil.copytree("runs/a", "runs/b")
    Path("runs/b/journal.jsonl").write_bytes(b"".join(lines[: found + 1]))
    Path("runs/b/summary.json").unlink()
    anew()
    assert humanoid("resume", "runs/b")[0] == 0
    assert summed_up("runs/b") == summed_up("runs/a")
    assert summed_up("runs/b")["expected"]


def test_a_run_that_does_not_repeat_is_not_gone_on_with(runtime, humanoid, anew):  # noqa: F811
    assert humanoid("do", WORDS, "--fast", "--run-dir", "runs/a")[0] == 0
    cut("runs/a", "runs/b", 0.8)
    before = Path("runs/b/journal.jsonl").read_bytes()
    anew()
    runtime.planner.failures[PickRequest] = [failure("grasp_missed", "closed on air")]
    status, text = humanoid("resume", "runs/b")
    assert status == 1
    assert "It cannot be gone on with: it does not repeat." in text
    assert "Not the same: event" in text
    after = Path("runs/b/journal.jsonl").read_bytes()
    assert before.startswith(after)  # at most the half line at its end is gone


def test_what_has_ended_or_is_under_way_or_never_began_is_refused(runtime, humanoid):  # noqa: F811
    assert humanoid("do", "say hello", "--fast", "--run-dir", "runs/a")[0] == 0
    status, text = humanoid("resume", "runs/a")
    assert (status, "has ended" in text) == (2, True)
    lines = Path("runs/a/journal.jsonl").read_text().splitlines()
    Path("runs/b").mkdir()
    Path("runs/b/journal.jsonl").write_text(lines[0] + "\n")
    assert "nothing had begun" in humanoid("resume", "runs/b")[1]
    Path("runs/c").mkdir()
    with journal.Journal(Path("runs/c")):
        assert "is under way" in humanoid("resume", "runs/c")[1]


# --- the world agrees, or not ------------------------------------------------------------------

TASK = "bring the red cup to the table, then say hello"
CUP, TABLE = "cup_red", SE3((2.0, 0.0, 0.75))


class Robot:
    """A link to a body and a world model as they are told to be."""

    def __init__(self, *, X_WO=None, held_by=None, opening_m=0.05, missing=False):
        hand = m.HandState(X_NG=SE3((0.3, 0.2, 1.0)), opening_m=opening_m, opening_m_s=0, load_n=2)
        count = len(description.load("juno").motor_names)
        zero = (0.0, 0.0, 0.0)
        self._body = m.BodyState(
            stamp_s=9.0, mode="stand", X_NB=SE3(), v_NB=zero, w_NB=zero, X_NL=SE3(), X_NR=SE3(),
            X_NS=SE3(), left_contact=True, right_contact=True, q_rad=(0.1,) * count,
            qd_rad_s=(0.0,) * count, tau_nm=(0.0,) * count, com_N=zero, dcm_N=(0.0, 0.0),
            zmp_N=(0.0, 0.0), hands={"left": hand, "right": hand}, activities={},
        )  # fmt: skip
        track = m.Track(id=CUP, X_WO=X_WO, seen_s=1.0, missing=missing, held_by=held_by)
        self._world = m.WorldState(
            stamp_s=9.0, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=(track,)
        )

    def body(self):
        return self._body

    def world(self):
        return self._world


@pytest.fixture
def look(runtime):  # noqa: F811
    """What is found when some steps are done and the robot is as it is."""
    where = mapped(None, "test")
    understood = request.request(TASK, where)
    assert isinstance(understood, request.Understood), understood
    world = Knowledge(world_map())

    def look(robot: Robot, *done: str, begun: str = "", held: dict | None = None):
        events = [Event(0, 0.0, "done", {"step": path, "id": path}) for path in done]
        if begun:
            events.append(Event(1, 1.0, "step", {"step": begun, "id": begun}))
        if held is not None:
            events.append(Event(2, 1.0, "held", {"hands": held}))
        return agreement.look(
            events, understood.task, link=robot, knowledge=world,
            robot=description.load("juno"),
        )  # fmt: skip

    return look


def test_the_task_has_the_paths_that_these_tests_speak_of(look):
    assert look(Robot(X_WO=TABLE), "1.1", "1.2", "2").done == {"1.1", "1.2", "2"}


def test_what_lies_where_it_was_put_is_done(look):
    found = look(Robot(X_WO=on_table()), "1.1", "1.2")
    assert (found.done, found.again, found.held) == ({"1.1", "1.2"}, (), ())


def on_table() -> SE3:
    place = next(place for place in world_map().places if place.name == "table")
    x, y, z = place.X_WP.p
    return SE3((x, y, z + 0.05))


def test_what_is_not_there_any_more_is_fetched_and_put_there_again(look):
    for robot in (
        Robot(X_WO=SE3((0.0, 3.0, 0.0))), Robot(X_WO=on_table(), missing=True), Robot(X_WO=None),
    ):  # fmt: skip
        found = look(robot, "1.1", "1.2")
        assert found.done == frozenset()
        assert len(found.again) == 1
        assert "red cup" in found.again[0][1]


def test_what_is_in_the_hand_is_held_as_the_journal_knows_it(look):
    held = {
        "left": {"object_id": CUP, "side": "left", "X_GO": SE3(), "gap_m": 0.07, "mass_kg": 0.2,
                 "carry_rad": [0.5] * 7}
    }  # fmt: skip
    found = look(Robot(X_WO=SE3(), held_by="left"), "1.1", held=msgspec.to_builtins(held))
    assert found.done == {"1.1"}
    assert [(one.object_id, one.carry_rad[0]) for one in found.held] == [(CUP, 0.5)]


def test_a_grip_that_the_journal_does_not_know_is_felt(look):
    found = look(Robot(X_WO=SE3((0.3, 0.2, 1.0)), held_by="right"), begun="1.1")
    (held,) = found.held
    assert (held.object_id, held.side, held.gap_m) == (CUP, "right", 0.05)
    assert held.carry_rad[0] == 0.1
    assert max(abs(value) for value in held.X_GO.p) < 1e-9


def test_what_left_the_hand_is_picked_up_again(look):
    for robot in (Robot(X_WO=on_table()), Robot(X_WO=SE3(), held_by="left", opening_m=0.001)):
        found = look(robot, "1.1")
        assert found.done == frozenset()
        assert found.held == ()
        assert found.again[0][1].endswith("is in no hand")


def test_a_putting_down_that_was_all_but_finished_is_done(look):
    assert look(Robot(X_WO=on_table()), "1.1", begun="1.2").done >= {"1.2"}


def test_the_newest_job_is_gone_on_with_and_what_was_done_before_it_died():
    def submit(number, **origin):
        return Event(number, 0.0, "request", {"request": "submit", "origin": origin})

    def event(number, kind):
        return Event(number, 0.0, kind, {})

    events = [event(0, "run"), submit(1), event(2, "done"), submit(3), event(4, "done"),
              event(5, "resumed"), submit(6, done=["1"]), event(7, "done")]  # fmt: skip
    assert [one.n for one in continuation.newest_job(events)] == [3, 4, 5, 6, 7]
