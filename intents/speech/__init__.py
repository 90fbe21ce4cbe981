"""Speech to words and words to speech. What is heard goes to `intents.dialogue` as text.

Like the rest of `intents` it knows no robot: it is given a vocabulary and sound, and returns
values.
"""
