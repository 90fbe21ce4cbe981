"""A name is that of something shipped; only what has a file's suffix is looked for as a file."""

import os

import pytest

from executive.missions.load import find
from robot.errors import ConfigError
from robot.model import description
from sim import world


@pytest.mark.parametrize("load", [world.load, description.load])
@pytest.mark.parametrize("way", ["{0}", "{1}", "a/../{1}", "{0}/"])
def test_a_name_leads_nowhere(load, way, tmp_path):
    (tmp_path / "secret" / "secret").mkdir(parents=True)
    for folder in (tmp_path, tmp_path / "secret"):
        (folder / "secret.yaml").write_text("token: hunter2\n")
    relative = os.path.relpath(tmp_path / "secret", world.__file__)
    with pytest.raises(ConfigError, match=r"unknown (world|robot)") as refused:
        load(way.format(tmp_path / "secret", relative))
    assert "token" not in str(refused.value)


def test_a_missions_name_leads_nowhere(tmp_path):
    (tmp_path / "secret.yaml").touch()
    assert find(str(tmp_path / "secret")) == tmp_path / "secret"
    assert find("hello").is_file()
