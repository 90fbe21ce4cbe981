"""What tests of front ends share."""

import pytest

from tests.fakes.workbench import Workbench


@pytest.fixture
def workbench(monkeypatch: pytest.MonkeyPatch) -> Workbench:
    """Emulated motors in simulated time."""
    return Workbench(monkeypatch)
