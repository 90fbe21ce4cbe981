"""Parentheses: what is set off from the rest of a sentence and cannot change what is asked.

A segment between signs ("the poor lamb", "God love her", "goodness me", "be honest") is passed over
if it is an exclamation, a blessing, a word for somebody, a comment or a statement by its form, and
if it holds nothing that could be meant for the robot: no order, no name of the world, no negation,
condition, time, order of steps, count, exception, manner or place. A form that could as well be an
order to do what the robot has no word for ("juggle", "fold the laundry") or the name of a thing
that it does not know ("the saucer") is none of these.

What is said to somebody else by name in the midst of it ("Leo, shoes on!") is theirs.
"""

import re

from intents.english.clauses.told import told_end
from intents.english.faithfulness import CARRYING
from intents.english.words import lexicon
from intents.english.words.courtesy import ADDRESSES
from intents.english.words.dictionary import is_english
from intents.english.words.lexer import COMMA, DASHES, FULL_STOP, QUOTE
from intents.english.words.limits import (
    CHOICES,
    CONDITIONS,
    DENIALS,
    MEASURES,
    QUANTITIES,
    TIMES,
)  # fmt: skip
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at

Span = tuple[int, int]
"""From the first word of a segment to the one after its last."""

_LONGEST = 12
"""A longer segment says too much to be passed over."""
_EPITHET = 5
"""So many words a person is called in passing, the article included."""
_SIGNS = (COMMA, FULL_STOP)
INTERJECTIONS = lexicon.words(
    "oh ah aha ooh och ach ugh eek argh ouch ow oops whoops phew wow blimey crikey gosh golly gee "
    "jeez jeepers heavens goodness gracious mercy lord lordy christ jesus damn dang darn drat "
    "blast bother bugger fiddlesticks hurrah hooray yay yippee yikes bah pah tut tsk eh huh ahem "
    "lol haha hehe omg ffs smh ngl tbh fyi btw cor strewth begorrah alas well aye ha hah hm mm "
    "sheesh shucks yuck yuk yucky eww ew ick icky wahey whee bravo hush nu oi oy oho ay wah haiya "
    "alamak aiyo aiyah allez voila mamma splendid marvellous typical honestly smashing nonsense "
    "rubbish hallelujah amen oof whoa uff ach oje"
)
_SOUND = re.compile(r"(?:a+h+|a+r+g+h*|o+h+|o+w+|e+k+|u+g+h+|(?:h[aeio]+){2,}h?|b+r+|h+m+|p+f+t?)")
"""What is cried in no spelling of its own: "aaargh", "hahaha"."""
_ALMIGHTY = lexicon.words("god lord heaven heavens goodness gods fates saints christ")
_OPTATIVES = lexicon.words(
    "bless love help save forgive rest damn curse thank hang sod drat blast confound spare preserve"
)
"""What is wished with nobody to do it: "God love her", "bless him", "thank heavens"."""
_OBJECTS = lexicon.words("him her them me us you it his my their our your 's")
_EVALUATES = lexicon.words(
    "poor dear old silly sweet wretched blessed stupid daft naughty lazy clumsy cheeky pesky "
    "bloomin blooming rotten useless miserable darned confounded infernal lovely precious little "
    "wee lucky darling clever brave good greedy messy grumpy mean rude so such proper right real"
)
_OF_PEOPLE = lexicon.words(
    "he she him her his they them who baby toddler lad lass fellow chap bloke lady gentleman mum "
    "mom mummy mommy dad daddy grandma grandpa granny nana auntie uncle son daughter nurse doctor "
    "boss neighbour neighbor"
) | lexicon.PERSON_NOUNS | frozenset(lexicon.GENDERS)  # fmt: skip
_CALLS = lexicon.words(
    "sweetie sweetheart honey darling kiddo kids children boys girls mum mom mummy mommy dad daddy "
    "grandma grandpa granny nana love pet dear son everyone everybody"
)
"""Who may be called in the midst of a sentence, besides those whose names are known."""
_BEING = lexicon.words(
    "honest frank truthful serious sincere straight fair reasonable nice kind good great lovely "
    "sweet brave quick fast snappy a an my"
)
"""What one is asked to be that is no way to do something: "be honest", and not "be discreet"."""
COMMENTING = lexicon.words(
    "honestly frankly seriously really truly luckily sadly obviously unfortunately fortunately "
    "hopefully apparently admittedly happily clearly evidently naturally personally thankfully "
    "silly lovely ugly smelly jolly holy family friendly lonely curly bully fly"
)
"""Words in -ly that are no manner."""
_IDIOMS = lexicon.phrases(
    "truth be told,hand on heart,imagine,just imagine,imagine that,"
    "to be honest,to be fair,to be frank,cross my heart,"
    "believe it or not,long story short,no offence,no offense,fingers crossed,mark my words,"
    "so help me,between you and me,as it happens,come to think of it,needless to say,i must say,"
    "i dare say,i daresay,i say,i tell you,mind you,i ask you,i swear,you see,as you know,as usual,"
    "as always,as ever,for what it is worth,so to speak,as it were,no doubt,without a doubt,"
    "of course,to tell the truth,to tell you the truth,all things considered,last but not least,"
    "touch wood,knock on wood,fair enough,would you believe it,more is the pity,worse luck,"
    "i kid you not,no kidding,no joke,not to worry,heavens above,heaven above,"
    "what am i saying,what was i saying,where was i,what am i like,who knows,who cares,"
    "who would have thought,can you believe it,am i right,you know what i mean,upon my word,"
    "if you know what i mean,in a manner of speaking,once and for all,time and again,move it,"
    "on the other hand,that said,having said that,be that as it may,god willing,with any luck,"
    "with a bit of luck,in all honesty,in fairness,at long last,at last,so be it,what else,"
    "no more no less,nothing more nothing less,that is a promise,i promise,i promise you,"
    "with a cherry on top,with a cherry on the cake,with knobs on,with bells on,with sugar on top,"
    "the one and only,for crying out loud,quick,quick quick,hurry,hurry up,chop chop,come on,"
    "anyway,anyways,anyhow,moving on,you are done,then you are done,"
    "that is it for today,let me think,let me see,let us see,there there,now now,come now,"
    "and i mean it,i mean it,whatever,either way,i am serious,"
    "no ifs no buts,no questions asked,at my age,in this weather,in this house,at your age"
)
"""Comments whose words say something else where they stand by themselves."""
_CHANGES = (
    CARRYING | CONDITIONS | TIMES | DENIALS | CHOICES | QUANTITIES | MEASURES
    | lexicon.DIRECTIONS | lexicon.ONES | lexicon.CONTAINERS
    | lexicon.words(
        "nowhere hardly whether case first soon today yesterday morning evening afternoon noon "
        "midnight clock again next last finally afterwards beforehand apart most least enough "
        "another other same too also times mean meant with by using via through along these those "
        "anything something everything"
    )
    | frozenset(
        phrase[0]
        for table in (lexicon.LOCATIVES, lexicon.GOALWARDS, lexicon.SOURCEWARDS)
        for phrase in table
    )
) - lexicon.BODY_NOUNS - lexicon.words("good one much many should")  # fmt: skip
"""With one of these in it a segment may change what is asked."""
_LINKS = lexicon.words("and so but well oh now")
_SWIFT = lexicon.words("quick fast swift speedy sharp quickly")
_SAYS = lexicon.words("say tell announce shout whisper repeat sing answer ask inform")


def parentheses(text: Text) -> list[Span]:
    """The segments of a sentence that can be passed over."""
    found: list[Span] = []
    for start, end in _segments(text):
        said = _SAYS.intersection(text.words[_sentence_start(text, start) : start])
        if not said and _is_idle(text, start, end):
            found.append((start, end))
    return found if len(found) < len(_segments(text)) else []


def said_to_others(text: Text) -> list[tuple[Span, str]]:
    """What is said to somebody else by name, behind what is asked, and to whom.

    ``Bring me the ball. Leo, shoes on!``; ``put it in the - sweetie, let go - in the box``.
    """
    found: list[tuple[Span, str]] = []
    for at in range(len(text)):
        begins = text.word(at - 1) in _SIGNS if at else _spoken_to(text)
        end = _called(text, at) if begins else None
        if end is None or text.word(end) != COMMA:
            continue
        within = at > 0 and text.tokens[at - 1].raw in DASHES
        close = _dash_after(text, end) if within else None
        known = text.name_at(at) is not None
        if close is None and (text.word(at - 1) != FULL_STOP or not known):
            continue
        stop = close or _next_stop(text, end)
        if close is None and not _bids(text, end + 1, stop):
            continue
        found.append(((at, stop), text.raw(at, end)))
    return found


def _spoken_to(text: Text) -> bool:
    """Whether what is said first is said to somebody else: "Ada, shoes! *And you*, bring ..."."""
    stop = _next_stop(text, 0)
    after = stop + 1 + (text.word(stop + 1) == "and")
    return stop < len(text) and text.word(after) == "you" and not verbs_at(text.words, after + 1)


def _called(text: Text, at: int) -> int | None:
    """Where somebody's name ends who is called at a word."""
    match = text.name_at(at)
    if match is not None and match.of("person"):
        return match.end
    return at + 1 if text.word(at) in _CALLS else None


def _bids(text: Text, at: int, end: int) -> bool:
    """Whether somebody is told to do something: "stop that", "shoes on!"."""
    shouted = "!" in text.tokens[end].raw if end < len(text) else False
    bare = bool(verbs_at(text.words, at)) and base_form(text.word(at)) == text.word(at)
    return bare or (shouted and told_end(text, at) is None)


def _dash_after(text: Text, at: int) -> int | None:
    """The dash that closes what a dash has opened."""
    for n in range(at, min(at + _LONGEST, len(text))):
        if text.tokens[n].raw in DASHES:
            return n
    return None


def _next_stop(text: Text, at: int) -> int:
    while at < len(text) and text.word(at) != FULL_STOP:
        at += 1
    return at


def _segments(text: Text) -> list[Span]:
    """What stands between signs."""
    found: list[Span] = []
    start = 0
    for at in range(len(text) + 1):
        if text.word(at) in _SIGNS:
            if at > start:
                found.append((start, at))
            start = at + 1
    return found


def _sentence_start(text: Text, at: int) -> int:
    while at > 0 and text.word(at - 1) != FULL_STOP:
        at -= 1
    return at


def _is_idle(text: Text, start: int, end: int) -> bool:
    """Whether a segment asks for nothing and changes nothing."""
    while start < end and text.word(start) in _LINKS:
        start += 1
    if start == end or end - start > _LONGEST or QUOTE in text.words[start:end]:
        return start == end
    if text.phrase_end(_IDIOMS, start) == end or _for_its_sake(text, start, end):
        return True
    if any(text.name_at(n) or text.index.partial(text.word(n)) for n in range(start, end)):
        return False
    forms = (_is_epithet, _is_thing_again, _is_swift, _is_address)
    if any(form(text, start, end) for form in forms):
        return True
    if any(_may_change(text.word(n)) for n in range(start, end)) or _orders(text, start, end):
        return False
    forms = (_is_exclaimed, _is_wished, _is_comment, _is_taken_up)
    return any(form(text, start, end) for form in forms)


def _may_change(word: str) -> bool:
    manner = word.endswith("ly") and word not in COMMENTING
    return word in _CHANGES or word[0].isdigit() or manner


def _orders(text: Text, start: int, end: int) -> bool:
    """Whether something in it may be an order to the robot, with a verb it knows or not."""
    for n in range(start, end):
        word, before = text.word(n), text.word(n - 1) if n > start else ""
        begins = before in ("", "and", "to", "please", "you", "let", "just", "will", "should")
        if word in _OPTATIVES or (word in INTERJECTIONS and n == start):
            continue
        if begins and (verbs_at(text.words, n) or (before != "" and _may_be_verb(word))):
            return True
    return False


def _may_be_verb(word: str) -> bool:
    """Whether English has a word that is this one with -ing: "juggle", "vacuum"."""
    stems = (word, word.removesuffix("e"), word + word[-1])
    return any(is_english(stem + "ing") for stem in stems)


def _is_exclaimed(text: Text, start: int, end: int) -> bool:
    """Goodness me; aaargh; oh my poor back; what weather."""
    word, length = text.word(start), end - start
    if word == "what" and length > 1:
        asked = end < len(text) and "?" in text.tokens[end].raw
        verb = any(text.word(n) in lexicon.AUXILIARIES for n in range(start, end))
        return not asked and not verb
    cried = word in INTERJECTIONS or _SOUND.fullmatch(word) is not None
    if not cried:
        mine = word in ("my", "dear", "good", "holy", "great") and length > 1
        return mine and text.word(start + 1) in INTERJECTIONS | _ALMIGHTY | {"me", "word", "days"}
    rest = text.word(start + 1) if length > 1 else "me"
    listed = rest in ("the", "a", "an", "some")  # oh, the saucer
    return not listed and (rest in lexicon.FUNCTION_WORDS or not _may_be_verb(rest))


def _is_wished(text: Text, start: int, end: int) -> bool:
    """God love her; bless him; thank heavens."""
    start += text.word(start) == "may"
    start += text.word(start) in _ALMIGHTY and end - start > 1
    if text.word(start) not in _OPTATIVES:
        return False
    after = text.word(start + 1) if start + 1 < end else ""
    return after in _OBJECTS | _ALMIGHTY | {"the"} or (not after and text.word(start - 1) != "")


def _is_comment(text: Text, start: int, end: int) -> bool:
    """Be honest; honestly; they are like rusty hinges."""
    if text.word(start) == "be" and 1 < end - start < _EPITHET:
        return text.word(start + 1) in _BEING
    if end - start == 1 and text.word(start) in COMMENTING and text.word(start).endswith("ly"):
        return True
    return told_end(text, start) == end


def _is_taken_up(text: Text, start: int, end: int) -> bool:
    """*My knees*, they are like rusty hinges."""
    owned = text.word(start) in lexicon.DETERMINERS and 1 < end - start < _EPITHET
    subject = text.word(end + 1) in ("they", "it", "he", "she", "that")
    return owned and subject and told_end(text, end + 1) is not None


def _is_address(text: Text, start: int, end: int) -> bool:
    """My tin friend; you absolute legend."""
    you = text.word(start) == "you" and 1 < end - start <= _EPITHET
    plain = not (_may_be_verb(text.word(start + 1)) or verbs_at(text.words, start + 1))
    if you and plain and text.word(start + 1) not in lexicon.FUNCTION_WORDS:
        return _only_evaluates(text, start, end)
    called = text.word(end - 1) in ADDRESSES and end - start <= _EPITHET
    mine = text.word(start) in ("you", "my", "dear", "good", "old")
    return called and mine and _only_evaluates(text, start, end)


def _only_evaluates(text: Text, start: int, end: int) -> bool:
    """Whether words say no more than what somebody thinks of somebody or something."""
    harmless = lexicon.EMPTY_ADJECTIVES | _EVALUATES | lexicon.DETERMINERS | set(lexicon.SIZES)
    said = [word for word in text.words[start:end] if word not in harmless]
    return not any(map(_may_change, said)) and not _orders(text, start, end)


def _is_epithet(text: Text, start: int, end: int) -> bool:
    """Leo is late, *the poor lamb*; of somebody only, for things have names that are not known."""
    about = text.words[_before(text, start) : start]
    person = _OF_PEOPLE.intersection(about) or any(
        (match := text.name_at(n)) and match.of("person")
        for n in range(_before(text, start), start)
    )
    if not person or end - start > _EPITHET or _orders(text, start, end):
        return False
    if not _only_evaluates(text, start, end):
        return False
    determined = text.word(start) in ("the", "that", "what", "such", "my", "a", "an")
    return (determined and end - start > 1) or text.word(start) in _EVALUATES


def _is_thing_again(text: Text, start: int, end: int) -> bool:
    """The teapot, *chipped old thing*, ...: there is but one, whatever it is called besides."""
    if text.word(end - 1) not in ("thing", "things") or end - start > _EPITHET:
        return False
    if frozenset(lexicon.COLORS).intersection(text.words[start:end]):
        return False
    meant = [match for n in range(_before(text, start), start) if (match := text.name_at(n))]
    things = [name for match in meant for name in match.names if name.kind == "object"]
    plain = _only_evaluates(text, start, end - 1)
    return plain and bool(things) and not text.index.variants(things[-1].name)


def _is_swift(text: Text, start: int, end: int) -> bool:
    """Quick as a flash."""
    start += text.word(start) == "as"
    return text.word(start) in _SWIFT and text.word(start + 1) == "as" and end - start < _EPITHET


def _for_its_sake(text: Text, start: int, end: int) -> bool:
    """For pity's sake; in heaven's name."""
    return (text.word(start), text.word(end - 1)) in (("for", "sake"), ("in", "name"))


def _before(text: Text, start: int) -> int:
    """Where the segment before a segment begins."""
    at = start - 1
    while at > 0 and text.word(at - 1) not in _SIGNS:
        at -= 1
    return max(at, 0)
