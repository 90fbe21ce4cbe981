"""Which language a text is in, where that is plainly not English; and to say so in it.

Only whole sentences are told: by their script, or by the little words that every sentence has
("the", "with", "please"). A single word is nobody's language, and names of the world may be in any.
"""

import re
from collections.abc import Iterable

from intents.english.words.lexicon import words
from intents.letters import bare

_LITTLE_WORDS = {
    "german": "der die das den dem des ein eine einen einer und oder nicht ich du er sie wir "
    "ihr mir mich dir dich bitte mit auf aus bei nach von zu zum zur ist sind hast kannst "
    "konntest geh gehe bring bringe hol hole nimm leg lege stell stelle tisch kuche wo wie "
    "dann auch noch mal fur dort hier kommt komm",
    "french": "le la les un une des du et ou ne pas je tu il elle nous vous moi toi mon ma mes "
    "ton ta dans sur avec pour est sont peux pouvez va allez apporte apportez prends prenez "
    "mets mettez s'il te plait puis aussi cuisine table est-ce qui que au aux chez ici",
    "spanish": "el la los las un una unos y o no yo tu mi mis me te en con por favor para de "
    "del al es esta estan puedes ve vaya trae traeme lleva toma coge pon ponlo sobre que donde "
    "como luego tambien cocina mesa aqui alli",
    "italian": "il lo la gli le un uno una e o non io tu mi ti in con per di del della dei al "
    "alla sul sulla e' sono puoi vai porta portami prendi metti mettilo favore che dove come "
    "poi anche cucina tavolo qui dov'e cos'e c'e",
    "portuguese": "o a os as um uma e ou nao eu voce me te em no na nos nas com por favor para "
    "do da dos das ao esta estao pode va traga traz leve pegue ponha coloque que onde como "
    "depois tambem cozinha mesa aqui",
    "dutch": "de het een en of niet ik jij je hij zij wij mij me naar op met van voor "
    "alsjeblieft alstublieft kun kunt is zijn ga breng pak zet leg keuken tafel waar hoe dan "
    "ook nog daar hier",
    "polish": "i lub nie ja ty on ona my mi mnie do na w z ze pod prosze jest sa czy mozesz "
    "idz przynies wez poloz postaw kuchni kuchnia stol stole gdzie jak potem tez tu tam oraz "
    "ten ta to",
    "turkish": "ve veya degil ben sen bana beni sana bir bu su lutfen icin ile nerede nasil "
    "sonra da de mi misin git getir al koy mutfaga mutfak masa masaya masanin ustune olan "
    "kirmizi",
    "swedish": "och eller inte jag du han hon vi mig dig min din en ett den det de pa i med "
    "till fran for ar kan snalla ga hamta ta lagg stall koket bordet var hur sedan ocksa har "
    "dar",
    "indonesian": "dan atau tidak saya kamu anda dia kami ke di dari dengan untuk tolong "
    "silakan itu ini yang bisa pergi bawa bawakan ambil letakkan taruh dapur meja mana "
    "bagaimana lalu juga",
}
_ENGLISH = words(
    "the a an to and of in on at from with for is are was be it its this that these those me my "
    "you your we us he she him her they them i not no please go get bring take put pick up down "
    "then or if when what where which who how can could would will do does have has had by next "
    "near table kitchen cup room over under as so there here all one"
)
_SCRIPTS = (
    ("japanese", "\u3040-\u30ff"),
    ("korean", "\u1100-\u11ff\uac00-\ud7af"),
    ("chinese", "\u4e00-\u9fff"),
    ("ukrainian", "іїєґ"),
    ("russian", "а-яё"),
    ("arabic", "\u0621-\u064a"),
    ("hindi", "\u0900-\u097f"),
    ("greek", "α-ω"),
    ("hebrew", "\u05d0-\u05ea"),
    ("thai", "\u0e00-\u0e7f"),
)
"""In this order: Japanese has Chinese letters too, Ukrainian nearly all of the Russian ones."""
_ONLY_ENGLISH = {
    "german": "Ich verstehe nur Englisch.",
    "french": "Je ne comprends que l'anglais.",
    "spanish": "Solo entiendo inglés.",
    "italian": "Capisco solo l'inglese.",
    "portuguese": "Só entendo inglês.",
    "dutch": "Ik begrijp alleen Engels.",
    "polish": "Rozumiem tylko po angielsku.",
    "turkish": "Yalnızca İngilizce anlıyorum.",
    "swedish": "Jag förstår bara engelska.",
    "indonesian": "Saya hanya mengerti bahasa Inggris.",
    "japanese": "英語しかわかりません。",
    "korean": "저는 영어만 알아듣습니다.",
    "chinese": "我只听得懂英语。",
    "ukrainian": "Я розумію лише англійську.",
    "russian": "Я понимаю только по-английски.",
    "arabic": "أفهم الإنجليزية فقط.",
    "hindi": "मैं केवल अंग्रेज़ी समझता हूँ।",
    "greek": "Καταλαβαίνω μόνο αγγλικά.",
    "hebrew": "אני מבין רק אנגלית.",
    "thai": "ฉันเข้าใจแต่ภาษาอังกฤษ",
}
LANGUAGES = tuple(_ONLY_ENGLISH)
_FEWEST_WORDS = 3
_FEWEST_LITTLE = 2
_SHARE = 0.4
"""Of the words of a text that are the little words of its language: about half are in any."""
_FEWEST_LETTERS = 4
"""Of another script: less may be a name."""
_WORD = re.compile(r"[^\W\d_]+(?:['’][^\W\d_]+)*")
_LISTS = tuple((name, words(bare(its))) for name, its in _LITTLE_WORDS.items())


def language_of(text: str) -> str | None:
    """The language of a sentence that is plainly in another one than English, else None."""
    plain = bare(text)
    said = _WORD.findall(plain)
    english = sum(word in _ENGLISH for word in said)
    return (None if plain.isascii() else _by_script(text, english)) or _by_words(said)


def only_english(language: str) -> str:
    """I understand English only: said in a language, and in English for whoever is by."""
    return f"{_ONLY_ENGLISH[language]} (I understand English only.)"


def _by_script(text: str, english: int) -> str | None:
    letters = [letter for letter in text.casefold() if letter.isalpha()]
    for language, ranges in _SCRIPTS:
        its = re.findall(f"[{ranges}]", text.casefold())
        whole = sum(not (letter.isascii() or letter in "øœßæ") for letter in letters)
        if its and not english and len(its) * 3 > len(letters) and whole >= _FEWEST_LETTERS:
            return language
        if its and language == "ukrainian" and whole * 2 > len(letters) and not english:
            return language
    return None


def _by_words(said: list[str]) -> str | None:
    if len(said) < _FEWEST_WORDS:
        return None
    language, little, english = max(_counts(said), key=lambda found: found[1])
    fewest = max(_FEWEST_LITTLE, _SHARE * len(said), 2 * english + 1)
    return language if little >= fewest else None


def _counts(said: list[str]) -> Iterable[tuple[str, int, int]]:
    """How many words of a text are of each language only, and how many are of English only."""
    return (
        (
            name,
            sum(word in its and word not in _ENGLISH for word in said),
            sum(word in _ENGLISH and word not in its for word in said),
        )
        for name, its in _LISTS
    )
