"""`--driver`: refused before anything starts where it does not apply."""

import pytest
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import ConfigError


@pytest.mark.parametrize("command", [("do", "walk 1 m forward"), ("walk",)])
@pytest.mark.parametrize(
    ("driver", "said"),
    [
        ("can", "motors on buses are driven in live runs only"),
        ("cann", "motors have no driver 'cann' (did you mean 'can'?)"),
        (
            "pigeon",
            "motors have no driver 'pigeon' (valid: can, dynamixel, ethernet, pwm, simulated)",
        ),
    ],
)
def test_what_cannot_drive_these_motors_is_refused(tmp_path, monkeypatch, command, driver, said):
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, [*command, "--fast", "--driver", driver])
    assert isinstance(result.exception, ConfigError)
    assert said in str(result.exception)
    assert not list(tmp_path.rglob("journal.jsonl"))
