"""A file that is not there is told with the one beside it that was probably meant."""

import pytest

from robot.errors import ConfigError
from robot.files.yaml_nodes import read_text


@pytest.mark.parametrize(
    ("asked", "cure"),
    [
        ("tidy_up.yml", "did you mean '{folder}/tidy_up.yaml'?"),
        ("tidyup.yaml", "did you mean '{folder}/tidy_up.yaml'?"),
        ("zzz", "check the path"),
        ("nowhere/tidy_up.yaml", "check the path"),
    ],
)
def test_the_nearest_name_is_told(tmp_path, asked: str, cure: str):
    for name in ("tidy_up.yaml", "notes.txt", "tidy\x1b[2Jup.yaml"):
        (tmp_path / name).touch()
    with pytest.raises(ConfigError) as caught:
        read_text(tmp_path / asked)
    (problem,) = caught.value.problems
    assert problem.message == "there is no such file"
    assert problem.suggestion == cure.format(folder=tmp_path)
