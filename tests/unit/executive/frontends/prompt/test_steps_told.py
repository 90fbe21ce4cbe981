"""How far a job is, in steps, as a view of the robot says it."""

import time

from executive.runs import run_folder
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import HANG_S


def test_the_steps_of_a_job_are_counted_as_they_are_done(tmp_path):
    folder = tmp_path / "run"
    run_folder.claim(folder)
    with puppet_shell(folder, []) as shell:
        robot, seen = shell.robot, set()
        assert robot.view.steps == (0, 0)
        shell.line("wait 1 second, then wait 30 seconds, then wait 2 seconds")
        limit_s = time.monotonic() + HANG_S
        while not any(done for done, _ in seen):
            assert time.monotonic() < limit_s
            seen.add(robot.view.steps)
            time.sleep(0.02)
        done, steps = max(seen)
        assert 0 < done < steps
        shell.stop("the test is over")
        robot.wait()
        while robot.view.steps != (0, 0):
            assert time.monotonic() < limit_s
            time.sleep(0.02)
