"""What all tests share: one hypothesis profile, and the machine.

Tests run side by side (`make test`), each on one core. Those marked `live` have processes of their
own that keep time by the wall clock: while one of them runs, none of the others does. What else the
machine does meanwhile is not in our hands; so a live test that fails while much of the machine went
to others is skipped, with the figure.

What takes long and shows again what others show in less (a fourth direction, an errand of parts
that are shown one by one) is marked `rest` and left out of a plain run; `--all`, `-k`, or the name
of its file runs it.
"""

import fcntl
import math
import os
import sys
from collections import Counter
from collections.abc import Generator
from pathlib import Path

import pytest
from hypothesis import settings

import executive  # noqa: F401  # before numpy: one thread for small matrices, as everywhere
from tests.fakes.machine import Others

# Repeatable, and patient with a slow machine: a deadline would fail a test for the machine's sake.
settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("share", settings.get_profile("repeatable"), max_examples=50)
settings.load_profile("repeatable")

# The programs that tests start are read from bytecode, whatever the shell wishes for what it
# starts: compiled anew each time, they take half as long again.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

MOST_FOR_OTHERS = 0.15
"""Share of the machine beyond which the robot may notice that it is not given its time."""

_others = pytest.StashKey[Others]()


@pytest.fixture(scope="session", autouse=True)
def maps_of_their_own(tmp_path_factory: pytest.TempPathFactory) -> Generator[None]:
    """No test depends on the maps that whoever runs it keeps at home."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def pytest_addoption(parser: pytest.Parser) -> None:
    """What only some runs want; here, as pytest asks the topmost conftest only."""
    whole = "every case of tests/hostile, of which a share is run otherwise"
    parser.addoption("--hostile-all", action="store_true", help=whole)
    rest = "what is marked `rest` as well, and every case of tests/hostile"
    parser.addoption("--all", action="store_true", dest="everything", help=rest)


def pytest_configure(config: pytest.Config) -> None:
    """Of what hypothesis makes, half, unless all is asked for: it is the same in every run."""
    settings.load_profile("repeatable" if _asks_for_all(config) else "share")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the rest unless it is asked for, and put first what would be a long tail.

    Workers take file by file: what has the machine alone, then what took longest the last time, or
    where nobody knows, what usually takes long.
    """
    if not _asks_for_all(config):
        rest = [item for item in items if item.get_closest_marker("rest")]
        config.hook.pytest_deselected(items=rest)
        items[:] = [item for item in items if not item.get_closest_marker("rest")]
    if hasattr(config, "workerinput"):
        took_s = config.cache.get(TOOK, {})
        places: dict[Path, float] = {}
        for item in items:
            known_s = took_s.get(_file(item.nodeid))
            place = math.inf if _is_live(item) else known_s or _usual_s(item)
            places[item.path] = max(places.get(item.path, 0.0), place)
        items.sort(key=lambda item: -places[item.path])


_took_s: Counter[str] = Counter()
"""By file, in the process that hands out the tests."""


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Note how long it took."""
    _took_s[_file(report.nodeid)] += report.duration


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Keep what the files took, if all of each was run."""
    config = session.config
    is_part = bool(config.getoption("keyword") or any(".py" in word for word in config.args))
    is_told = not hasattr(config, "workerinput") and hasattr(config, "cache")
    if is_told and not (is_part or config.getoption("collectonly")):
        before = config.cache.get(TOOK, {})
        config.cache.set(TOOK, before | {name: round(s, 1) for name, s in _took_s.items()})


def _file(nodeid: str) -> str:
    return nodeid.partition("::")[0]


def _asks_for_all(config: pytest.Config) -> bool:
    named = any(".py" in word for word in config.args)
    return bool(named or config.getoption("everything") or config.getoption("keyword"))


TOOK = "machine/took_s"
"""Seconds that each file took the last time, in pytest's cache."""
USUAL_S = {"scenario": 30.0, "hostile": 20.0, "contract": 10.0, "planning": 10.0, "training": 10.0}
"""Of a file somewhere below such a folder [s]."""


def _usual_s(item: pytest.Item) -> float:
    folders = item.path.relative_to(item.config.rootpath).parts
    return next((s for name, s in USUAL_S.items() if name in folders), 1.0)


def _is_live(item: pytest.Item) -> bool:
    return item.get_closest_marker("live") is not None


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Share the machine with the other workers of this run, or have it alone."""
    if not hasattr(item.config, "workerinput"):  # nobody is beside this process
        return (yield)
    path = item.config.cache.mkdir("machine") / "lock"
    with path.open("a") as machine:
        fcntl.flock(machine, fcntl.LOCK_EX if _is_live(item) else fcntl.LOCK_SH)
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """Measure what else the machine does during a live test."""
    if not _is_live(item):
        return (yield)
    with Others() as item.stash[_others]:
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, object]:
    """Tell a live test that failed from a machine that did not give it its time."""
    report = yield
    others = item.stash.get(_others, None)
    busy = others is not None and others.share > MOST_FOR_OTHERS
    if busy and report.when == "call" and report.failed:
        path, line, _ = item.location
        share = f"{100 * others.share:.0f} % of the machine went to other programs"
        report.outcome = "skipped"
        report.longrepr = (path, line or 0, f"it failed, but {share}: run it again alone")
    return report
