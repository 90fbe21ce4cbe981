"""A network that says a sentence again in plain words that the grammar reads.

It is an encoder that read much English before (MiniLM) and a decoder that writes one plain word
after the other, or points at a name or word of the sentence. What it says is no goal: the grammar
reads it, and the law of faithfulness and trust decide whether it is done, asked or dropped.
"""
