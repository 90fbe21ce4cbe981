"""Every figure of a robot stands in its own file: no type of a description lends it another's."""

from pathlib import Path

import msgspec
import pytest

from robot.errors import ConfigError
from robot.files import config, yaml_nodes
from robot.model import description, gait, handling, keyframes, paces

EXAMPLES = Path(__file__).parents[4] / "examples"
NONE_OF_IT = (None, False, 0.0, "", (), (0.0, 0.0))
COURIER = EXAMPLES / "robot_courier" / "courier.yaml"
SHIPPED = Path(description.__file__).parent
WRITTEN = [*(SHIPPED / name / f"{name}.yaml" for name in description.shipped()), COURIER]
TYPES = [
    kind
    for module in (gait, handling, keyframes, paces)
    for kind in vars(module).values()
    if isinstance(kind, type) and issubclass(kind, msgspec.Struct) and kind is not msgspec.Struct
] + [description.Gaze, description.Motor, description.Heating, description.Battery]


@pytest.mark.parametrize("kind", TYPES, ids=lambda kind: kind.__name__)
def test_what_may_be_left_out_is_what_a_robot_has_not(kind):
    for field in msgspec.structs.fields(kind):
        assert field.default_factory is msgspec.NODEFAULT
        assert field.default is msgspec.NODEFAULT or field.default in NONE_OF_IT, field.name


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.stem)
def test_what_is_shipped_and_shown_is_complete(path: Path):
    """Also of robots whose MJCF is not here."""
    robot = config.convert(yaml_nodes.read(path), description.RobotDescription)
    assert robot.walking.exact_steps.least_s > 0.0


def test_a_figure_that_is_missing_is_told_with_its_place(tmp_path):
    text = COURIER.read_text()
    assert text.count("  settle_s: 0.25\n") == 1
    path = tmp_path / "courier.yaml"
    path.write_text(text.replace("  settle_s: 0.25\n", ""))
    with pytest.raises(ConfigError) as caught:
        description.load(str(path))
    (problem,) = caught.value.problems
    assert problem.message == "walking.settle_s is missing"
    assert problem.file == str(path)
    assert path.read_text().splitlines()[problem.line - 1] == "walking:"
