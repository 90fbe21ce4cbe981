"""Properties that can be asked after: the pose of a person, the colour of a cup."""

from intents.english.words.lexer import singular

PROPERTIES = {
    "name": "name", "pose": "posture", "posture": "posture", "position": "posture",
    "stance": "posture", "gesture": "gesture", "gender": "gender", "sex": "gender", "age": "age",
    "color": "color", "colour": "color", "size": "size", "weight": "weight",
    "location": "location", "category": "category", "type": "category", "kind": "category",
    "shape": "shape", "height": "height", "whereabouts": "location",
}  # fmt: skip


OF_ADJECTIVES = {
    "heavy": "weight", "light": "weight", "big": "size", "large": "size", "small": "size",
    "tall": "height", "high": "height", "long": "size", "wide": "size", "thick": "size",
    "old": "age", "full": "level", "warm": "temperature", "hot": "temperature",
}  # fmt: skip
"""What is asked after by "how heavy is ...?"."""


def property_of(word: str) -> str | None:
    """The property that a word names."""
    return PROPERTIES.get(singular(word))
