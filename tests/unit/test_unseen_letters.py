"""What nobody sees is the same to who hears words and to who prints names."""

import sys
import unicodedata

from intents import letters
from robot.printable import is_printable

BLANKS = "\t\n"


def test_no_letter_that_words_are_heard_without_can_stand_in_a_name():
    kept = [
        hex(code)
        for code in range(sys.maxunicode + 1)
        if letters._UNSEEN.fullmatch(chr(code))
        and chr(code) not in BLANKS
        and is_printable(chr(code))
    ]
    assert not kept


def test_no_mark_of_format_can_stand_in_a_name():
    """Category Cf; those that are seen as part of a number or a word are let through."""
    seen = ("ARABIC", "SYRIAC", "KAITHI", "EGYPTIAN", "SHORTHAND")
    kept = [
        unicodedata.name(chr(code), hex(code))
        for code in range(sys.maxunicode + 1)
        if unicodedata.category(chr(code)) == "Cf" and is_printable(chr(code))
    ]
    assert not [name for name in kept if not name.startswith(seen)]
