"""The language model of an endpoint's file, as the commands' `--model` names it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robot.errors import ConfigError, Problem
from robot.files import plain_data
from robot.files.yaml_nodes import read_text

if TYPE_CHECKING:
    from intents.language_model import LanguageModel

MAX_BYTES = 64_000
_NAMES_A_KEY = re.compile(r"^[ \t]*+[\"']?key_(file|variable)[\"']?[ \t]*+=", re.MULTILINE)


def language_model(
    file: Path | None, *, shown: Callable[[dict[str, Any]], None] | None = None
) -> LanguageModel | None:
    """The model to ask what the grammar cannot read; None without a file. Nothing is sent yet.

    Args:
        file: of the endpoint.
        shown: is given the body of each request.

    Raises:
        ConfigError: the file cannot be read or is no endpoint, or the key for it is not usable.
    """
    if file is None:
        return None
    from executive.frontends import keys
    from intents.language_model import Endpoint, LanguageModel  # httpx takes long to load

    text = read_text(file, limit=MAX_BYTES)
    if _NAMES_A_KEY.search(text):
        cure = f"name it in {keys.path()}, under the host it is for (docs/intents.md)"
        problem = "an endpoint's file names no key: it could send any file to any host"
        raise ConfigError([Problem(problem, str(file), suggestion=cure)])
    try:
        data = plain_data.from_toml(text)
    except ValueError as error:
        raise ConfigError([Problem(str(error), str(file))]) from None
    endpoint = plain_data.fitted(data, Endpoint, file)
    return LanguageModel(endpoint, key=keys.key_for(endpoint.host), shown=shown)
