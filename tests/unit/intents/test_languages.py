"""Another language than English is told by whole sentences, and said to be not understood."""

import pytest

from intents.languages import LANGUAGES, language_of, only_english
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Vocabulary

WORDS = Vocabulary.of(objects=["cup", "bottle", "croissant", "Stuhl"], places=["table", "Küche"])
SENTENCES = (
    ("german", "Bitte hol mir die Flasche aus dem Schrank"),
    ("german", "leg den Löffel auf den Teppich"),
    ("french", "prends la bouteille et mets-la dans le placard"),
    ("french", "va dans le salon"),
    ("spanish", "lleva el plato a la mesa por favor"),
    ("spanish", "pon la botella en el estante"),
    ("italian", "prendi la bottiglia e portala nella cucina per favore"),
    ("portuguese", "leve o prato para a mesa, por favor"),
    ("dutch", "zet de lepel op het kleed en ga naar de keuken"),
    ("polish", "przynieś mi butelkę z kuchni proszę"),
    ("turkish", "lütfen bana mutfaktan bir bardak getir"),
    ("swedish", "ta flaskan och ställ den på bordet"),
    ("indonesian", "tolong ambil botol itu dari meja dan bawa ke dapur"),
    ("russian", "принеси бутылку из кухни"),
    ("ukrainian", "принеси пляшку із кухні"),
    ("japanese", "ボトルを台所から持ってきて"),
    ("chinese", "把瓶子放到桌子上"),
    ("korean", "부엌에서 병을 가져와 주세요"),
    ("arabic", "ضع الزجاجة على الطاولة"),
    ("hindi", "बोतल मेज़ पर रख दो"),
    ("greek", "βάλε το μπουκάλι στο τραπέζι"),
    ("hebrew", "שים את הבקבוק על השולחן"),
    ("thai", "วางขวดไว้บนโต๊ะ"),
)
ENGLISH = (
    "", "no", "si", "ja", "la", "bring", "die", "bring me", "the cup", "por favor", "por favor, go",
    "bring me the croissant", "bring me the cup por favor", "go to the Küche", "take the Stuhl",
    "put the Stuhl in the Küche", "bitte go to the table", "put it on the table, s'il te plait",
    "tell Anna to come to me", "go to la Defense", "call de Vries", "bring 茶 to me", "茶",
    "my favourite is El Greco", "put a pot au feu on the table", "say hola", "say bonjour to Ada",
)  # fmt: skip


@pytest.mark.parametrize(("language", "text"), SENTENCES)
def test_a_sentence_tells_its_language_and_is_answered_in_it(language: str, text: str) -> None:
    assert language_of(text) == language
    said = parse(text, WORDS)
    assert isinstance(said, Refusal)
    assert said.reason == only_english(language)
    assert "I understand English only" in said.reason
    assert "\n" not in said.reason


def test_every_language_that_is_told_has_its_answer() -> None:
    assert len({only_english(language) for language in LANGUAGES}) == len(LANGUAGES) >= 10
    assert {language for language, _ in SENTENCES} == set(LANGUAGES)


@pytest.mark.parametrize("text", ENGLISH)
def test_english_and_what_is_too_short_to_tell_is_no_other_language(text: str) -> None:
    assert language_of(text) is None


def test_names_in_another_language_are_names() -> None:
    assert isinstance(parse("put the croissant on the table", WORDS), Goals)
    assert isinstance(parse("go to the Küche", WORDS), Goals | Question)


@pytest.mark.parametrize(
    "text", ["стоп!", "para por favor", "bitte halt an", "停下来", "arrête-toi"]
)
def test_stop_is_stop_in_any_language(text: str) -> None:
    said = parse(text, WORDS)
    assert isinstance(said, Goals)
    assert said.parser == "stop"
