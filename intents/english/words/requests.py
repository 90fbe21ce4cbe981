"""The words by which something is asked for, in a statement and in a question.

In a statement who is spoken to, and what has to be, ask ("you", "the cup should go back"); in a
question that begins with "you" nothing need be asked for ("how do you pick it up?"), but a modal
verb asks ("will you get it?").
"""

from intents.english.words.lexicon import words

ASKS_IN_STATEMENTS = words(
    "please you your me us can could would should must ought need needs let lets let's"
)
"""Without one of these a statement asks for nothing: "I would love some tea"."""
ASKS_IN_QUESTIONS = words("please can could would will shall may might let fancy")
"""Without one of these a question wants to know something, and nothing done."""
