"""A voice that keeps what it says."""

from __future__ import annotations


class Loudspeaker:
    """Never silent of itself: `told` holds what it says, and when it was hushed and closed."""

    def __init__(self) -> None:
        self.told: list[str] = []
        self.waited_s: list[float] = []
        self.speaking = False

    def say(self, text: str) -> None:
        self.told.append(text)

    def hush(self) -> None:
        self.told.append("(hush)")

    def wait(self, timeout_s: float) -> bool:
        self.waited_s.append(timeout_s)
        return True

    def close(self) -> None:
        self.told.append("(closed)")
