"""What tests of the prompt share."""

from collections.abc import Iterator

import pytest

from executive.frontends.prompt.shell import Shell
from tests.fakes.fast_shell import shell_in


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shell]:
    with shell_in(tmp_path_factory.mktemp("run")) as shell:
        yield shell


@pytest.fixture
def shell(shared: Shell) -> Shell:
    shared.robot.wait()
    shared.out.clear()
    shared.refused = 0
    shared.dialogue.forget()
    return shared
