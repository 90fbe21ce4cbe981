"""What a page says to a robot that `humanoid do` has set to work goes on from that."""

import json
import socket
import time

from executive.frontends.console.desk import FILE
from executive.frontends.prompt.attached import attached
from executive.meaning import request
from executive.runs import run_folder
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import HANG_S


def test_now_the_blue_one_is_about_what_the_command_was_about(tmp_path):
    folder = tmp_path / "run"
    run_folder.claim(folder)
    with puppet_shell(folder, []) as shell:
        robot = shell.robot
        first = request.request("put the red cup on the table", robot.where)
        assert isinstance(first, request.Understood)
        robot.submit(first)
        with (
            attached(robot.session, None, lambda _text: None, first.goals),
            socket.socket(socket.AF_UNIX) as page,
        ):
            page.connect(json.loads((folder / FILE).read_text())["socket"])
            page.sendall(json.dumps({"line": "now the blue one"}).encode() + b"\n")
            limit_s = time.monotonic() + HANG_S
            while len(robot.executive.jobs) < 2:
                assert time.monotonic() < limit_s
                time.sleep(0.02)
        assert [job.state for job in robot.executive.jobs] == ["running", "waiting"]
        assert "the blue" in robot.executive.jobs[1].text
        shell.stop("the test is over")
