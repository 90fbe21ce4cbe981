"""Where a clause ends that only tells something: "my hands are full", "because it is late".

A statement has a subject and a verb that agrees with it; a command has neither. What obliges
("it should be the red one", "you have to ...") is no mere statement, and is left to the readings.
"""

from intents.english.phrases.complements import connector_end
from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE
from intents.english.words.measures import TIME_WORDS
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, participle_base, verbs_at

_SUBJECTS = lexicon.words(
    "i he she it they we this that there these those somebody someone everybody everyone nobody "
    "everything nothing people who mine hers ours"
)
_OWNERS = lexicon.words("my his her its our their your the a an some every each no another")
_CAUSES = lexicon.phrases(
    "as you are,since you are,seeing as you are,seeing you are,seeing that you are,as i am,"
    "because,because of,since,as,cause,cuz,coz,cos,due to,thanks to,given that,seeing as,"
    "seeing that,now that,so that,in case,for fear,considering,although,though,even though,"
    "by the way,fyi,just so you know,for your information"
)
_SUBJECTLESS = lexicon.phrases(
    "can not,could not,does not matter,do not matter,will not be,did not,has not,have not,"
    "trying to,been,is not but,is not no,is not any,is not enough,is not nobody,is not anybody,"
    "is not nothing,is only,is but"
)
"""How a statement begins whose subject goes without saying: "can't talk, ..."."""
_WHENEVER = lexicon.phrases("whenever,each time,every time,any time,everytime,anytime")
"""What follows is no background: it says when, and how often."""
_STATES = lexicon.words(
    "is are am was were 's has had have can could will would do does did may might keeps seems "
    "looks feels smells sounds needs wants likes loves hates says means thinks knows works hurts "
    "rings comes goes gets makes takes belongs lives"
)
"""What a subject is followed by, if no other verb of the third person or of the past."""
_OBLIGES = lexicon.words("should must ought shall needs need")
_PASTS = lexicon.words(
    "said told took went got left put came saw made gave found thought knew bought brought lost "
    "broke fell forgot kept ran sat stood sold sent spoke spent wrote ate drank slept felt held "
    "heard met paid read shut hurt cut let set rang began became began stole spilt spilled threw "
    "hung swung bent built chose caught taught rode rose shook swept died froze stuck tore woke "
    "won wore hid drove flew drew grew blew used meant"
)
_SAME_IN_PAST = lexicon.words("put set let shut cut read hit spread cast hurt quit")
"""Verbs whose past is no other word: "I took the cup, put it down, ..." goes on telling."""
_ADVERBS = lexicon.words(
    "really just always already never also still usually often only almost nearly all both not "
    "even probably certainly surely certainly once ever kind sort of"
)
_SAYING = lexicon.words(
    "said say says told tell tells asked ask asks wrote shouted yelled wants wanted thinks thought "
    "ordered claims called calls"
)
_REACH = 6
"""So many words a subject may have: "the plants on the sill could do with water"."""


def told_end(text: Text, at: int) -> int | None:
    """Where a clause ends that only tells something, if one begins at a word."""
    if text.phrase_end(_WHENEVER, at) or text.words[at : at + 3] == ["in", "case", "of"]:
        return None
    subjectless = text.phrase_end(_SUBJECTLESS, at)
    if subjectless and text.word(subjectless) not in ("you", "we"):
        return _end(text, subjectless, past=False, being=False)
    cause = text.phrase_end(_CAUSES, at)
    if cause is not None and (text.word(cause - 1) not in ("as", "since") or _verb_of(text, cause)):
        return _end(text, cause, past=False, being=True)
    verb = _verb_of(text, at)
    if verb is None or _obliges(text, at, verb):
        return None
    word = text.word(verb)
    past = word in _PASTS or word in ("was", "were", "had", "did") or word.endswith("ed")
    return _end(text, verb, past=past, being=word in ("is", "are", "am", "'s"))


def _obliges(text: Text, at: int, verb: int) -> bool:
    """It *should* be the red one; but: I *shall* be in the hall."""
    says = text.words[verb : verb + 3]
    thing = text.word(verb) in ("need", "needs") and text.word(verb + 1) in ("it", "them")
    if thing and (verb + 2 >= len(text) or text.word(verb + 2) in (COMMA, FULL_STOP)):
        return False  # Leo still needs it
    mine = text.word(at) in ("i", "we") and says[:2] in (["shall", "be"], ["should", "be"])
    return not mine and bool(_OBLIGES.intersection(says))


def _verb_of(text: Text, at: int) -> int | None:
    """The verb of the statement that begins at a word."""
    word = text.word(at)
    if word in _SUBJECTS:
        n = _past_adverbs(text, at + 1)
        plain = word in ("i", "we", "they", "who", "these", "those") and is_english(text.word(n))
        if plain and not _states(text, n):
            return None if text.name_at(n) or n >= len(text) else n
        if _states(text, n):
            return n
        if word not in ("this", "that", "these", "those", "no"):
            return None
    if not (word in _OWNERS or word in _SUBJECTS or text.name_at(at) or _is_subject(text, at)):
        return None
    named = word in _OWNERS or word in _SUBJECTS or text.name_at(at) is not None
    who = text.name_at(at)
    if who is not None and who.of("person") and _is_bare_verb(text, who.end):
        return who.end
    for n in range(at + 1, min(at + (_REACH if named else 3), len(text))):
        if text.word(n) in (COMMA, FULL_STOP, QUOTE):
            return None
        if text.word(n) in _OWNERS and text.word(n - 1) not in lexicon.FUNCTION_WORDS:
            return None  # water the plants
        m = _past_adverbs(text, n)
        if _states(text, m) and not _owns(text, m):
            return m
    return None


def _is_bare_verb(text: Text, at: int) -> bool:
    """Leo *cry*, ...: as learners say it, where nothing else comes after it."""
    word = text.word(at)
    plain = word.isalpha() and word not in lexicon.FUNCTION_WORDS and not verbs_at(text.words, at)
    ends = text.word(at + 1) in (COMMA, FULL_STOP) and text.name_at(at) is None
    return plain and ends and is_english(f"{word}ing") and at + 1 < len(text)


def _is_subject(text: Text, at: int) -> bool:
    """Whether a word that is no verb of the grammar may be one: "guests are coming"."""
    word = text.word(at)
    if not word.isalpha() or verbs_at(text.words, at) or word in lexicon.FUNCTION_WORDS:
        return False
    if word in _ADVERBS:
        return False  # how many cups *still got* on the table
    return not word.endswith(("ed", "ing")) and (word,) not in lexicon.CONNECTORS


def _owns(text: Text, at: int) -> bool:
    """Leo's ball, a minute's wait; but: Leo's hungry."""
    return text.word(at) == "'s" and (
        text.name_at(at + 1) is not None or not text.word(at + 1).isalpha()
        or _states(text, at + 2) or text.word(at + 1) in lexicon.COLORS
        or text.word(at - 1) in TIME_WORDS
    )  # fmt: skip


def _states(text: Text, at: int) -> bool:
    """Whether a verb of a statement stands at a word: "is", "broke", "drives"."""
    word = text.word(at)
    if word in _STATES or word in _PASTS:
        return True
    if at >= len(text) or text.name_at(at) or not word.isalpha():
        return False
    if word.endswith("ed") and len(word) > 4:
        return participle_base(word) is not None or is_english(word)
    third = word.endswith("s") and not word.endswith(("ss", "us", "is")) and len(word) > 4
    return third and base_form(word) != word


def _past_adverbs(text: Text, at: int) -> int:
    while text.word(at) in _ADVERBS:
        at += 1
    return at


def _end(text: Text, at: int, *, past: bool, being: bool) -> int:
    """Where a statement ends whose verb stands at ``at``.

    What somebody says goes on after a comma, and so does what somebody did.
    """
    begin = at
    while at < len(text):
        word = text.word(at)
        if word == FULL_STOP:
            return at
        if word == COMMA:
            quoted = text.word(at - 1) in _SAYING or text.word(at - 2) in _SAYING
            goes_on = past and text.word(at + 1) in _SAME_IN_PAST
            if not quoted and not goes_on:
                return at
        elif at > begin and _begins_command(text, at, past=past, being=being):
            return at
        at += 1
    return at


def _begins_command(text: Text, at: int, *, past: bool, being: bool) -> bool:
    """... *so bring me one*; ... *and could you help me?*; ... *bring me one*."""
    word = text.word(at)
    after = connector_end(text, at)
    if word in ("so", "therefore", "hence") and after is None:
        after = at + 1
    if after is not None:
        polite = (
            bool(text.phrase_end(lexicon.OPENERS, after)) and "you" in text.words[after : after + 3]
        )
        bare = bool(verbs_at(text.words, after)) and base_form(text.word(after)) == text.word(after)
        due = word == "so" and text.word(after) not in _SAME_IN_PAST
        return polite or (bare and (word in ("so", "then") or being) and (due or not past))
    handed = verbs_at(text.words, at) and base_form(word) == word
    apart = text.word(at + 1) in ("it", "them") and text.word(at - 1) not in lexicon.FUNCTION_WORDS
    apart = apart or (
        text.word(at + 1) in _OWNERS | {"some"}
        and text.word(at - 1) not in lexicon.FUNCTION_WORDS
        and text.name_at(at) is None
    )  # I am thirsty bring some juice
    handed_over = text.word(at + 1) in ("me", "us") or apart  # that is my cup give it back
    return bool(handed) and not past and handed_over and being
