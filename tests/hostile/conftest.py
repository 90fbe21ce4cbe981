"""One fork-server for all cases of a process."""

import os
from collections.abc import Generator

import pytest

from tests.hostile.exam import Examiner


@pytest.fixture(scope="session")
def examiner(tmp_path_factory: pytest.TempPathFactory) -> Generator[Examiner]:
    folder = tmp_path_factory.mktemp("hostile")
    for parent in (folder, *folder.parents):
        if parent.stat().st_uid == os.getuid() and not parent.stat().st_mode & 0o005:
            parent.chmod(0o755)  # other users have to get through to their case
    examiner = Examiner(folder)
    yield examiner
    examiner.close()
