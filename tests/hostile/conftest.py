"""One fork-server for all cases of a process, and the share of them that is run."""

import os
import tempfile
from collections.abc import Generator
from pathlib import Path

import pytest

from tests.hostile.exam import Examiner


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what is not in the share, unless all is asked for, or some by name."""
    if any(config.getoption(name) for name in ("--hostile-all", "everything", "keyword")):
        return
    rest = [item for item in items if item.get_closest_marker("hostile_rest")]
    config.hook.pytest_deselected(items=rest)
    items[:] = [item for item in items if not item.get_closest_marker("hostile_rest")]


@pytest.fixture(scope="session")
def examiner() -> Generator[Examiner]:
    """In a folder of its own: pytest closes its own one to others whenever it is begun anew."""
    with tempfile.TemporaryDirectory(prefix="hostile-", ignore_cleanup_errors=True) as made:
        folder = Path(made)
        for parent in (folder, *folder.parents):
            if parent.stat().st_uid == os.getuid() and not parent.stat().st_mode & 0o005:
                parent.chmod(0o755)  # other users have to get through to their case
        examiner = Examiner(folder)
        yield examiner
        examiner.close()
