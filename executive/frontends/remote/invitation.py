"""An invitation: the file by which somebody on another machine reaches the robots of this one.

It holds a private key, so that it is a secret of whoever it was made for: mode 0600 at both ends.
"""

from __future__ import annotations

import os
import re
import ssl
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from robot.errors import ConfigError, Problem
from robot.ordinary_files import read_secret

Role = Literal["watch", "command", "stop"]
ROLES: dict[Role, str] = {
    "watch": "sees what the robot does and says, and may stop it",
    "command": "may do what is done at the prompt, but undo an emergency stop, or end the robot",
    "stop": "sees how it is, and may stop it",
}
SERVER_NAME = "robots.humanoid.invalid"
"""What the certificate of a gate is for, wherever it stands; `.invalid` is nobody's (RFC 2606)."""
MAX_BYTES = 32_000
Host = Annotated[str, Meta(max_length=253)]
Port = Annotated[int, Meta(ge=1, le=65535)]
Pem = Annotated[str, Meta(max_length=8_000, pattern=r"^[\n\r -~]*$")]
_HOST = re.compile(r"[\w.-]{1,253}|[0-9a-fA-F:.]{2,45}")


class Invitation(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is in the file.

    Attributes:
        name: whom it is for; also the robot's name at their end, where they give none.
        host, port: where the gate is.
        until: the last day on which it is good, for people (the certificate itself says so too).
        authority: the certificate that the gate's has to be signed by (PEM).
        certificate, key: theirs (PEM).
    """

    name: Annotated[str, Meta(max_length=32)]
    role: Role
    host: Host
    port: Port
    until: Annotated[str, Meta(max_length=40)]
    authority: Pem
    certificate: Pem
    key: Pem


def is_host(text: str) -> bool:
    """Whether a text may be the name or the address of a machine: what can be looked up at all."""
    try:
        text.encode("idna")  # no label is empty, or longer than 63 letters (RFC 1035)
    except UnicodeError:
        return False
    return _HOST.fullmatch(text) is not None


def read(path: Path) -> Invitation:
    """The invitation in a file.

    Raises:
        ConfigError: it is none, or others may read it.
    """
    try:
        found = msgspec.json.decode(read_secret(path, limit=MAX_BYTES), type=Invitation)
        if is_host(found.host):
            return found
        text, cure = "names no host", "have a new one made by `humanoid remote invite`"
    except OSError as error:
        text, cure = f"cannot be read: {error.strerror}", "name a file of `humanoid remote invite`"
    except (msgspec.DecodeError, RecursionError):
        text, cure = "is no invitation", "name a file of `humanoid remote invite`"
    raise ConfigError([Problem(text, str(path), suggestion=cure)])


def client_context(invitation: Invitation) -> ssl.SSLContext:
    """TLS 1.3 towards the gate of an invitation and no other.

    Raises:
        ConfigError: its certificates are none.
    """
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)  # which checks name and signature
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    try:
        context.load_verify_locations(cadata=invitation.authority)
        load_chain(context, certificate=invitation.certificate, key=invitation.key)
    except (ssl.SSLError, ValueError) as error:
        cure = "have a new one made by `humanoid remote invite`"
        raise ConfigError(
            [Problem("the invitation's certificates are none", suggestion=cure)]
        ) from error
    return context


def load_chain(context: ssl.SSLContext, *, certificate: str, key: str) -> None:
    """Give a context its own certificate and key (PEM), which `ssl` reads from files alone.

    They stand in memory for it, and on no disk.

    Raises:
        ssl.SSLError, ValueError: they are none.
    """
    file = os.memfd_create("certificate", os.MFD_CLOEXEC)
    try:
        os.write(file, f"{certificate}\n{key}\n".encode())
        context.load_cert_chain(f"/proc/self/fd/{file}", password=lambda: "")
    finally:
        os.close(file)
