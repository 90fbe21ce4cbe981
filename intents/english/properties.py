"""Properties that can be asked after: the pose of a person, the colour of a cup."""

from intents.english.lexer import singular
from intents.english.text import Text

PROPERTIES = {
    "name": "name", "pose": "posture", "posture": "posture", "position": "posture",
    "stance": "posture", "gesture": "gesture", "gender": "gender", "sex": "gender", "age": "age",
    "color": "color", "colour": "color", "size": "size", "weight": "weight", "number": "count",
    "amount": "count", "quantity": "count", "location": "location", "category": "category",
    "type": "category", "kind": "category", "shape": "shape", "height": "height",
    "whereabouts": "location",
}  # fmt: skip


def is_property(text: Text, at: int) -> bool:
    """Whether a word names a property."""
    word = text.word(at)
    return singular(word) in PROPERTIES and text.name_at(at) is None
