"""Whisper from a folder: a model made here that writes down one sentence, whatever is said."""

import json
import socket

import numpy as np
import pytest

from intents.speech.audio import RATE_HZ, AudioError
from intents.speech.whisper import Whisper

onnx = pytest.importorskip("onnx")
pytest.importorskip("onnx_asr")

from onnx import TensorProto, helper  # noqa: E402

TOKENS = ["go", "Ġto", "Ġthe", "Ġtable", "."]
SPECIAL = {
    "<|endoftext|>": 5, "<|startoftranscript|>": 6, "<|en|>": 7, "<|transcribe|>": 8,
    "<|notimestamps|>": 9,
}  # fmt: skip
PROMPT = 4
"""Tokens that the decoder is given: start, language, task, no time stamps."""


def tensor(name, kind, shape):
    return helper.make_tensor_value_info(name, kind, shape)


def constant(name, values, kind=TensorProto.INT64):
    values = np.atleast_1d(values)
    return helper.make_tensor(name, kind, values.shape, values.ravel().tolist())


def save(path, nodes, inputs, outputs, initializers):
    graph = helper.make_graph(nodes, "g", inputs, outputs, initializers)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)])
    model.ir_version = 8
    onnx.checker.check_model(model)
    onnx.save(model, path)


def make(folder):
    """A model whose next token depends on how many there are already."""
    folder.mkdir(exist_ok=True)
    count = len(TOKENS) + len(SPECIAL)
    save(
        folder / "encoder_model.onnx",
        [helper.make_node("ReduceMean", ["input_features"], ["last_hidden_state"], axes=[1])],
        [tensor("input_features", TensorProto.FLOAT, ["b", 80, "t"])],
        [tensor("last_hidden_state", TensorProto.FLOAT, ["b", 1, "t"])],
        [],
    )
    table = np.zeros((PROMPT + len(TOKENS) + 2, count), np.float32)
    following = [*range(len(TOKENS)), SPECIAL["<|endoftext|>"], SPECIAL["<|endoftext|>"]]
    for number, token in enumerate(following):
        table[PROMPT + number, token] = 1.0
    save(
        folder / "decoder_model_merged.onnx",
        [
            helper.make_node("Shape", ["input_ids"], ["shape"]),
            helper.make_node("Gather", ["shape", "one"], ["length"]),
            helper.make_node("Gather", ["table", "length"], ["row"]),
            helper.make_node("Unsqueeze", ["row", "zero"], ["logits"]),
            helper.make_node("Identity", ["encoder_hidden_states"], ["unused"]),
        ],
        [tensor("input_ids", TensorProto.INT64, ["b", "n"]),
         tensor("encoder_hidden_states", TensorProto.FLOAT, ["b", 1, "t"])],
        [tensor("logits", TensorProto.FLOAT, [1, 1, count])],
        [constant("one", [1]), constant("zero", [0]), constant("table", table, TensorProto.FLOAT)],
    )  # fmt: skip
    (folder / "vocab.json").write_text(json.dumps({token: i for i, token in enumerate(TOKENS)}))
    (folder / "added_tokens.json").write_text(json.dumps(SPECIAL))
    (folder / "config.json").write_text(json.dumps({"model_type": "whisper", "num_mel_bins": 80}))
    return folder


@pytest.fixture
def offline(monkeypatch):
    def refuse(*_args, **_kwargs):
        raise AssertionError("nothing is fetched")

    monkeypatch.setattr(socket, "getaddrinfo", refuse)
    monkeypatch.setattr(socket.socket, "connect", refuse)


def test_it_writes_down_what_is_said(tmp_path, offline):
    recogniser = Whisper(make(tmp_path / "model"))
    sound = np.random.default_rng(0).normal(scale=0.1, size=RATE_HZ).astype(np.float32)
    heard = recogniser.recognise(sound)
    assert heard.text == "go to the table."
    assert heard.believed
    assert recogniser.recognise(np.zeros(0, np.float32)).text == ""


def test_a_folder_that_is_none_is_said(tmp_path, offline):
    with pytest.raises(AudioError, match="is no folder") as caught:
        Whisper(tmp_path / "none")
    assert "optimum-cli" in caught.value.cure
    with pytest.raises(AudioError, match="is no folder"):
        Whisper(None)


def test_a_folder_without_a_model_is_said(tmp_path, offline):
    with pytest.raises(AudioError, match="holds no Whisper model"):
        Whisper(tmp_path)


@pytest.mark.parametrize("name", ["encoder_model.onnx", "vocab.json", "added_tokens.json"])
def test_a_folder_with_a_broken_file_is_said(tmp_path, offline, name):
    folder = make(tmp_path / "model")
    (folder / name).write_text("{")
    with pytest.raises(AudioError, match="cannot be loaded"):
        Whisper(folder)
