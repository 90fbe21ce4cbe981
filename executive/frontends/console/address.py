"""Where the page of a console is, and what it takes to be let in."""

from __future__ import annotations

from typing import Annotated

import msgspec

HOST = "127.0.0.1"
"""Nobody but this machine reaches it, as of nothing that this software listens on."""


class Address(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A port of this machine, and the token that pages of it have to know."""

    port: Annotated[int, msgspec.Meta(ge=1, le=65535)]
    token: Annotated[str, msgspec.Meta(pattern="^[A-Za-z0-9_-]{24}$")]


def url(address: Address) -> str:
    """What is opened in a browser. The token is behind a #: no server and no log is told it."""
    return f"http://{HOST}:{address.port}/#{address.token}"
