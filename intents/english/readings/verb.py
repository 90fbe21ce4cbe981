"""A verb with its complements: "put the cup on the shelf"."""

from intents.english.clauses.verb_clauses import read_verb
from intents.english.phrases.complements import connector_end
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.trouble import Unclear
from intents.english.words import lexicon
from intents.english.words.verbs import verbs_at

_TIDIES = lexicon.phrases("tidy by,tidy up by,clean up by,clear up by")


def verb(sentence: Sentence, at: int) -> Found:
    """A verb with its complements; "meet and greet Ada" shares one."""
    text = sentence.text
    try:
        return read_verb(sentence, at)
    except Unclear:
        after = connector_end(text, verbs_at(text.words, at)[0][1])
        if after is None or not verbs_at(text.words, after):
            raise
        for goal in clause_by_itself(sentence, after)[0]:
            sentence.scope.mention_goal(goal)
        return read_verb(sentence, at)


def tidied_by(sentence: Sentence, at: int) -> Found | None:
    """Tidy up by *putting everything on the shelf*."""
    start = sentence.text.phrase_end(_TIDIES, at)
    return read_verb(sentence, start) if start else None
