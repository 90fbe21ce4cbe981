"""Shows that somebody knows the token without telling it.

Whoever listens on a port that was a console's must not learn what lets him in at the next one. So
each side sends a number that is used once, and its answer is a code of the other's number, the
token and the address ([RFC 2104], as in SCRAM, [RFC 5802]). The page proves itself first; then it
takes nothing from a server that does not.
"""

from __future__ import annotations

import hmac
import secrets

PAGE, CONSOLE = "page", "console"
"""Who proves it: a code of the one is none of the other."""
LONGEST = 200


def fresh() -> str:
    """A number that is used once."""
    return secrets.token_hex(16)


def proof(token: str, *said: str) -> str:
    """The code of one side.

    Args:
        token: that both know.
        said: who proves it, the address with its port by which the page was asked for, the other
            side's number, and this side's.
    """
    return hmac.digest(token.encode(), "\n".join(said).encode(), "sha256").hex()


def holds(given: str, token: str, *said: str) -> bool:
    """Whether that is the code."""
    if not given.isascii() or max(map(len, (given, *said))) > LONGEST:
        return False
    try:
        return hmac.compare_digest(given, proof(token, *said))
    except UnicodeEncodeError:  # half a pair, as JSON can write it
        return False
