"""Films by PyAV, whose types are partial: this file alone knows it."""

# pyright: basic

from __future__ import annotations

import io
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from executive.frontends.film.pictures import Frame


def encoded(
    frames: Iterator[Frame],
    *,
    codec: str,
    container: str,
    rate_hz: int,
    size: tuple[int, int],
    options: dict[str, str],
) -> bytes:
    """A film of some pictures, as browsers play it."""
    import av

    file = io.BytesIO()
    with av.open(file, "w", format=container) as film:
        stream: Any = film.add_stream(codec, rate=Fraction(rate_hz), options=options)
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"
        for frame in frames:
            film.mux(stream.encode(av.VideoFrame.from_image(frame)))
        film.mux(stream.encode())
    return file.getvalue()
