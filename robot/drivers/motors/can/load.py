"""How full a bus gets, and how many buses a rate wants."""

from __future__ import annotations

from typing import NamedTuple

from robot.drivers.motors.can.frames import MAX_DATA, worst_bits, worst_fd_bits

MOST_LOAD = 0.70
"""Of a bus: above it, a frame that has to be sent again makes the last replies of a period late."""


class FdPair(NamedTuple):
    """A command and its reply as FD frames.

    Attributes:
        command_bytes, reply_bytes: of data.
        data_bitrate_hz: at which data go.
        is_reply_extended: whether the identifier of the reply has 29 bits.
    """

    command_bytes: int
    reply_bytes: int
    data_bitrate_hz: float
    is_reply_extended: bool = True


def pair_s(*, is_extended: bool, bitrate_hz: float, fd: FdPair | None = None) -> float:
    """How long a command and its reply hold a bus, with the most stuffing that there can be."""
    if fd is None:
        return 2 * worst_bits(MAX_DATA, is_extended=is_extended) / bitrate_hz
    both = (
        worst_fd_bits(fd.command_bytes, is_extended=is_extended),
        worst_fd_bits(fd.reply_bytes, is_extended=fd.is_reply_extended),
    )
    return sum(slow / bitrate_hz + fast / fd.data_bitrate_hz for slow, fast in both)


def load(
    joints: int, rate_hz: float, *, is_extended: bool, bitrate_hz: float, fd: FdPair | None = None
) -> float:
    """The share of its time that a bus is busy with so many joints, each commanded at a rate."""
    return joints * rate_hz * pair_s(is_extended=is_extended, bitrate_hz=bitrate_hz, fd=fd)


def most_joints(
    rate_hz: float, *, is_extended: bool, bitrate_hz: float, fd: FdPair | None = None
) -> int:
    """How many joints one bus serves at a rate."""
    return fitting(rate_hz, pair_s(is_extended=is_extended, bitrate_hz=bitrate_hz, fd=fd))


def fitting(rate_hz: float, each_s: float) -> int:
    """How many joints one bus serves at a rate, whose command and reply take so long each."""
    return int(MOST_LOAD / (rate_hz * each_s) + 1e-9)
