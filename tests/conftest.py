"""What all tests share: one hypothesis profile, and the machine.

Tests run side by side (`make test`), each on one core. Those marked `live` have processes of their
own that keep time by the wall clock: while one of them runs, nothing else does.
"""

import fcntl

import pytest
from hypothesis import settings

# Repeatable, and patient with a slow machine: a deadline would fail a test for the machine's sake.
settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("repeatable")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item):
    """Share the machine with the other workers of this run, or have it alone."""
    if not hasattr(item.config, "workerinput"):  # nobody is beside this process
        return (yield)
    alone = item.get_closest_marker("live") is not None
    path = item.config.cache.mkdir("machine") / "lock"
    with path.open("a") as machine:
        fcntl.flock(machine, fcntl.LOCK_EX if alone else fcntl.LOCK_SH)
        return (yield)
