"""Two network namespaces and a wire between them that delays, jitters and loses packets.

Each namespace has an end of its own (a TUN device), and a thread here carries whole IP packets from
one to the other, in their order. It needs no rights: the namespaces are of a user namespace.
Where that or /dev/net/tun is not to be had, `Wire` raises OSError.
"""

from __future__ import annotations

import heapq
import os
import random
import select
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from fcntl import ioctl
from struct import pack

from robot.closing import Closing

ADDRESSES = ("10.77.0.1", "10.77.0.2")
_TUNSETIFF, _IFF_TUN, _IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
"""<linux/if_tun.h>: a device of plain IP packets."""
_DEVICE = "wire0"
_LARGEST = 65536


@dataclass(frozen=True)
class Weather:
    """What a wire does to a packet in either direction.

    Attributes:
        delay_ms: each is on its way for so long, at least.
        jitter_ms: and for up to so much longer, evenly spread; none overtakes another.
        loss: the share of packets that do not arrive, each by chance.
        burst: how many in a row are lost at a time, on average (Gilbert's model, 1960).
    """

    delay_ms: float = 0.0
    jitter_ms: float = 0.0
    loss: float = 0.0
    burst: float = 1.0


class Wire(Closing):
    """A context manager; inside, programs can be started at either end (0 or 1).

    Attributes:
        weather: what it does to packets from now on.
        is_cut: nothing passes.
        lost: how many packets were lost by chance.
        passed: how many arrived.
    """

    def __init__(self, *, seed: int = 0) -> None:
        """Make the namespaces. Raises OSError if this machine gives none."""
        self.weather, self.is_cut = Weather(), False
        self.lost = self.passed = 0
        self._rng = random.Random(seed)
        self._stack = ExitStack()
        try:
            made = [self._made(end) for end in (0, 1)]
        except BaseException:
            self._stack.close()
            raise
        self._holders = [holder for holder, _ in made]
        self._devices = [device for _, device in made]
        self._over = threading.Event()
        self._carrying = threading.Thread(target=self._carry, daemon=True)
        self._carrying.start()

    def close(self) -> None:
        """Take the namespaces down; programs in them should have ended."""
        self._over.set()
        self._carrying.join()
        self._stack.close()

    def start(self, end: int, argv: Sequence[str], **environment: str) -> subprocess.Popen[str]:
        """Start a program at an end, with pipes as its stdin and stdout."""
        inside = ["nsenter", "--target", str(self._holders[end].pid), "--user", "--net",
                  "--preserve-credentials", "--", *argv]  # fmt: skip
        return subprocess.Popen(
            inside, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
            env={**os.environ, **environment},
        )  # fmt: skip

    def _made(self, end: int) -> tuple[subprocess.Popen[bytes], int]:
        """A process that holds a namespace, and the file of the device in it."""
        here, there = socket.socketpair()
        with there:
            holder = subprocess.Popen(
                ["unshare", "--user", "--map-root-user", "--net", sys.executable, "-m",
                 "benchmarks.lossy_wire", str(end), str(there.fileno())],
                pass_fds=[there.fileno()],
            )  # fmt: skip
        self._stack.callback(holder.wait)
        self._stack.callback(here.close)
        _, files, _, _ = socket.recv_fds(here, 1, 1)
        if not files:
            raise OSError("no network namespace is to be had here, or no /dev/net/tun")
        self._stack.callback(os.close, files[0])
        return holder, files[0]

    def _carry(self) -> None:
        """Carry packets, until that is over."""
        waiting: list[tuple[float, int, int, bytes]] = []
        newest_s, is_bad, number = [0.0, 0.0], [False, False], 0
        while not self._over.is_set():
            now_s = time.monotonic()
            wait_s = min(0.05, max(0.0, waiting[0][0] - now_s)) if waiting else 0.05
            ready, _, _ = select.select(self._devices, [], [], wait_s)
            for device in ready:
                end = self._devices.index(device)
                data = os.read(device, _LARGEST)
                is_bad[end] = self._is_lost(was=is_bad[end])
                if is_bad[end] or self.is_cut:
                    self.lost += is_bad[end]
                    continue
                way_ms = self.weather.delay_ms + self._rng.uniform(0.0, self.weather.jitter_ms)
                newest_s[end] = max(newest_s[end], time.monotonic() + 1e-3 * way_ms)
                number += 1
                heapq.heappush(waiting, (newest_s[end], number, 1 - end, data))
            while waiting and waiting[0][0] <= time.monotonic():
                _, _, end, data = heapq.heappop(waiting)
                if not self.is_cut:
                    with suppress(OSError):
                        os.write(self._devices[end], data)
                        self.passed += 1

    def _is_lost(self, *, was: bool) -> bool:
        """Whether the next packet is; `was`: the one before it was."""
        weather = self.weather
        if was:
            return self._rng.random() >= 1.0 / weather.burst
        good = max(1e-9, 1.0 - weather.loss)
        return self._rng.random() < weather.loss / good / weather.burst


def _hold(end: int, channel: socket.socket) -> None:
    """Make the device in this namespace, hand it over, and stay until nobody is left."""
    device = os.open("/dev/net/tun", os.O_RDWR)
    ioctl(device, _TUNSETIFF, pack("16sH22x", _DEVICE.encode(), _IFF_TUN | _IFF_NO_PI))
    for command in (
        f"ip address add {ADDRESSES[end]} peer {ADDRESSES[1 - end]} dev {_DEVICE}",
        f"ip link set {_DEVICE} up",
        "ip link set lo up",
    ):
        subprocess.run(command.split(), check=True)
    socket.send_fds(channel, [b"."], [device])
    channel.recv(1)


if __name__ == "__main__":
    with suppress(subprocess.CalledProcessError, OSError):
        _hold(int(sys.argv[1]), socket.socket(fileno=int(sys.argv[2])))
