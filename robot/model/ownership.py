"""What a description says of the process that owns the motors' buses."""

from __future__ import annotations

import msgspec


class BusOwner(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """That there is one: `bus_owner: {}`.

    `stop_input` is the file that tells of an emergency stop's contact (`robot.drivers.stop_input`);
    "" if there is none.
    """

    stop_input: str = ""
