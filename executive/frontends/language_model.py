"""The language model of an endpoint's file, as the commands' `--model` names it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from robot.errors import ConfigError, Problem

if TYPE_CHECKING:
    from intents.language_model import LanguageModel


def language_model(file: Path | None) -> LanguageModel | None:
    """The model to ask where the grammar gives up; None without a file. Nothing is sent yet.

    Raises:
        ConfigError: the file cannot be read or is no endpoint.
    """
    if file is None:
        return None
    from intents.language_model import Endpoint, LanguageModel  # httpx takes long to load

    try:
        return LanguageModel(Endpoint.load(file))
    except (OSError, ValueError) as error:  # TOML and msgspec errors are ValueErrors
        raise ConfigError([Problem(str(error), str(file))]) from None
