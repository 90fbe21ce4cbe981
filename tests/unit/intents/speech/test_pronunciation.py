"""Every name can be said."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.english.words.lexicon import words
from intents.speech.pronunciation import by_letters, pronounce, variants

KNOWN = {
    "side": "S AY D", "board": "B AO R D", "work": "W ER K", "top": "T AA P", "cup": "K AH P",
    "box": "B AA K S", "dog": "D AO G", "seven": "S EH V AH N", "up": "AH P", "one": "W AH N",
}  # fmt: skip
PHONES = words(
    "AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W "
    "Y Z ZH"
)


@pytest.mark.parametrize(
    ("word", "phones"),
    [
        ("cup", "K AH P"),
        ("sideboard", "S AY D B AO R D"),
        ("worktop", "W ER K T AA P"),
        ("cups", "K AH P S"),
        ("boxes", "B AA K S IH Z"),
        ("dogs", "D AO G Z"),
        ("7up", "S EH V AH N AH P"),
        ("side-board", "S AY D B AO R D"),
    ],
)
def test_words_made_of_known_ones(word, phones):
    assert pronounce(word, KNOWN.get) == phones


@pytest.mark.parametrize(
    ("word", "phones"),
    [
        ("nadim", "N AE D IH M"),
        ("lena", "L EH N AH"),
        ("mika", "M IH K AH"),
        ("kate", "K EY T"),
        ("phone", "F OW N"),
        ("celia", "S EH L IY AH"),
        ("chuck", "CH AH K"),
        ("yusuf", "Y AH S AH F"),
        ("priya", "P R IY AH"),
    ],
)
def test_the_usual_sounds_of_letters(word, phones):
    assert by_letters(word) == phones


@given(st.text("abcdefghijklmnopqrstuvwxyz'-0123456789", min_size=1, max_size=20))
def test_any_word_has_phones_of_the_dictionary(word):
    phones = pronounce(word, KNOWN.get).split()
    assert set(phones) <= PHONES
    assert phones or not any(c.isalnum() for c in word)


@pytest.mark.parametrize(
    ("phones", "others"),
    [("B OW L", ["B AH UH L"]), ("HH AO L T", ["HH AA L T"]), ("B OW", []), ("S AO L", [])],
)
def test_what_others_say_otherwise(phones, others):
    assert variants(phones) == others
