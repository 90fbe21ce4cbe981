"""What people, pastes and programs say."""

from tests.hostile.cases import Case, Expect
from tests.hostile.corpus.shapes import DIGITS, NAMES
from tests.hostile.exam import exam

UNDERSTOOD_OR_NOT = Expect.ENDS
SENTENCES = {
    **{f"name-{name}": f"pick up the {text}" for name, text in NAMES.items() if name != "nul"},
    "100-kB": "walk " + "very " * 20_000 + "far",
    "one-word-of-100-kB": "a" * 100_000,
    "10000-and": "wave " + "and wave " * 10_000,
    "10000-commas": "wave" + "," * 10_000 + "nod",
    "10000-then": "then " * 10_000 + "wave",
    "10000-not": "do not " * 10_000 + "wave",
    "10000-the": "pick up " + "the " * 10_000 + "cup",
    "1000-if": "if the cup is on the table " * 1000 + "wave",
    "1000-quotes": 'say "' * 1000,
    "1000-brackets": "(" * 1000 + "wave" + ")" * 1000,
    "1000-on": "pick up the cup " + "on the table " * 1000,
    "1000-it": "pick it up and put it down " * 300,
    "1000-no-wait": "the red cup, no wait, " * 1000 + "the blue one",
    "nested-repeat": "repeat three times " * 200 + "wave",
    "nested-tell": "tell anna that " * 500 + "hello",
    "digits": f"walk {DIGITS} metres forward",
    "digits-wait": f"wait {DIGITS} seconds",
    "digits-times": f"wave {DIGITS} times",
    "digits-fraction": f"walk 0.{DIGITS} metres forward",
    "digits-exponent": "walk 1e999999999 metres",
    "digits-words": "walk " + "nine hundred " * 500 + "metres forward",
    "digits-hundred": "wait " + "hundred " * 2000 + "seconds",
    "digits-thousand": "wait one " + "thousand " * 1000 + "seconds",
    "digits-arabic": "walk ٣ metres forward",
    "digits-superscript": "walk ² metres forward",
    "digits-roman": "walk Ⅻ metres forward",
    "fraction": "walk 1/0 metres forward",
    "fraction-character": "walk ½ metre forward",
    "fraction-digits": f"walk 1/{DIGITS} metres forward",
    "minus": "walk -5 metres forward",
    "nan": "walk nan metres forward",
    "infinity": "walk infinity metres forward",
    "wait-inf": "wait inf seconds",
    "rtl": "التقط الكوب الأحمر",
    "rtl-mixed": "pick up the \u202egnp.exe\u202c cup",
    "emoji": "👋🏽 the 🍵 on the 🧑‍🤝‍🧑",
    "zalgo": "w" + "\u0301" * 5000 + "ave",
    "wide": "ｗａｖｅ",
    "mathematical": "𝐰𝐚𝐯𝐞",
    "ligature": "ﬁnd the ﷺ",
    "casefold": "ẞtop İstanbul ŉ",
    "shell": "$(touch owned) `touch owned` ; touch owned",
    "shell-pipe": "wave | tee owned > owned",
    "sql": "'; DROP TABLE goals; --",
    "format-class": "{0.__class__.__init__.__globals__}",
    "format-percent": "%s%s%s%n%x %(name)s",
    "format-brace": "{} {0} {{}} {",
    "template": "{{thing}} ${thing} #{thing} <%= thing %>",
    "markup-close": "[/red][/] wave",
    "markup-link": "[link=file:///etc/passwd]wave[/link]",
    "markup-escaped": r"\[bold] wave \\[/bold]",
    "html": "<script>alert(1)</script>",
    "json": '{"goal": "stop", "goals": []}',
    "yaml": "!!python/object/apply:os.system [id]",
    "regular-expression": "(a+)+$ (.*)*" + "a" * 5000 + "!",
    "spaces": " " * 50_000 + "wave" + " " * 50_000,
    "tabs": "\t" * 5000 + "wave",
    "newlines": "\n" * 5000 + "wave",
    "vertical": "walk\x0bto\x0cthe\x1ctable",
    "bom": "\ufeffwave",
    "soft-hyphens": "wa\u00adve",
    "tags": "wave" + "".join(chr(0xE0000 + ord(c)) for c in "and open the door"),
    "private": "wave \ue000\uf8ff\U0010ffff",
    "noncharacter": "wave \ufffe\uffff",
    "replacement": "wave \ufffd",
    "path": "pick up ../../../../etc/passwd",
    "option": "-- --help --version",
    "punctuation": "?!.,;:" * 2000,
    "apostrophes": "'" * 5000,
    "spelled-stop": "s t o p",
    "one-letter": "x",
    "underscores": "_" * 3000,
    "corrections": " ".join("picq upp tha redd cupp"[i % 20 :] for i in range(400)),
    "misspelt": "qwertz " * 3000,
}
STOPS = {
    "zero-width-space": "st\u200bop",
    "zero-width-joiner": "s\u200dt\u200do\u200dp",
    "word-joiner": "st\u2060op",
    "bom": "\ufeffstop",
    "soft-hyphen": "st\u00adop",
    "left-to-right-mark": "\u200estop\u200f",
    "bidi": "\u202dstop\u202c",
    "escape": "\x1b[31mstop\x1b[0m",
    "tail": "stop\u200b!",
    "wide": "ｓｔｏｐ",
    "variation": "stop\ufe0f",
    "combining-grapheme-joiner": "st\u034fop",
    "nul-like": "st\x01op",
}
"""Each is a cry to stop, and must be taken for one."""

FRONTS = {
    "do": ("do", "--fast"),
    "do-json": ("do", "--fast", "--json"),
    "do-live": ("do",),
    "eval": ("eval", "--seeds", "1", "--json"),
}
REFUSED_EVERYWHERE = {
    "escape": f"fly to the {NAMES['escape']}",
    "osc-link": f"fly to the {NAMES['osc-link']}",
    "bidi": f"fly to the {NAMES['bidi']}",
    "c1": f"fly to the {NAMES['c1']}",
    "digits": f"walk {DIGITS} metres forward",
    "markup": "fly to the [/] [link=x]moon",
    "format": "fly to {0.__class__}",
    "surrogate": b"fly to the \xff\xfe moon",
    "empty": "",
    "100-kB": "fly " * 25_000,
}

CASES = [
    *(
        Case(name=f"parse-{name}", argv=("parse", "--", text), expect=UNDERSTOOD_OR_NOT)
        for name, text in SENTENCES.items()
    ),
    *(
        Case(
            name=f"parse-json-{name}",
            argv=("parse", "--json", "--", SENTENCES[name]),
            expect=UNDERSTOOD_OR_NOT,
        )
        for name in ("name-escape", "name-bidi", "name-c1", "name-separator", "digits", "10000-and")
    ),
    *(
        Case(
            name=f"stop-{name}",
            argv=("parse", "--json", "--", text),
            expect=Expect.ACCEPTED,
            says=('"goal":"stop"',),
        )
        for name, text in STOPS.items()
    ),
    *(
        Case(
            name=f"{front}-{name}",
            argv=(*argv, "--", text),
            says=("What to do", "Try", "suggestion", "Usage"),
        )
        for front, argv in FRONTS.items()
        for name, text in REFUSED_EVERYWHERE.items()
    ),
    *(
        Case(
            name=f"file{'-json' if json else ''}-{name}",
            argv=("parse", "--file", "said.txt", *json),
            files={"said.txt": content},
            expect=UNDERSTOOD_OR_NOT,
        )
        for name, content in {
            "escapes": "\n".join(f"pick up the {text}" for text in NAMES.values()),
            "latin-1": "pick up the café".encode("latin-1"),
            "utf-16": "wave\nnod\n".encode("utf-16"),
            "bom": b"\xef\xbb\xbfwave\n",
            "nul": b"wave\x00nod\n",
            "crlf": b"wave\r\nnod\r\n",
            "no-newline": b"wave",
            "surrogates": b"wave \xed\xa0\x80 nod\n",
            "empty": b"",
            "one-line-of-1-MB": b"wave " * 200_000,
            "digits": f"walk {DIGITS} metres\n".encode(),
        }.items()
        for json in ((), ("--json",))[: 2 if name in ("escapes", "digits") else 1]
    ),
    *(
        Case(name=f"stdin-{name}", argv=("parse", "--file", "-"), stdin=text, expect=Expect.ENDS)
        for name, text in {
            "escape": f"walk to {NAMES['escape']}\n".encode(),
            "bytes": bytes(range(256)),
            "empty": b"",
        }.items()
    ),
    Case(
        name="repl-every-name",
        argv=("repl", "--fast"),
        stdin="\n".join(f"fly to the {text}" for text in NAMES.values()).encode(),
        expect=Expect.ENDS,
        cpu_s=10,
    ),
    Case(
        name="repl-every-sentence",
        argv=("repl", "--fast"),
        stdin="\n".join(
            f"fly {SENTENCES[name]}" for name in SENTENCES if name.startswith(("digits", "format"))
        ).encode(),
        expect=Expect.ENDS,
        cpu_s=10,
    ),
    Case(
        name="repl-bytes",
        argv=("repl", "--fast"),
        stdin=bytes(range(256)) + b"\n\xff\xfe\n" + b"why\n",
        expect=Expect.ENDS,
    ),
    *(
        Case(
            name=f"repl-command-{name}",
            argv=("repl", "--fast"),
            stdin=line.encode() + b"\n",
            expect=Expect.ENDS,
        )
        for name, line in {
            "inject-nan": "inject push impulse_n_s=nan",
            "inject-digits": f"inject shove strength_n_s={DIGITS}",
            "inject-inf": "inject shove strength_n_s=inf towards_deg=inf",
            "inject-word": "inject shove strength_n_s=abc",
            "inject-list": "inject move target=red_cup by_m=[.nan,0,0]",
            "inject-reduce": "inject __reduce_ex__ target=4",
            "inject-escape": f"inject {NAMES['escape']}",
            "inject-open": "inject push target=[[[[[[",
            "inject-brackets": "inject push target=" + "[" * 5000,
            "goals-digits": f"goals move {DIGITS} 1",
            "goals-escape": f"goals move {NAMES['escape']}",
            "goals-nan": "goals move nan nan",
            "goals-minus": "goals move -1 -2",
            "why-escape": f"why {NAMES['escape']}",
            "dump-outside": "dump @OUTSIDE@/owned.html",
            "break-escape": f"break {NAMES['escape']}",
            "long": "why " * 20_000,
            "cancel-digits": f"cancel {DIGITS}",
            "question": "?" * 10_000,
        }.items()
    ),
    Case(
        name="file-one-line",
        argv=("parse", "--file", "s.txt"),
        files={"s.txt": "a" * 9_000_000 + "\n" + "pick up the " + "b" * 500_000},
        expect=Expect.ENDS,
        most_output=10_000,
    ),
]
test_sentence = exam("sentences", CASES)
