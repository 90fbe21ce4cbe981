"""What is asked: "what are you holding?", "how many cups are there?", "look whether ..."."""

from intents.english.clauses import questions as syntax
from intents.english.clauses import self_talk
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon

_LOOKS = lexicon.phrases("look,see,check,go see,go and see,find out,have a look,go check")


def about_robot(sentence: Sentence, at: int) -> Found | None:
    """What are you holding? How are you?"""
    return self_talk.about_robot(sentence.text, at)


def question(sentence: Sentence, at: int) -> Found | None:
    """How many cups are there?"""
    return syntax.question(sentence.text, at, sentence.scope)


def whether(sentence: Sentence, at: int) -> Found | None:
    """Look whether the ball is behind the box; go and see how many there are."""
    start = sentence.text.phrase_end(_LOOKS, at)
    text = sentence.text
    if start is None:
        return None
    counts = text.words[start : start + 2] == ["how", "many"]
    return question(sentence, start) if counts or text.word(start) in ("if", "whether") else None
