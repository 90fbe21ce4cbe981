# pyright: basic
# onnx-asr and onnxruntime are optional (extra: whisper).
"""Whisper from a folder of ONNX files, run by onnxruntime on the processor; nothing is downloaded.

It writes down whatever is said; what is no command the parser refuses. A folder is what the
exporters leave: `encoder_model.onnx` and `decoder_model_merged.onnx`, or
`whisper-*_beamsearch.onnx`, with `config.json`, `vocab.json` and `added_tokens.json`.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

from intents.speech.audio import RATE_HZ, AudioError, Samples
from intents.speech.recogniser import Heard

LANGUAGE = "en"
QUANTIZATIONS = (None, "int8", "quantized", "uint8", "q4", "fp16")
"""What the files' names may end in, in the order in which they are looked for."""
_EXPORT = "export one: optimum-cli export onnx --model openai/whisper-base FOLDER"


class Whisper:
    """A recogniser that knows no grammar."""

    def __init__(self, folder: Path | None) -> None:
        """Load a model.

        Args:
            folder: of the model.

        Raises:
            AudioError: onnx-asr is not installed, or the folder holds no such model.
        """
        if folder is None or not folder.is_dir():
            raise AudioError(f"{folder} is no folder with a Whisper model", _EXPORT)
        os.environ["ORT_DISABLE_TELEMETRY"] = "1"  # before it is loaded: nothing is sent anywhere
        try:
            import onnxruntime
            from onnx_asr import load_model
        except ImportError as error:
            cure = "pip install 'humanoid-executive[whisper]'"
            raise AudioError(f"{error.name} is not installed", cure) from None
        kind, quantization = _kind(folder)
        options = onnxruntime.SessionOptions()
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
        try:
            self._model: Any = load_model(
                kind, folder, quantization=quantization, sess_options=options,
                providers=["CPUExecutionProvider"],
            )  # fmt: skip
        except Exception as error:  # whatever is wrong with the files, of two libraries
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            raise AudioError(f"{folder} cannot be loaded: {reason}", _EXPORT) from None

    def recognise(self, sound: Samples, *, replying: bool = False) -> Heard:  # noqa: ARG002
        """The words of an utterance."""
        begun_s = time.perf_counter()
        if not len(sound):
            return Heard(text="")
        text = self._model.recognize(sound, sample_rate=RATE_HZ, language=LANGUAGE)
        return Heard(text=str(text).strip(), took_s=time.perf_counter() - begun_s)

    def learn(self) -> None:
        """Nothing: it knows many voices."""


def _kind(folder: Path) -> tuple[str, str | None]:
    """Which export it is, and how it is quantised."""
    patterns = {"whisper": "encoder_model{}.onnx", "whisper-ort": "whisper-*_beamsearch{}.onnx"}
    for quantization in QUANTIZATIONS:
        for kind, pattern in patterns.items():
            suffix = f"[._]{quantization}" if quantization else ""
            if next(folder.rglob(pattern.format(suffix)), None):
                return kind, quantization
    raise AudioError(f"{folder} holds no Whisper model in ONNX", _EXPORT)
