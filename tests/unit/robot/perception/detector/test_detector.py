"""Boxes out of networks of YOLO's kind: small ones, made here, that say what they are told to."""

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper, numpy_helper
from PIL import Image

from robot.errors import ConfigError
from robot.perception.detector import onnx_file
from robot.perception.detector.detector import Detector
from robot.perception.detector.labels import read_labels
from robot.perception.detector.letterbox import letterboxed
from robot.perception.detector.overlaps import without_overlaps
from robot.perception.detector.yolo import Candidates, decoded

pytest.importorskip("onnxruntime")

NAMES = ("cup", "bottle", "person")
SIDE = 64


def telling(path, output, *, kind=TensorProto.FLOAT, shape=(1, 3, SIDE, SIDE)):
    """A network that says `output` scaled by how bright the picture is at its middle (1: white)."""
    floats = np.float16 if kind == TensorProto.FLOAT16 else np.float32
    middle = [0, 1, shape[2] // 2 if isinstance(shape[2], int) else SIDE // 2, SIDE // 2]
    constants = {
        "begin": np.array(middle), "end": np.array(middle) + 1, "flat": np.array([1, 1, 1]),
        "told": np.asarray(output).astype(floats),
    }  # fmt: skip
    graph = helper.make_graph(
        [
            helper.make_node("Slice", ["images", "begin", "end"], ["pixel"]),
            helper.make_node("Reshape", ["pixel", "flat"], ["bright"]),
            helper.make_node("Mul", ["told", "bright"], ["output"]),
        ],
        "telling",
        [helper.make_tensor_value_info("images", kind, shape)],
        [helper.make_tensor_value_info("output", kind, None)],
        [numpy_helper.from_array(value, name) for name, value in constants.items()],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    onnx.save(model, path)
    return path


@pytest.fixture
def labels(tmp_path):
    path = tmp_path / "names.txt"
    path.write_text("\n".join(NAMES) + "\n")
    return path


# A bottle (0.9), the same again a pixel beside it (0.8), a cup (0.6), and what is too unlikely.
THINGS = [(20, 32, 16, 24, 1, 0.9), (21, 32, 16, 24, 1, 0.8), (48, 30, 8, 8, 0, 0.6)]
NOISE = (10, 30, 5, 5, 2, 0.1)


def version_8(things) -> np.ndarray:
    rows = np.zeros((4 + len(NAMES), 40), dtype=np.float32)
    for number, (x, y, width, height, name, score) in enumerate([*things, NOISE]):
        rows[:4, number] = x, y, width, height
        rows[4 + name, number] = score
    return rows[None]


def version_5(things) -> np.ndarray:
    rows = np.zeros((40, 5 + len(NAMES)), dtype=np.float32)
    for number, (x, y, width, height, name, score) in enumerate([*things, NOISE]):
        rows[number, :5] = x, y, width, height, score / 0.95
        rows[number, 5 + name] = 0.95
    return rows[None]


def end_to_end(things) -> np.ndarray:
    rows = [
        (x - width / 2, y - height / 2, x + width / 2, y + height / 2, score, name)
        for x, y, width, height, name, score in [*things, NOISE]
    ]
    return np.array([rows], dtype=np.float32)


LAYOUTS = {
    "version 8": version_8,
    "its transpose": lambda things: version_8(things).transpose(0, 2, 1),
    "version 5": version_5,
    "end to end": end_to_end,
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_boxes_are_those_of_the_picture(layout, labels, tmp_path):
    model = telling(tmp_path / "model.onnx", LAYOUTS[layout](THINGS))
    # Twice as wide as the network's picture, and half as high: 16 px of grey above and below.
    white = np.full((64, 128, 3), 255, dtype=np.uint8)
    found = Detector(model, labels).detect(white)
    assert [one.name for one in found] == ["bottle", "cup"]
    assert [one.score for one in found] == pytest.approx([0.9, 0.6], abs=1e-3)
    assert found[0].box == pytest.approx((24.0, 8.0, 56.0, 56.0), abs=0.01)
    assert found[1].box == pytest.approx((88.0, 20.0, 104.0, 36.0), abs=0.01)


def test_what_is_said_depends_on_the_picture(labels, tmp_path):
    model = telling(tmp_path / "model.onnx", version_8(THINGS))
    assert Detector(model, labels).detect(np.zeros((64, 64, 3), dtype=np.uint8)) == ()
    grey = np.full((64, 64, 3), 128, dtype=np.uint8)
    assert [one.score for one in Detector(model, labels).detect(grey)] == pytest.approx(
        [0.9 * 128 / 255, 0.6 * 128 / 255], abs=1e-3
    )


def test_half_floats_and_open_sizes(labels, tmp_path):
    white = np.full((64, 64, 3), 255, dtype=np.uint8)
    half = telling(tmp_path / "half.onnx", version_8(THINGS), kind=TensorProto.FLOAT16)
    assert [one.name for one in Detector(half, labels).detect(white)] == ["bottle", "cup"]
    free = telling(tmp_path / "free.onnx", version_8(THINGS), shape=(1, 3, "height", "width"))
    assert [one.name for one in Detector(free, labels).detect(white)] == ["bottle", "cup"]


def test_boxes_end_at_the_edge_of_the_picture(labels, tmp_path):
    model = telling(tmp_path / "model.onnx", version_8([(2, 32, 30, 200, 2, 0.9)]))
    (found,) = Detector(model, labels).detect(np.full((64, 64, 3), 255, dtype=np.uint8))
    assert found.box == pytest.approx((0.0, 0.0, 17.0, 64.0))


def test_names_of_another_network_are_refused(tmp_path):
    other = tmp_path / "other.txt"
    other.write_text("cup\n")
    model = telling(tmp_path / "model.onnx", version_8(THINGS))
    detector = Detector(model, other)
    with pytest.raises(ConfigError, match="does not fit 1 names"):
        detector.detect(np.full((64, 64, 3), 255, dtype=np.uint8))


@pytest.mark.parametrize(
    ("shape", "kind", "says"),
    [
        ((1, 1, SIDE, SIDE), TensorProto.FLOAT, "does not take one picture"),
        ((1, 3, 9000, SIDE), TensorProto.FLOAT, "more than 4096 px"),
        ((1, 3, SIDE, SIDE), TensorProto.INT32, "not floating numbers"),
    ],
)
def test_networks_that_do_something_else_are_refused(shape, kind, says, labels, tmp_path):
    flat = helper.make_node("Flatten", ["images"], ["output"])
    graph = helper.make_graph(
        [flat], "other", [helper.make_tensor_value_info("images", kind, shape)],
        [helper.make_tensor_value_info("output", kind, None)],
    )  # fmt: skip
    path = tmp_path / "other.onnx"
    opset = [helper.make_opsetid("", 17)]
    onnx.save(helper.make_model(graph, opset_imports=opset, ir_version=8), path)
    with pytest.raises(ConfigError, match=says):
        Detector(path, labels)


def test_a_file_that_is_no_network_is_refused(labels, tmp_path):
    path = tmp_path / "model.onnx"
    for data in (b"", b"no network", telling(tmp_path / "x.onnx", version_8([])).read_bytes()[:60]):
        path.write_bytes(data)
        with pytest.raises(ConfigError, match="no network in ONNX"):
            Detector(path, labels)


def test_overlaps_are_one_thing_only_under_one_name():
    boxes = np.array([[0, 0, 10, 10], [1, 0, 11, 10], [1, 0, 11, 10], [40, 0, 50, 10]], np.float32)
    names, scores = np.array([0, 0, 1, 0]), np.array([0.8, 0.9, 0.7, 0.3], np.float32)
    several = Candidates(boxes, names, scores)
    assert without_overlaps(several, least_score=0.2, overlap=0.5).tolist() == [1, 2, 3]
    assert without_overlaps(several, least_score=0.2, overlap=0.9).tolist() == [1, 0, 2, 3]
    assert without_overlaps(several, least_score=0.5, overlap=0.5).tolist() == [1, 2]


def test_numbers_that_are_none_are_no_things():
    boxes = np.array([[0, 0, np.nan, 10], [0, 0, 10, 10], [np.inf] * 4], np.float32)
    several = Candidates(boxes, np.zeros(3, np.intp), np.array([0.9, np.nan, 0.9], np.float32))
    assert without_overlaps(several, least_score=0.0, overlap=0.5).tolist() == []


@pytest.mark.parametrize("shape", [(1, 7), (2, 7, 40), (1, 9, 40), (1, 40, 9), (1, 0, 7)])
def test_outputs_of_no_known_layout_are_refused(shape):
    with pytest.raises(ValueError, match="shape"):
        decoded(np.zeros(shape, dtype=np.float32), 3)


def test_a_letterbox_keeps_proportions():
    picture = np.zeros((10, 40, 3), dtype=np.uint8)
    tensor, letterbox = letterboxed(picture, (80, 80))
    assert tensor.shape == (1, 3, 80, 80)
    assert tensor[0, 0, 39, 40] == 0.0
    assert tensor[0, 0, 0, 0] == pytest.approx(114 / 255)
    box = np.array([[0, 30, 80, 50]], dtype=np.float32)
    assert letterbox.boxes_in_picture(box, (40, 10)).tolist() == [[0, 0, 40, 10]]


def test_labels_in_lines_and_in_yaml(tmp_path, labels):
    assert read_labels(labels) == NAMES
    as_list, numbered = tmp_path / "list.yaml", tmp_path / "numbered.yml"
    as_list.write_text("names: [cup, bottle, person]\n")
    numbered.write_text("path: .\nnames:\n  0: cup\n  2: person\n  1: bottle\n")
    assert read_labels(as_list) == read_labels(numbered) == NAMES


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.txt", ""), ("a.txt", "cup\n\nbottle\n"), ("a.txt", "x" * 300), ("a.yaml", "nc: 3\n"),
        ("a.yaml", "names: {0: cup, 2: bottle}\n"), ("a.yaml", "names: []\n"), ("a.yaml", "names"),
    ],
)  # fmt: skip
def test_labels_that_name_nothing_are_refused(name, text, tmp_path):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(ConfigError):
        read_labels(path)


def test_pictures_of_all_kinds_are_read(tmp_path):
    from robot.files.pictures import read_colour, read_grey

    grey16 = tmp_path / "depth.png"
    Image.fromarray(np.full((4, 6), 40000, dtype=np.uint16)).save(grey16)
    assert read_grey(grey16).tolist() == [[40000 >> 8] * 6] * 4
    see_through = tmp_path / "icon.png"
    Image.new("RGBA", (3, 2), (10, 20, 30, 0)).save(see_through)
    assert read_colour(see_through).shape == (2, 3, 3)


def lying_elsewhere(where, name, path):
    """A network one of whose tensors is said to be in another file."""
    tensor = TensorProto(name="w", data_type=TensorProto.FLOAT, dims=[1])
    tensor.data_location = TensorProto.EXTERNAL
    tensor.external_data.add(key="location", value=name)
    held = telling(path, np.zeros((1, 7, 40)))
    model = onnx.load(held)
    node = helper.make_node("Constant", [], ["c"])
    match where:
        case "initializer":
            model.graph.initializer.append(tensor)
        case "sparse":
            model.graph.sparse_initializer.add().values.CopyFrom(tensor)
        case "node":
            node.attribute.append(helper.make_attribute("value", tensor))
            model.graph.node.append(node)
        case "branch":
            graph = helper.make_graph([node], "branch", [], [], [])
            graph.initializer.append(tensor)
            model.graph.node.append(helper.make_node("If", ["c"], ["d"], then_branch=graph))
        case _:
            node.attribute.append(helper.make_attribute("value", tensor))
            function = helper.make_function("own", "f", [], ["c"], [node], [])
            model.functions.append(function)
    path.write_bytes(model.SerializeToString())
    return path


@pytest.mark.parametrize("where", ["initializer", "sparse", "node", "branch", "function"])
def test_weights_in_other_files_are_not_read(tmp_path, labels, monkeypatch, where):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "secret").write_bytes(bytes(100))
    with pytest.raises(ConfigError, match="in other files"):
        Detector(lying_elsewhere(where, "secret", tmp_path / "net.onnx"), labels)


def test_a_network_that_is_whole_is_taken_for_one(tmp_path):
    data = telling(tmp_path / "net.onnx", np.zeros((1, 7, 40))).read_bytes()
    assert onnx_file.is_whole(data)
    for broken in (data[:-3], b"\xff" * 20, b"\x0b", data[: len(data) // 2]):
        with pytest.raises(ValueError, match=r"end|groups"):
            onnx_file.is_whole(broken)


class Counted(bytes):
    """A file that knows how often it was looked at."""

    looks = 0

    def __getitem__(self, at):
        Counted.looks += 1
        return super().__getitem__(at)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"\x3a\x00" * 3_000_000, "more fields"),
        (b"\x00" * 9, "no field"),
        (b"\xba\x80\x80\x80\x10\x00", "no field"),
    ],
    ids=["many", "none", "beyond 32 bits"],
)
def test_a_file_of_a_strangers_fields_is_given_up_soon(data, says, monkeypatch):
    monkeypatch.setattr(Counted, "looks", 0)
    with pytest.raises(ValueError, match=says):
        onnx_file.is_whole(Counted(data))
    assert Counted.looks <= 2 * onnx_file.MOST_FIELDS + 10


def holding(field, data):
    """A field that holds a message."""
    size, digits = len(data), b""
    while size > 0x7F:
        digits, size = digits + bytes([size & 0x7F | 0x80]), size >> 7
    return bytes([field << 3 | 2]) + digits + bytes([size]) + data


def test_messages_within_messages_end():
    graph = b""
    for _ in range(onnx_file.MOST_DEPTH):
        graph = holding(1, holding(5, holding(6, graph)))  # node, its attribute, the graph of that
    with pytest.raises(ValueError, match="deeper"):
        onnx_file.is_whole(holding(7, graph))


@pytest.mark.parametrize("odd", [np.nan, np.inf, -np.inf, 3e38])
def test_what_is_no_number_is_no_box(odd):
    output = version_8(THINGS)
    output[0, 0, 0] = output[0, 4, 1] = odd
    with np.errstate(all="raise"):
        found = decoded(output, len(NAMES))
    assert np.isfinite(found.boxes).all() and np.isfinite(found.scores).all()
    assert 38 <= len(found.scores) <= 39
