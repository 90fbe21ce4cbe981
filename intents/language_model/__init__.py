"""A language model behind any OpenAI-compatible endpoint, asked what the grammar cannot read.

    model = LanguageModel(Endpoint(base_url=url, model=name), key=Key(secret))
    dialogue = Dialogue(vocabulary, fallback=model)

Its answer is data: goals of the closed set, checked by type, name and range like anyone's, and
read back to the person before anything moves (:mod:`intents.dialogue`). It can call nothing.
"""

from intents.language_model.asking import LanguageModel
from intents.language_model.endpoint import Endpoint, Key

__all__ = ["Endpoint", "Key", "LanguageModel"]
