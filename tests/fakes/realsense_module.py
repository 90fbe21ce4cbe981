"""An emulated `pyrealsense2`: as much of the library as one colour and one depth stream ask for."""

from collections import deque
from types import ModuleType, SimpleNamespace

import numpy as np

SERIAL = "f0123456"
DEPTH_SCALE = 0.001


class Device:
    """One emulated camera: plugged in or not, with pictures on their way."""

    def __init__(self) -> None:
        self.plugged = True
        self.breaks = False
        self.streaming = False
        self.asked: list[tuple] = []
        self.frames: deque[tuple[np.ndarray, np.ndarray]] = deque()

    def show(self, colours: np.ndarray, depth_mm: np.ndarray) -> None:
        self.frames.append((colours, depth_mm))

    def get_info(self, _kind: object) -> str:
        return SERIAL

    def first_depth_sensor(self) -> SimpleNamespace:
        return SimpleNamespace(get_depth_scale=lambda: DEPTH_SCALE)


class _Picture:
    def __init__(self, data: np.ndarray) -> None:
        self.get_data = lambda: data
        self.get_timestamp = lambda: 5_000.0 + float(data.flat[0])  # milliseconds

    def supports_frame_metadata(self, _kind: object) -> bool:
        return True

    def get_frame_metadata(self, _kind: object) -> int:
        return 8_000  # microseconds


class _Frames:
    def __init__(self, pair: tuple[np.ndarray, np.ndarray] | None) -> None:
        self._pair = pair

    def size(self) -> int:
        return 2 if self._pair else 0

    def get_color_frame(self) -> _Picture:
        return _Picture(self._pair[0])

    def get_depth_frame(self) -> _Picture:
        return _Picture(self._pair[1])


def module(device: Device) -> ModuleType:
    """The library with that camera on the bus."""

    class Config:
        def enable_device(self, serial: str) -> None:
            device.asked.append(("serial", serial))

        def enable_stream(self, *words: object) -> None:
            device.asked.append(words)

    class Pipeline:
        def start(self, _config: Config) -> SimpleNamespace:
            if not device.plugged:
                raise RuntimeError("No device connected")
            device.streaming = True
            lens = SimpleNamespace(fx=381.0, fy=382.0, ppx=319.0, ppy=241.0)
            video = SimpleNamespace(get_intrinsics=lambda: lens)
            stream = SimpleNamespace(as_video_stream_profile=lambda: video)
            return SimpleNamespace(get_device=lambda: device, get_stream=lambda _kind: stream)

        def poll_for_frames(self) -> _Frames:
            if device.breaks:
                raise RuntimeError("MIPI error")
            return _Frames(device.frames.popleft() if device.frames else None)

        def stop(self) -> None:
            if not device.streaming:
                raise RuntimeError("stop() cannot be called before start()")
            device.streaming = False

    found = ModuleType("pyrealsense2")
    found.__dict__.update(
        config=Config,
        pipeline=Pipeline,
        align=lambda _stream: SimpleNamespace(process=lambda frames: frames),
        context=lambda: SimpleNamespace(query_devices=lambda: [device] if device.plugged else []),
        stream=SimpleNamespace(depth="depth", color="color"),
        format=SimpleNamespace(z16="z16", rgb8="rgb8"),
        camera_info=SimpleNamespace(serial_number="serial"),
        frame_metadata_value=SimpleNamespace(actual_exposure="exposure"),
    )
    return found
