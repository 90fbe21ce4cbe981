"""A campaign at the command line, from its file to its table, and on a local Ray."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fakes.waiting import eventually

CASES = """\
cases:
  - name: controller killed
    mission: stand for 5 seconds
    world: empty
    faults:  # the third is the last
      - {at_s: 0.5, fault: kill, process: controller}
      - {at_s: 0.5, fault: kill, process: controller}
      - {at_s: 0.5, fault: kill, process: controller}
    expect: [controller_lost]
    damped: true
  - name: nothing
    mission: stand for 1 second
    world: empty
    truth: [{at: [0, 0]}]
  - name: shoved hard
    mission: stand for 3 seconds
    world: empty
    faults: [{at_s: 0.5, fault: shove, strength_n_s: 60}]
    truth: [{at: [0, 0]}]
"""


def command(folder: Path, *options: str) -> list[str]:
    campaign = folder / "cases.yaml"
    campaign.write_text(CASES)
    return [
        *(sys.executable, "-m", "executive", "eval", "--faults", str(campaign), "--json"),
        *("--seeds", "1", *options),
    ]


def evaluate(folder: Path, *options: str) -> tuple[int, dict]:
    done = subprocess.run(
        command(folder, *options),
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
    )
    return done.returncode, json.loads(done.stdout)


def below(pid: int) -> list[int]:
    """Process ids of a process's children."""
    return [int(text) for text in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def test_nothing_of_a_campaign_that_is_killed_goes_on(tmp_path):
    job = subprocess.Popen(command(tmp_path, "-j", "2"), stdout=subprocess.DEVNULL, cwd=tmp_path)
    try:
        assert eventually(lambda: len(below(job.pid)) >= 3)  # and a tracker
        workers = below(job.pid)
    finally:
        job.kill()
        job.wait()
    alive = lambda: [pid for pid in workers if Path(f"/proc/{pid}/exe").exists()]  # noqa: E731
    assert eventually(lambda: not alive()), alive()


@pytest.mark.slow
def test_a_campaign_tells_the_right_ends_from_the_wrong_ones_and_is_resumed(tmp_path):
    status, found = evaluate(tmp_path, "-j", "1")
    assert status == 1
    rows = {row["case"]: row["with_recovery"] for row in found["rows"]}
    assert rows["controller killed"]["ok"] == 1
    assert rows["nothing"]["ok"] == 1
    assert next(iter(rows["shoved hard"]["wrong"])).endswith(", unsafe")
    assert (found["unsafe"], found["without_code"], found["judged_by"]) == (1, 0, "oracle")
    (results,) = (tmp_path / "runs").glob("*/results.jsonl")
    before = results.read_bytes()
    folder = str(results.parent)
    status, again = evaluate(tmp_path, "-j", "1", "--require", "0", "--resume", folder)
    assert (status, again) == (0, found)
    assert results.read_bytes() == before


@pytest.mark.slow
@pytest.mark.rest
def test_the_same_campaign_on_a_local_ray(tmp_path):
    pytest.importorskip("ray", reason="Ray is not installed (pip install humanoid-executive[ray])")
    status, found = evaluate(tmp_path, "--ray")
    assert status == 1
    assert found["runs"] == 3
    assert [row["with_recovery"]["ok"] for row in found["rows"]] == [1, 1, 0]
