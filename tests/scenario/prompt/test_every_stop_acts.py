"""Every stop acts, whatever the terminal sends and the prompt is in the midst of."""

from pathlib import Path

import pytest

from benchmarks.prompt_stops import tries

pytestmark = pytest.mark.live

TRIES = 15
"""Of the thousand that `python -m benchmarks.prompt_stops` makes."""


@pytest.mark.slow
def test_no_stop_is_lost(tmp_path: Path):
    result = tries(TRIES, seed=0, folder=tmp_path)
    assert result.lost == []
    assert result.tried.total() == TRIES
    assert result.tried["Ctrl-C"] > TRIES / 4
