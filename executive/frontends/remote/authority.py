"""Who may come in: a certificate authority of this user's own, and the list of whom it invited.

    ~/.local/state/humanoid/remote/          mode 0700
        authority.json                       its key and certificate, and the gate's (mode 0600)
        invited.json                         whom it invited, as what, and whose word is taken back

A certificate says who somebody is; what they may do stands in the list, which the gate reads anew
for everybody who comes, so that a revoked invitation is worth nothing from then on.
"""

from __future__ import annotations

import hashlib
import ssl
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import msgspec
from msgspec import Meta

from executive.frontends.remote.invitation import SERVER_NAME, Invitation, Role, load_chain
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_secret, write_ordinary
from robot.files.user_state import user_state_folder

if TYPE_CHECKING:
    from cryptography import x509
    from cryptography.hazmat.primitives.asymmetric.ec import EllipticCurvePrivateKey

AUTHORITY, INVITED = "authority.json", "invited.json"
MAX_BYTES = 1_000_000
MOST_INVITED = 1000
OWN_DAYS = 3650
"""So long authority and gate are good: whoever is invited is checked against the list as well."""
BEFORE = timedelta(hours=1)
"""Certificates are good from so long ago on: clocks of two machines differ."""

Now = Callable[[], datetime]
_Kind = TypeVar("_Kind")


def utc_now() -> datetime:
    """The time by this machine's clock."""
    return datetime.now(UTC)


class Guest(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Somebody who was invited.

    Attributes:
        fingerprint: SHA-256 of the certificate, by which they are known.
        until: the end of it, ISO 8601.
    """

    name: str
    role: Role
    fingerprint: Annotated[str, Meta(pattern=r"^[0-9a-f]{64}$")]
    until: str
    revoked: bool = False


class _Kept(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """PEM."""

    key: str
    certificate: str
    gate_key: str
    gate_certificate: str


class Authority:
    """The authority of this user, which is made when it is first wanted."""

    def __init__(self, folder: Path | None = None, *, now: Now = utc_now) -> None:
        """Keep it in a folder; by default in the one of this user.

        Raises:
            ConfigError: there is no home to keep it in.
        """
        if folder is None:
            state = user_state_folder()
            if state is None:
                cure = "set HOME to a folder of your own"
                raise ConfigError([Problem("there is no place for keys: no home", suggestion=cure)])
            folder = state / "remote"
        self._folder = folder
        self._now = now

    def guests(self) -> tuple[Guest, ...]:
        """Who was invited, the latest last.

        Raises:
            ConfigError: the list is damaged, or others may write it.
        """
        return self._read(INVITED, tuple[Guest, ...]) or ()

    def guest(self, certificate: bytes) -> Guest | None:
        """Who comes with a certificate (DER); None: nobody who is welcome.

        Raises:
            ConfigError: as `guests`.
        """
        fingerprint = hashlib.sha256(certificate).hexdigest()
        known = next((one for one in self.guests() if one.fingerprint == fingerprint), None)
        return known if known is not None and self.is_good(known) else None

    def is_good(self, guest: Guest) -> bool:
        """Whether an invitation is worth something still."""
        return not guest.revoked and self._now() < datetime.fromisoformat(guest.until)

    def invite(self, name: str, role: Role, *, host: str, port: int, days: int) -> Invitation:
        """Make an invitation, and note it in the list.

        Raises:
            ConfigError: somebody of that name is invited already, or nothing can be kept.
        """
        guests = self.guests()
        if any(one.name == name and self.is_good(one) for one in guests):
            cure = f"`humanoid remote revoke {name}` takes that back; or take another name"
            raise ConfigError([Problem(f"{name} is invited already", suggestion=cure)])
        if len(guests) >= MOST_INVITED:
            guests = tuple(one for one in guests if self.is_good(one))
        kept = self._kept()
        until = self._now() + timedelta(days=days)
        key, certificate = _signed(kept, name, until=until, now=self._now())
        guest = Guest(
            name=name, role=role, fingerprint=_fingerprint(certificate), until=until.isoformat()
        )
        self._write(INVITED, (*guests, guest))
        return Invitation(
            name=name, role=role, host=host, port=port, until=until.date().isoformat(),
            authority=kept.certificate, certificate=certificate, key=key,
        )  # fmt: skip

    def revoke(self, name: str) -> bool:
        """Take all invitations of a name back; whether there was one that was good."""
        guests = self.guests()
        found = [one for one in guests if one.name == name and self.is_good(one)]
        if found:
            revoked = (
                msgspec.structs.replace(one, revoked=True) if one in found else one
                for one in guests
            )  # fmt: skip
            self._write(INVITED, tuple(revoked))
        return bool(found)

    def gate_context(self) -> ssl.SSLContext:
        """TLS 1.3 for a gate: whoever comes shows a certificate of this authority.

        Raises:
            ConfigError: nobody was ever invited.
        """
        kept = self._read(AUTHORITY, _Kept)
        if kept is None:
            cure = "humanoid remote invite ANNA --role command --at HOST"
            raise ConfigError([Problem("nobody is invited yet", suggestion=cure)])
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.minimum_version = ssl.TLSVersion.TLSv1_3
        context.verify_mode = ssl.CERT_REQUIRED
        context.num_tickets = 0  # nobody comes in again without being looked at
        context.load_verify_locations(cadata=kept.certificate)
        load_chain(context, certificate=kept.gate_certificate, key=kept.gate_key)
        return context

    def _kept(self) -> _Kept:
        kept = self._read(AUTHORITY, _Kept)
        if kept is None:
            kept = _made(self._now())
            self._write(AUTHORITY, kept)
        return kept

    def _read(self, name: str, kind: type[_Kind]) -> _Kind | None:
        path = self._folder / name
        cure = "move it away: everybody has to be invited anew then"
        try:
            return msgspec.json.decode(read_secret(path, limit=MAX_BYTES), type=kind)
        except FileNotFoundError:
            return None
        except OSError as error:
            text = f"cannot be read: {error.strerror}"
        except (msgspec.DecodeError, RecursionError):
            text = "is damaged"
        raise ConfigError([Problem(text, str(path), suggestion=cure)])

    def _write(self, name: str, content: object) -> None:
        path = self._folder / name
        try:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._folder.chmod(0o700)
            if not path.exists():
                path.touch(mode=0o600)  # before there is a secret in it
            write_ordinary(path, msgspec.json.encode(content))
        except OSError as error:
            text = f"cannot be written: {error.strerror}"
            raise ConfigError([Problem(text, str(path))]) from None


def _fingerprint(pem: str) -> str:
    return hashlib.sha256(ssl.PEM_cert_to_DER_cert(pem)).hexdigest()


# --- certificates (RFC 5280) ----------------------------------------------------------------------


def _made(now: datetime) -> _Kept:
    """A new authority, and the gate's certificate by it."""
    from cryptography import x509
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.x509 import oid

    key, gate_key = ec.generate_private_key(ec.SECP256R1()), ec.generate_private_key(ec.SECP256R1())
    subject, until = _called("humanoid authority"), now + timedelta(days=OWN_DAYS)
    own = _builder(key, subject, subject, now=now, until=until)
    own = own.add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
    gate = _builder(gate_key, _called("humanoid gate"), subject, now=now, until=until)
    gate = _for(gate, oid.ExtendedKeyUsageOID.SERVER_AUTH)
    gate = gate.add_extension(
        x509.SubjectAlternativeName([x509.DNSName(SERVER_NAME)]), critical=False
    )
    return _Kept(
        key=_pem_of_key(key),
        certificate=_pem_signed(own, key),
        gate_key=_pem_of_key(gate_key),
        gate_certificate=_pem_signed(gate, key),
    )


def _signed(kept: _Kept, name: str, *, until: datetime, now: datetime) -> tuple[str, str]:
    """A new key, and a certificate for it that says who it is for (PEM)."""
    from cryptography import x509
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.hazmat.primitives.serialization import load_pem_private_key
    from cryptography.x509 import oid

    authority = load_pem_private_key(kept.key.encode(), None)
    issuer = x509.load_pem_x509_certificate(kept.certificate.encode()).subject
    assert isinstance(authority, ec.EllipticCurvePrivateKey)
    key = ec.generate_private_key(ec.SECP256R1())
    builder = _builder(key, _called(name), issuer, now=now, until=until)
    builder = _for(builder, oid.ExtendedKeyUsageOID.CLIENT_AUTH)  # so nobody can pose as a gate
    return _pem_of_key(key), _pem_signed(builder, authority)


def _called(name: str) -> x509.Name:
    from cryptography import x509

    return x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, name)])


def _builder(
    key: EllipticCurvePrivateKey,
    subject: x509.Name,
    issuer: x509.Name,
    *,
    now: datetime,
    until: datetime,
) -> x509.CertificateBuilder:
    from cryptography import x509

    return (
        x509.CertificateBuilder(subject_name=subject, issuer_name=issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - BEFORE)
        .not_valid_after(until)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
    )


def _for(builder: x509.CertificateBuilder, usage: x509.ObjectIdentifier) -> x509.CertificateBuilder:
    from cryptography import x509

    builder = builder.add_extension(
        x509.BasicConstraints(ca=False, path_length=None), critical=True
    )
    return builder.add_extension(x509.ExtendedKeyUsage([usage]), critical=False)


def _pem_signed(builder: x509.CertificateBuilder, issuer: EllipticCurvePrivateKey) -> str:
    from cryptography import x509
    from cryptography.hazmat.primitives.hashes import SHA256
    from cryptography.hazmat.primitives.serialization import Encoding

    identifier = x509.AuthorityKeyIdentifier.from_issuer_public_key(issuer.public_key())
    signed = builder.add_extension(identifier, critical=False).sign(issuer, SHA256())
    return signed.public_bytes(Encoding.PEM).decode()


def _pem_of_key(key: EllipticCurvePrivateKey) -> str:
    from cryptography.hazmat.primitives.serialization import (
        Encoding,
        NoEncryption,
        PrivateFormat,
    )

    return key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption()).decode()
