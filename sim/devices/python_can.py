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

from sim.devices.socket_frames import FD_SIZE, SIZE

QUEUE_BYTES = 4608
"""The least that Linux takes: about six frames, then the queue is full."""
_LAYOUT, _FD_LAYOUT = struct.Struct("=IB3x8s"), struct.Struct("=IBBxx64s")
_BRS, _FDF = 0x01, 0x04
_EXTENDED, _REMOTE, _ERROR = 0x8000_0000, 0x4000_0000, 0x2000_0000


class EmulatedBus(can.BusABC):
    """A program's controller on an emulated bus.

    Attributes:
        socket: which carries its frames, 16 bytes each, as one of socketcan does; 72 of FD.
    """

    def __init__(
        self, channel: Any, can_filters: Any = None, fd: bool = False, **kwargs: Any
    ) -> None:
        """Connect to the socket at the path `channel`; bit rates are the emulator's business.

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
        self._can_protocol = can.CanProtocol.CAN_FD if fd else can.CanProtocol.CAN_20

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Queue a frame; CanOperationError: no room in time (ENOBUFS), or FD on a classic bus."""
        flags = (_EXTENDED if msg.is_extended_id else 0) | (_REMOTE if msg.is_remote_frame else 0)
        number, payload = msg.arbitration_id | flags, bytes(msg.data or b"")
        if msg.is_fd:
            if self.protocol != can.CanProtocol.CAN_FD:
                raise can.CanOperationError("not opened for CAN FD", errno.EINVAL)
            rate = _BRS if msg.bitrate_switch else 0
            data = _FD_LAYOUT.pack(number, len(payload), _FDF | rate, payload)
        else:
            data = _LAYOUT.pack(number, msg.dlc, payload)
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
            data = self.socket.recv(FD_SIZE)
        except BlockingIOError:
            return None, False
        except OSError as error:
            raise can.CanOperationError(f"Failed to receive: {error}", error.errno) from None
        flags = 0
        if len(data) == FD_SIZE:
            number, length, flags, payload = _FD_LAYOUT.unpack(data)
        elif len(data) == SIZE:
            number, length, payload = _LAYOUT.unpack(data)
        else:
            raise can.CanOperationError("the emulator went away", errno.ENETDOWN)
        message = can.Message(
            arbitration_id=number & 0x1FFF_FFFF,
            is_extended_id=bool(number & _EXTENDED),
            is_remote_frame=bool(number & _REMOTE),
            is_error_frame=bool(number & _ERROR),
            is_fd=bool(flags & _FDF),
            bitrate_switch=bool(flags & _BRS),
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
