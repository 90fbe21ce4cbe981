"""What a description says of the process that owns the motors' buses."""

from __future__ import annotations

import msgspec


class BusOwner(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """That there is one: `bus_owner: {}`; or that there is none: `bus_owner: {enabled: false}`.

    A description that does not say has one where its motors are on CAN or behind Ethernet.
    `stop_input` is the file that tells of an emergency stop's contact (`robot.drivers.stop_input`);
    "" if there is none.
    """

    enabled: bool = True
    stop_input: str = ""
