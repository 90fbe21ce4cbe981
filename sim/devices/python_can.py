"""Emulated buses for python-can: `can.Bus(interface="humanoid", channel=PATH_OF_A_SOCKET)`.

Any client on python-can drives the emulated devices by this; it behaves as socketcan does: `send`
never waits longer than it is told, and a full queue is ENOBUFS.
"""

from __future__ import annotations

import errno
import select
import socket
import struct
from typing import Any

import can

from sim.devices.socket_frames import SIZE

QUEUE_BYTES = 4608
"""The least that Linux takes: about six frames, then the queue is full."""
_LAYOUT = struct.Struct("=IB3x8s")
_EXTENDED, _REMOTE, _ERROR = 0x8000_0000, 0x4000_0000, 0x2000_0000


class EmulatedBus(can.BusABC):
    """A program's controller on an emulated bus.

    Attributes:
        socket: which carries its frames, 16 bytes each, as one of socketcan does.
    """

    def __init__(self, channel: Any, can_filters: Any = None, **kwargs: Any) -> None:
        """Connect to the socket at the path `channel`; a bit rate is the emulator's business.

        Raises:
            can.CanInitializationError: if nobody emulates there.
        """
        self.channel_info = f"emulated {channel}"
        self.channel = channel
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, QUEUE_BYTES)
        self.socket.settimeout(0)
        try:
            self.socket.connect(str(channel))
        except OSError as error:
            self.socket.close()
            text = f"nobody emulates a bus at {channel}: {error.strerror}"
            raise can.CanInitializationError(text, error.errno) from None
        super().__init__(channel=channel, can_filters=can_filters, **kwargs)

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Queue a frame; CanOperationError (ENOBUFS) if there is no room in time."""
        flags = (_EXTENDED if msg.is_extended_id else 0) | (_REMOTE if msg.is_remote_frame else 0)
        data = _LAYOUT.pack(msg.arbitration_id | flags, msg.dlc, bytes(msg.data or b""))
        try:
            if timeout:
                select.select([], [self.socket], [], timeout)
            self.socket.send(data)
        except BlockingIOError:
            raise can.CanOperationError("Transmit buffer full", errno.ENOBUFS) from None
        except OSError as error:
            raise can.CanOperationError(f"Failed to transmit: {error}", error.errno) from None

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        if timeout != 0:
            readable, _, _ = select.select([self.socket], [], [], timeout)
            if not readable:
                return None, False
        try:
            data = self.socket.recv(SIZE)
        except BlockingIOError:
            return None, False
        except OSError as error:
            raise can.CanOperationError(f"Failed to receive: {error}", error.errno) from None
        if len(data) != SIZE:
            raise can.CanOperationError("the emulator went away", errno.ENETDOWN)
        number, length, payload = _LAYOUT.unpack(data)
        message = can.Message(
            arbitration_id=number & 0x1FFF_FFFF,
            is_extended_id=bool(number & _EXTENDED),
            is_remote_frame=bool(number & _REMOTE),
            is_error_frame=bool(number & _ERROR),
            data=payload[:length],
            channel=self.channel,
        )
        return message, False

    def fileno(self) -> int:
        """Of the socket, to wait for it."""
        return self.socket.fileno()

    def shutdown(self) -> None:
        """Let go of the bus."""
        super().shutdown()
        self.socket.close()
