"""Misspelt words, corrected towards the vocabulary and the words of the grammar."""

from functools import lru_cache

from rapidfuzz.distance import OSA

from intents.english import lexicon
from intents.english.measures import NUMBER_WORDS, UNIT_WORDS
from intents.english.names import NameIndex, index_of
from intents.english.properties import PROPERTIES
from intents.english.verbs import FIRST_WORDS, SENSES, base_form
from intents.vocabulary import Vocabulary

_PHRASES = (
    set(SENSES)
    | set(lexicon.SUPERLATIVES)
    | set(lexicon.POSTURES)
    | set(lexicon.LOCATIVES)
    | lexicon.CONNECTORS
    | lexicon.FILLERS
    | lexicon.OPENERS
)
GRAMMAR_WORDS = (
    {word for phrase in _PHRASES for word in phrase}
    | lexicon.FUNCTION_WORDS | lexicon.PERSON_NOUNS | lexicon.OBJECT_NOUNS | lexicon.CONTAINERS
    | lexicon.PLACE_NOUNS | lexicon.BODY_NOUNS | lexicon.EMPTY_ADJECTIVES | lexicon.CLOTHES
    | lexicon.OPERATOR_WORDS | lexicon.ONES | set(lexicon.COLORS) | set(lexicon.SIZES)
    | set(lexicon.GENDERS) | set(lexicon.LEVELS) | NUMBER_WORDS | UNIT_WORDS | set(PROPERTIES)
)  # fmt: skip
"""Every word that the grammar itself knows."""
CORE = lexicon.words(
    "please bring take place pick grab grasp find locate search look follow guide escort lead meet "
    "greet introduce tell answer count open close switch turn walk move navigate deliver give hand "
    "stand balance squat wait stop pause continue cancel repeat report left right forward backward "
    "degrees metres meters seconds minutes person people object objects largest biggest smallest "
    "heaviest lightest thinnest leftmost rightmost yellow orange purple black white brown green "
    "where there under behind between above next then after from with into onto towards question "
    "sitting standing lying waving raising pointing wearing something kitchen bathroom bedroom "
    "table shelf counter could would second robot three seven eight thing things"
)
"""The words of the grammar that misspelt words are corrected to."""
COMMON_WORDS = lexicon.words(
    "able accident actually address afternoon again age ago agree air alarm album all almost alone "
    "already always america amount animal answer apartment apologize appear apple appointment april "
    "area army around art ask audio august aunt autumn away baby bad ball band bank bar base bath "
    "bead beach bean bear beat become beer before begin behave believe bell belong bench best better "
    "bird birth birthday bite blame bless blind blood blow boat body bone book boot born boss both "
    "bottom bowl boy brain brave bread break breakfast brick bride bright broad broken brother brush "
    "build bull burn bus business busy butter button buy cable cake calendar call calm camera camp "
    "candle cap car card care cart case cash cat catch cause certain chain chair chance change cheap "
    "check cheese chess chest chief child choice church cinema circle city class clean clear clever "
    "click climb clock cloud club coach coal coat code coffee coin cold college color comb come "
    "common company compare complete concert condition cook cool copy corn corner correct cost cotton "
    "country course court cover crazy create cross crowd cry culture cup current curtain customer cut "
    "daily damage damp dance danger dark date daughter day dead deal dear death december decide deep "
    "deer degree desert design desk detail die dinner dirty disk doctor dog doll dollar door double "
    "doubt dragon dream dress drink drive drop dry dust duty each ear early earn earth east easy edge "
    "egg elevator email empty end enemy energy engine english enjoy enough enter equal error even "
    "evening event ever every exact example except excited expect expensive explain eye fable face "
    "fact fail fair fall false family famous fan far farm fashion fast fat father favor fear february "
    "feed feel festival fever few field fight file fill film final fine finger fire firm fish fit fix "
    "flag flat flight floor flour flow flower fly fold food fool football force foreign forest forget "
    "forgive fork form fox frame free freedom friday friend from fruit fun funny future gain game "
    "garage garden gas gate gear general gentle ghost gift glad glass goal goat god gold good goods "
    "google grand grass great green group grow guess guest guitar gun hair half hall hammer happen "
    "happy hard hate health hear heart heat heaven heavy height hen hide high hill history hole "
    "holiday home honest honey hook hope horn horse hospital host hot hotel hour house human hungry "
    "hurt husband ice idea image island january job join joke joy juice july jump june just keen key "
    "kick kill kind king kiss kit kite knee know lake lamb lamp land language last late laugh law "
    "lazy leaf learn least leather leave leg lemon lend less lesson letter level library lie life "
    "lift light like line link lion lip list little live load loan local lock log long lord lose loss "
    "lot loud love low luck lunch machine mad magic mail main make male mall many map march mark "
    "market marry mask master mat match math matter maybe meal mean meat media medicine meeting "
    "melon member memory mention menu mess message metal mice middle might mile milk mind mine minute "
    "mirror miss mistake model modern moment monday money monkey month mood moon more morning mother "
    "mouse mouth movie much mud museum music nail name narrow nation nature nearby neat neck need "
    "nest net news nice night noise none noon north nose note notice november number nurse nut ocean "
    "october offer office often oil old once onion only opinion order other oven own owner pack page "
    "pain paint pair pan paper parent park part party pass past pay peace pear pen pencil pepper "
    "perfect period phone photo piano picture piece pig pin pine pink pipe plan plane plant plastic "
    "play player pleasant plenty pocket podcast poem point police polite pool poor popular port post "
    "pot potato pound power prefer prepare press pretty price prince print prize problem promise "
    "proper proud prove pull pump purpose push quality queen quick quiet quite race radio rail rain "
    "rake rate rather reach read ready real reason receive recipe record reminder rent repair rest "
    "restaurant result return rice rich ride ring rise risk river road rob rock rocket roll roof "
    "room root rope rose rough row rude rule ruler sad safe sail salad salt same sand saturday sauce "
    "save scale school science sea seat secret self sell send sense september serious serve service "
    "several shade shadow shake shame shape share sharp sheep sheet shell shine ship shoe shop short "
    "shout shut sick side sign silence silk silver simple since sing single sister size skill skin "
    "skirt sky slave sleep slip slow small smart smell smile smoke snack snake snow social soda soft "
    "soil some son song soon sorry sort soul sound soup south space speed spell spend spoon sport "
    "spread spring square stage stair stamp star start state station status stay steak steal steam "
    "steel stem step still stock stone store storm story strange stream street strong student study "
    "stuff style sugar suit summer sun sunday support sure surprise sweet swim sword table tail talk "
    "tall tap tape taste tax taxi tea teach team tear television tell temperature temple tennis tent "
    "term test thank theater thick thin think thirst thread throat thunder thursday ticket tide tie "
    "tiger time tin tiny tip tire title today toe together tomorrow tone tongue tonight tool tooth "
    "topic total touch tour tow town toy track trade traffic train travel tree trick trip trouble "
    "true trust truth try tuesday tune tweet twist type ugly uncle unicorn until upset use usual van "
    "vase video view visit voice volume wage waiter wake walk wall want war warm warn wash waste "
    "water wave way weak wealth weather website wednesday week weekend weigh weight welcome well west "
    "wet what wheel while who whole why wide wife wild will win wind window wine wing winter wire "
    "wise wish wolf woman wonder wood wool word work world worry worst worth write wrong yard year "
    "somewhere everywhere anywhere nowhere yes yesterday yet young yourself zoo drown alexa olly siri uber facebook twitter"
)
"""Words that mean themselves even where a name of the vocabulary is one letter away."""


def _slack(word: str) -> int:
    """How many edits a word of its length may be away from what was meant."""
    return 0 if len(word) < 4 else 1 if len(word) < 7 else 2


class Speller:
    """Corrects words towards one vocabulary."""

    def __init__(self, index: NameIndex) -> None:
        self._names = sorted(w for w in index.words if len(w) > 2)
        self._known = index.words | GRAMMAR_WORDS
        self._grammar = sorted(CORE)

    def correct(self, word: str) -> list[str]:
        """The words that were meant: usually the word itself; "thecup" is two words."""
        if word in self._known or word in COMMON_WORDS or not word.isalpha():
            return [word]
        past = word.removesuffix("d"), word.removesuffix("ed")
        if base_form(word) in FIRST_WORDS or any(w in FIRST_WORDS for w in past):
            return [word]
        return self._parts(word) or [self._nearest(word)]

    def _nearest(self, word: str) -> str:
        slack = _slack(word)
        ranked: list[tuple[float, str]] = []
        for penalty, words in ((0.0, self._names), (0.25, self._grammar)):
            for known in words:
                if abs(len(known) - len(word)) <= slack and slack:
                    distance = OSA.distance(word, known, score_cutoff=slack)
                    far = distance > slack or (distance > 1 and known[0] != word[0])
                    if not far:
                        ranked.append((distance + penalty + 0.5 * (known[0] != word[0]), known))
        if ranked:
            return min(ranked)[1]
        begun = [n for n in self._names if len(word) >= 4 and n.startswith(word)]
        return begun[0] if len(begun) == 1 and len(word) * 2 >= len(begun[0]) else word

    def _parts(self, word: str) -> list[str]:
        """Two words written as one, the first a small one; empty if it is not two words."""
        for size in (2, 3, 4, 5):
            head, tail = word[:size], word[size:]
            small = head in lexicon.FUNCTION_WORDS or (head,) in SENSES
            if small and len(tail) > 2 and tail in self._known:
                return [head, tail]
        return []


@lru_cache(maxsize=8)
def speller_of(vocabulary: Vocabulary) -> Speller:
    """The speller of a vocabulary, kept from one sentence to the next."""
    return Speller(index_of(vocabulary))
