"""What a live run leaves behind when it closes."""

from pathlib import Path

import msgspec
import pytest

from robot.bringup.live import LiveRuntime
from robot.messages import LoopTiming
from sim.simulation import Simulation

TIMING = LoopTiming(
    stamp_s=1.0, process="plant", period_s=0.001, count=1000, late=1, p50_s=0.0, p99_s=0.0,
    p999_s=0.0, max_s=0.0, real_time_factor=1.0, late_share=0.0, pressed=False,
)  # fmt: skip


@pytest.fixture
def closed(tmp_path: Path):
    """Closes a run that never started, with a report of its loops."""

    def close() -> Path:
        runtime = LiveRuntime(Simulation().world("empty"), folder=tmp_path)
        runtime.timing = {"plant": TIMING}
        runtime.close()
        return tmp_path / "timing.json"

    return close


def test_how_well_the_loops_kept_time_is_kept(closed):
    assert msgspec.json.decode(closed().read_bytes())["plant"]["count"] == 1000


def test_a_full_disk_is_no_mistake_of_the_software(closed, tmp_path):
    (tmp_path / "timing.json").symlink_to("/dev/full")
    closed()
