"""A half-duplex line of servos: bytes take their time, answers follow one another, talk collides.

The order of answers is that of the e-manual: to a ping of everybody by identifier, to a sync or
bulk read in the order asked, each after the one before. What happens behind a servo that is missing
there is not said; the worst is assumed: those behind it stay silent.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from sim.devices.dynamixel import Servo
from sim.devices.dynamixel_codec import Ear, Instruction, crc, fast_head, fast_part, status

BITS_A_BYTE = 10
"""Start, 8 of data, stop."""
THINKS_S = 20e-6
"""Assumed: from the end of an instruction to an answer, beside the return delay."""
NEVER = float("inf")
UNKNOWN_INSTRUCTION, DATA_LENGTH = 2, 5
SAME_S = 1e-9


class Line:
    """One port's servos.

    Attributes:
        baud_hz: its bit rate.
        servos: who is on it.
        now_s: up to when it was played.
        busy_s: for how long bytes were on it so far.
        collisions: answers that somebody talked into.
    """

    def __init__(self, *, baud_hz: int, now_s: float = 0.0) -> None:
        """A quiet one, nobody on it."""
        self.baud_hz, self.now_s = baud_hz, now_s
        self.servos: list[Servo] = []
        self.busy_s, self.collisions = 0.0, 0
        self._byte_s = BITS_A_BYTE / baud_hz
        self._ear = Ear()
        self._by_number: dict[int, list[Servo]] = {}
        self._coming: deque[tuple[float, bytes]] = deque()
        self._answers: deque[tuple[float, bytearray]] = deque()
        self._host_free_s = self._free_s = now_s

    @property
    def crc_errors(self) -> int:
        """Instructions that nobody understood."""
        return self._ear.crc_errors

    def write(self, data: bytes, now_s: float) -> None:
        """The host sends bytes: behind those that it has sent already, else from now on."""
        begin_s = max(now_s, self._host_free_s)
        self._host_free_s = begin_s + len(data) * self._byte_s
        self.busy_s += len(data) * self._byte_s
        self._coming.append((begin_s, data))

    @property
    def next_s(self) -> float:
        """When something next happens on it."""
        coming = self._coming[0] if self._coming else None
        sent_s = NEVER if coming is None else coming[0] + len(coming[1]) * self._byte_s
        heard_s = NEVER
        if self._answers:
            begin_s, data = self._answers[0]
            heard_s = begin_s + len(data) * self._byte_s
        return min(sent_s, heard_s)

    def advance(self, until_s: float) -> bytes:
        """Let time go by up to a moment; what the host has heard by then."""
        while self._coming:
            begin_s, data = self._coming[0]
            if begin_s + len(data) * self._byte_s > until_s + SAME_S:
                break
            self._coming.popleft()
            data = self._talked_into(begin_s, data)
            for one in self._ear.hear(data):
                self._obey(one, begin_s + one.end * self._byte_s)
        self.now_s = max(self.now_s, until_s)
        return self._heard(until_s)

    def _talked_into(self, begin_s: float, data: bytes) -> bytes:
        """Who sends while another one answers spoils both."""
        for answer_s, answer in self._answers:
            ends_s = answer_s + len(answer) * self._byte_s
            if answer_s < begin_s + len(data) * self._byte_s and begin_s < ends_s - SAME_S:
                self.collisions += 1
                first = max(0, int((begin_s - answer_s) / self._byte_s))
                answer[first:] = bytes(byte & 0x5A for byte in answer[first:])
                data = bytes(byte & 0x5A for byte in data)
        return data

    def _heard(self, until_s: float) -> bytes:
        heard = bytearray()
        while self._answers:
            begin_s, data = self._answers[0]
            count = min(len(data), int((until_s - begin_s) / self._byte_s + 1e-6))
            if count <= 0:
                break
            heard += data[:count]
            if count < len(data):
                self._answers[0] = (begin_s + count * self._byte_s, data[count:])
                break
            self._answers.popleft()
        return bytes(heard)

    # --- what servos make of it ----------------------------------------------------------------

    def _obey(self, one: Instruction, at_s: float) -> None:
        self._by_number.clear()
        for servo in self._all():
            self._by_number.setdefault(servo.memory.get(7, 1), []).append(servo)
        self._free_s = max(self._free_s, at_s)
        for servo in self.servos:
            if not servo.trouble.silent:
                servo.hear(at_s)
        match one.code:
            case 0x82 | 0x92:
                self._chain(_asked(one), at_s)
            case 0x8A:
                self._fast(_asked(one), at_s)
            case 0x83 | 0x93:
                for number, address, data in _told(one):
                    for servo in self._named(number):
                        servo.write(address, data)
            case _:
                self._single(one, at_s)

    def _named(self, number: int) -> list[Servo]:
        return self._by_number.get(number, [])

    def _single(self, one: Instruction, at_s: float) -> None:
        if one.to == 0xFE:
            for servo in sorted(self._all(), key=lambda servo: servo.memory.get(7, 1)):
                answer = self._answer(servo, one)
                if one.code == 0x01 and answer is not None:
                    self._say([(servo, answer)], max(at_s, self._free_s))
            return
        said = [(servo, self._answer(servo, one)) for servo in self._named(one.to)]
        self._say([(servo, answer) for servo, answer in said if answer is not None], at_s)

    def _all(self) -> list[Servo]:
        return [servo for servo in self.servos if not servo.trouble.silent]

    def _answer(self, servo: Servo, one: Instruction) -> bytes | None:
        """Do it; what the servo answers, None where it is set to answer nothing."""
        level, number = servo.memory.get(68, 1), servo.memory.get(7, 1)
        error, data, wants = 0, b"", 2
        match one.code:
            case 0x01:
                (_, model), (_, firmware) = servo.read(0, 2), servo.read(6, 1)
                data, wants = model + firmware, 0
            case 0x02 if len(one.parameters) == 4:
                p = one.parameters
                error, data = servo.read(p[0] | p[1] << 8, p[2] | p[3] << 8)
                wants = 1
            case 0x03 if len(one.parameters) >= 3:
                p = one.parameters
                error = servo.write(p[0] | p[1] << 8, p[2:])
            case 0x08:
                servo.reboot()
            case 0x02 | 0x03:
                error = DATA_LENGTH
            case _:
                error = UNKNOWN_INSTRUCTION
        return status(number, error | servo.alert, data) if level >= wants else None

    def _chain(self, asked: Sequence[tuple[int, int, int]], at_s: float) -> None:
        begin_s = at_s
        for number, address, size in asked:
            servos = self._named(number)
            if not servos:
                return
            said: list[tuple[Servo, bytes]] = []
            for servo in servos:
                error, data = servo.read(address, size)
                said.append((servo, status(number, error | servo.alert, data)))
            self._say(said, begin_s)
            begin_s = self._free_s

    def _fast(self, asked: Sequence[tuple[int, int, int]], at_s: float) -> None:
        """All of them in one packet: each goes on where the one before ended."""
        if not asked:
            return
        begin_s, before = at_s, 0
        for place, (number, address, size) in enumerate(asked):
            servos = self._named(number)
            if not servos:
                return
            said: list[tuple[Servo, bytes]] = []
            head = fast_head(len(asked), size) if place == 0 else b""
            before = crc(head, before)
            for servo in servos:
                error, data = servo.read(address, size)
                part = fast_part(before, number, error | servo.alert, data.ljust(size, b"\0"))
                said.append((servo, head + part))
            cuts = any(servo.trouble.halves for servo in servos)
            self._say(said, begin_s, thinks=place == 0)
            before, begin_s = crc(said[0][1][len(head) :], before), self._free_s
            if cuts:
                return

    def _say(
        self, said: Sequence[tuple[Servo, bytes]], after_s: float, *, thinks: bool = True
    ) -> None:
        """Put answers on the line; two at once are one that nobody understands."""
        if not said:
            return
        delay_s = max(
            servo.answers_after_s if thinks else servo.trouble.later_s for servo, _ in said
        )
        begin_s = max(after_s, self._free_s) + delay_s + (THINKS_S if thinks else 0.0)
        bytes_said = bytearray(said[0][1])
        for _, other in said[1:]:
            bytes_said = bytearray(a & b for a, b in zip(bytes_said, other, strict=False))
            self.collisions += 1
        for servo, _ in said:
            bytes_said = _spoilt(servo, bytes_said)
        self._answers.append((begin_s, bytes_said))
        self.busy_s += len(bytes_said) * self._byte_s
        self._free_s = begin_s + len(bytes_said) * self._byte_s

    def live(self, until_s: float) -> None:
        """Let the servos' loops run up to a moment."""
        for servo in self.servos:
            servo.live(until_s)


def _spoilt(servo: Servo, said: bytearray) -> bytearray:
    trouble = servo.trouble
    if trouble.spoils:
        trouble.spoils -= 1
        said[-3] ^= 0x20
    if trouble.halves:
        trouble.halves -= 1
        said = said[: len(said) // 2]
    return said


def _asked(one: Instruction) -> list[tuple[int, int, int]]:
    """Whom a read of several asks, and for what: identifier, address, size."""
    p = one.parameters
    if one.code == 0x92:
        rows = range(0, len(p) - 4, 5)
        return [(p[i], p[i + 1] | p[i + 2] << 8, p[i + 3] | p[i + 4] << 8) for i in rows]
    if len(p) < 5:
        return []
    return [(number, p[0] | p[1] << 8, p[2] | p[3] << 8) for number in p[4:]]


def _told(one: Instruction) -> list[tuple[int, int, bytes]]:
    """Whom a write of several tells what: identifier, address, bytes."""
    p = one.parameters
    if one.code == 0x83:
        if len(p) < 4:
            return []
        address, size = p[0] | p[1] << 8, p[2] | p[3] << 8
        rows = range(4, len(p) - size, size + 1) if size else range(0)
        return [(p[i], address, p[i + 1 : i + 1 + size]) for i in rows]
    told: list[tuple[int, int, bytes]] = []
    at = 0
    while at + 5 <= len(p):
        size = p[at + 3] | p[at + 4] << 8
        told.append((p[at], p[at + 1] | p[at + 2] << 8, p[at + 5 : at + 5 + size]))
        at += 5 + size
    return told
