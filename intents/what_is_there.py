"""Goals held against what is known to be there: which is meant, and whether there is any."""

from msgspec.structs import replace

from intents.allowed import excess
from intents.context import Context
from intents.english.substitution import substitute
from intents.english.trouble import listing
from intents.english.words import lexicon
from intents.english.words.lexer import singular, tokenize
from intents.goals import Cancel, Goal, ObjectQuery
from intents.grounding import (
    Ambiguous,
    Entity,
    Unknown,
    by_where,
    describe_entity,
    ground,
    narrowed,
    queries,
)
from intents.outcomes import Choice, Goals, Outcome, Question, Refusal
from intents.wording import sentence_case

_ONE_OF = lexicon.words("one a an any either which")


def of_what_is_there(text: str, goals: tuple[Goal, ...], context: Context) -> Outcome:
    """Ask which is meant, or refuse what is not there, where it is known what is there."""
    too_much = excess(goals)
    if too_much:
        return Refusal(reason=f"{sentence_case(too_much)}.")
    if not context.entities or any(isinstance(g, Cancel) for g in goals):
        return Goals(goals=goals)
    by_id = {e.id: e for e in context.entities}
    for query in queries(goals):
        found = ground(query, context.entities, view=context.view)
        if isinstance(found, Unknown):
            return Refusal(reason=f"{sentence_case(found.reason)}.")
        if isinstance(found, Ambiguous) and (short := _too_few(query, found, by_id)):
            return Refusal(reason=short)
        if isinstance(found, Ambiguous) and _several(text, query):
            goals = tuple(substitute(goal, query, replace(query, count="all")) for goal in goals)
        elif isinstance(found, Ambiguous) and by_where(query) and _unseen(found, by_id):
            continue  # whoever goes and looks will know
        elif isinstance(found, Ambiguous):
            choices = tuple(
                Choice(label=label, query=narrowed(query, by_id[i]))
                for label, i in zip(found.labels, found.candidates, strict=True)
            )
            return Question(
                question=found.question, choices=choices, goals=goals, about=query, text=text,
                kind="choice",
            )  # fmt: skip
    return Goals(goals=goals)


def _too_few(query: ObjectQuery, found: Ambiguous, by_id: dict[str, Entity]) -> str:
    """That there are not so many as are asked for; empty if there are, or that is not known."""
    number = len(found.candidates)
    if not isinstance(query.count, int) or query.count <= number:
        return ""
    named = [f"a {describe_entity(by_id[i])}" for i in found.candidates]
    return f"There are only {number} of them, not {query.count}: {listing(named, 'and')}."


def _unseen(found: Ambiguous, by_id: dict[str, Entity]) -> bool:
    """Whether it is not known of all that may be meant where they are."""
    return not all(by_id[i].p_WO or by_id[i].held for i in found.candidates)


def _several(text: str, query: ObjectQuery) -> bool:
    """Whether a description was said in the plural: "the cups", not "one of the cups"."""
    noun = query.name or query.category
    if query.count is not None or not noun:
        return False
    said = [token.text for token in tokenize(text)]
    plural = [word for word in said if word != singular(word)]
    return not _ONE_OF.intersection(said) and noun.split()[-1] in map(singular, plural)
