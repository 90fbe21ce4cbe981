"""What waits when the robot is stopped or is to be down: it is not read any more."""

from __future__ import annotations

from pathlib import Path

import pytest

from executive.frontends.console.desk import Desk, Order
from executive.frontends.emergency import AT_THE_MACHINE, AT_THE_ROBOT
from executive.frontends.since_boot import now_s
from intents.dialogue import Dialogue
from robot.errors import RobotError
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import eventually

LONG = "go to the table and " * 50


def read_nothing(*_: object) -> None:
    pytest.fail("a line was read that comes to nothing")


def test_a_line_from_before_a_stop_is_not_read_again(tmp_path: Path, monkeypatch):
    said: list[str] = []
    with puppet_shell(tmp_path, said) as shell:
        before = shell.stops
        shell.stop("by another")
        monkeypatch.setattr(shell.brake, "is_cry", read_nothing)
        monkeypatch.setattr(Dialogue, "hear", read_nothing)
        monkeypatch.setattr(shell, "halt_at_once", read_nothing)
        shell.line(LONG, stops=before)
    (told,) = [one for one in said if "was there when you said stop" in one]
    assert len(told) < 300


@pytest.mark.parametrize("stops", [None, 10_000])
def test_nothing_begins_any_more_once_the_robot_is_left(tmp_path: Path, stops: int | None):
    said: list[str] = []
    with puppet_shell(tmp_path, said) as shell:
        shell.leave()
        shell.line("walk to the shelf", stops=shell.stops if stops else None)
        assert not shell.robot.executive.jobs
    assert "walk to the shelf" in said[-1]


def test_a_line_that_is_understood_while_the_robot_is_closed_begins_nothing(tmp_path: Path):
    """It was read for seconds, and whoever closes the robot does not wait for it."""
    said: list[str] = []
    with puppet_shell(tmp_path, said) as shell:
        join = shell.robot._thread.join

        def join_later(timeout: float | None = None) -> None:
            shell.line("walk to the shelf")
            join(timeout)

        shell.robot._thread.join = join_later
    assert said[-1].startswith("Not done: the robot comes to its end")
    assert not shell.robot.executive.jobs


def test_lines_of_a_page_that_wait_do_not_keep_a_robot_up(tmp_path: Path, monkeypatch):
    said: list[str] = []
    private = tmp_path / "private"
    private.mkdir()
    with puppet_shell(tmp_path, said) as shell:
        with Desk(shell, folder=tmp_path, private=private) as desk, shell._one_line:
            desk._heed(Order(line="walk to the shelf"))
            for _ in range(5):
                desk._heed(Order(line=LONG))
            shell.stop("the robot is to be down")
            shell.leave()
            read: list[object] = []
            monkeypatch.setattr(Dialogue, "hear", lambda *words, **_: read.append(words))
        assert eventually(lambda: not any(one.is_alive() for one in desk._worker._threads))
        assert not read
        assert not shell.robot.executive.jobs


def test_what_a_page_said_before_a_stop_sets_nothing_going_after_it(tmp_path: Path):
    """It was on its way still when the stop, which waits for nobody, was heeded."""
    said: list[str] = []
    private = tmp_path / "private"
    private.mkdir()
    with (
        puppet_shell(tmp_path, said) as shell,
        Desk(shell, folder=tmp_path, private=private) as desk,
    ):
        before_s = now_s()
        desk._heed(Order(do="stop", begun_s=now_s()))
        desk._heed(Order(line="walk to the shelf", begun_s=before_s))
        assert eventually(lambda: any("was there when you said stop" in one for one in said))
        assert not shell.robot.executive.jobs


def test_an_emergency_stop_is_undone_by_nobody_afar_by_no_slip_either(tmp_path: Path):
    said: list[str] = []
    with puppet_shell(tmp_path, said) as shell:
        shell.line("estop")
        for text in ("release", "yes", "estp release", "yes", "éstop release", "estop  reset"):
            shell.line(text, afar=True)
        assert shell.robot.executive.estop.latched
        with pytest.raises(RobotError):  # it was not even released
            shell.robot.executive.reset_estop()
        assert sum(AT_THE_ROBOT in one for one in said) == 4
        shell.line("release")
        shell.line("yes")
        shell.line("estop reset")
        assert not shell.robot.executive.estop.latched


@pytest.mark.parametrize("names", ["here.yaml", "/tmp/x.sh", ".profile.d/x.sh", "../x.yaml"])
def test_nobody_afar_writes_or_reads_a_file(tmp_path: Path, monkeypatch, names):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "here.yaml").write_text("secret: yes\n")
    before = sorted(tmp_path.iterdir())
    said: list[str] = []
    with puppet_shell(tmp_path / "run", said) as shell:
        shell.line(f"save mission {names}", afar=True)
        shell.line(f"run {Path(names).with_suffix('.yaml')}", afar=True)
        assert sum(AT_THE_MACHINE in one for one in said) == 2
        assert not any("secret" in one for one in said)
        said.clear()
        shell.line("run to the table", afar=True)  # no mission, but a sentence
        assert not any(AT_THE_MACHINE in one for one in said)
    assert [one for one in sorted(tmp_path.iterdir()) if one.name != "run"] == before
