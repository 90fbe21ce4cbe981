"""Words that limit an order: to what, when, how many, how. Without them it is another order.

Whoever passes over words looks here what they must not lose: parentheses
(:mod:`intents.english.clauses.parentheses`), background and plain words
(:mod:`intents.english.learnt`).
"""

from intents.english.words import lexicon
from intents.english.words.measures import NUMBER_WORDS, UNIT_WORDS

CONDITIONS = lexicon.words(
    "if unless until till provided providing assuming except besides otherwise else case event "
    "emergency"
)
"""They make an order one for some cases only."""
TIMES = lexicon.words("before after when whenever once while then later tomorrow tonight overnight")
"""They tell when, and as often why: "after all I have done for you"."""
CALENDAR = lexicon.words(
    "tomorrow tonight overnight o'clock oclock noon midnight midday daily nightly weekly hourly "
    "monday tuesday wednesday thursday friday saturday sunday"
)
"""They tell on what day or at what hour: nothing the robot does waits for that."""
DENIALS = lexicon.words("not no never don't dont without nor neither nothing none nobody")
"""They say what is not to be done, and as often that something is no trouble."""
CHOICES = lexicon.words("either or instead rather but should")
"""They take another order's place."""
QUANTITIES = (
    lexicon.ALL
    | NUMBER_WORDS
    | lexicon.words(
        "only twice thrice each both half dozen couple pair many much more less several few"
    )
)
"""How many, and how often."""
MEASURES = UNIT_WORDS | lexicon.words("minute second hour metre meter degree")
"""How far, and how long."""
SPOTS = lexicon.words(
    "under behind beside between above below near next opposite outside inside outdoors indoors "
    "upstairs downstairs halfway"
)
"""Where, besides the places that have a name."""
