"""Words to goals: what was said becomes typed goals, a question, or a refusal.

The package knows no robot and no simulator; it is given a :class:`~intents.vocabulary.Vocabulary`
and returns values.
"""
