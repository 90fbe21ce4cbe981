"""A run that is gone on with has the motors' driver, and the reality, that it was begun with."""

from types import SimpleNamespace

import pytest

from executive.frontends import carrying_out
from executive.frontends.past_runs import resume
from executive.frontends.prompt import cli as prompt
from executive.meaning import request
from executive.runs import run_folder
from executive.runs.runtimes import Setup
from robot.errors import ConfigError
from sim.simulation import Simulation


@pytest.fixture
def where():
    return request.setting(Simulation().under("real"), "empty", robot="juno", vary_seed=None)


def recorded(where, folder, *, driver: str):
    header = run_folder.header(
        Setup(where=where, kind="live", seed=3, folder=folder, driver=driver), text="walk"
    )
    return SimpleNamespace(header=header, folder=folder)


def setup_of_a_resumed(monkeypatch, where, found) -> Setup:
    """What `humanoid resume` would open the robot with."""
    left = SimpleNamespace(newest=lambda _: "an assignment")
    monkeypatch.setattr(resume.catching_up, "check", lambda _: found)
    monkeypatch.setattr(resume.recording, "setting", lambda *_: (where, []))
    monkeypatch.setattr(resume, "left_in", lambda _: left)
    monkeypatch.setattr(
        carrying_out,
        "carry_out",
        lambda prepare, *_, **__: setattr(found, "setup", prepare().setup) or 0,
    )
    wanted = resume.GoOn(left_by=found.folder, as_json=True)
    assert resume.go_on_live(wanted) == 0
    return found.setup


@pytest.mark.parametrize("driver", ["can", "simulated", ""])
def test_a_live_run_goes_on_with_its_driver(monkeypatch, tmp_path, where, driver):
    found = recorded(where, tmp_path / "run", driver=driver)
    assert setup_of_a_resumed(monkeypatch, where, found).driver == driver


def test_a_driver_that_there_is_not_any_more_is_refused_with_the_nearest(
    monkeypatch, tmp_path, where
):
    found = recorded(where, tmp_path / "run", driver="cann")
    with pytest.raises(ConfigError, match="did you mean 'can'"):
        setup_of_a_resumed(monkeypatch, where, found)


def test_a_prompt_goes_on_with_its_driver_and_reality(monkeypatch, tmp_path, where):
    asked = []
    monkeypatch.setattr(prompt, "launch", lambda _, options: asked.append(options) or 0)
    assert prompt.go_on_with(recorded(where, tmp_path, driver="can"), None) == 0
    assert (asked[0].driver, asked[0].reality) == ("can", "real")
