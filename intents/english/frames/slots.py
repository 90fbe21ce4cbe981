"""The complements of a clause, handed out one by one; what no frame asks for is an error."""

from msgspec.structs import replace

from intents.english.phrases.complements import Clause, Complement, first_with
from intents.english.phrases.phrase import Locative, NounPhrase, is_all
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import Misfit, Unclear, listing
from intents.goals import ObjectQuery, Person

_GROUND = ("floor", "ground", "carpet", "deck")


class Slots:
    """The complements of a clause that are still to be understood."""

    def __init__(self, clause: Clause, scope: Scope) -> None:
        self.clause = clause
        self.scope = scope
        self.rest: list[Complement] = list(clause.complements)

    def peek(self, *roles: str) -> Complement | None:
        """The first complement with one of these roles; "" is a bare noun phrase."""
        return first_with(self.rest, *roles)

    def take(self, *roles: str) -> Complement | None:
        """The first complement with one of these roles, which is understood by that."""
        return self._taken(self.peek(*roles))

    def take_where(self) -> Complement | None:
        """A place by what is there: "where the cup is"."""
        return self._taken(next((c for c in self.rest if c.phrases and c.phrase.where), None))

    def take_here(self) -> Complement | None:
        """To where the operator is: "bring it here"."""
        here = (c for c in self.rest if c.phrases and c.phrase.noun == "here")
        return self._taken(next(here, None))

    def take_there(self) -> Complement | None:
        """To the place spoken of: "take me there"."""
        there = (c for c in self.rest if c.phrases and c.role == "" and c.phrase.noun == "there")
        return self._taken(next(there, None))

    def take_person(self, *roles: str) -> Person | None:
        """The first complement with one of these roles that is a person."""
        said = (c for c in self.rest if c.phrases and c.role in roles)
        person = self._taken(next((c for c in said if is_person(c.phrase, self.scope)), None))
        return to_person(person.phrase, self.scope) if person else None

    def _taken(self, complement: Complement | None) -> Complement | None:
        if complement is not None:
            self.rest.remove(complement)
        return complement

    def measure(self, kind: str) -> float | None:
        """The quantity of a kind, in SI."""
        for complement in self.rest:
            if complement.measure and complement.measure.kind == kind:
                self.rest.remove(complement)
                return complement.measure.value
        return None

    def direction(self, *wanted: str) -> str:
        """The first direction said, of those wanted."""
        for complement in self.rest:
            if complement.direction in wanted:
                self.rest.remove(complement)
                return complement.direction or ""
        return ""

    def objects(self, *, spots: bool = False, handled: bool = False) -> list[ObjectQuery]:
        """The bare noun phrases as objects, with "from" and loose places as where they are.

        Of what is ``handled``, "the cups" are all of them.
        """
        bare = self.take("")
        if bare is None:
            return []
        if any(is_person(p, self.scope) for p in bare.phrases):
            raise Misfit(f"“{bare.phrase.said}” is a person")
        plural = bare.phrase.said in ("them", "they", "these", "those", "both")
        if plural and bare.phrase.noun == "pronoun" and len(self.scope.group) > 1:
            return list(self.scope.group)
        found = [to_object(p, self.scope, spots=spots) for p in bare.phrases]
        if handled:
            found = [
                replace(o, count="all") if o.count is None and is_all(p) else o
                for o, p in zip(found, bare.phrases, strict=True)
            ]
        sources = self._sources()
        if len(sources) > 1 and any(o.count != "all" for o in found):
            raise Misfit(f"{_listed(sources)} are several places to take it from")
        return [replace(o, at=o.at or at) for at in sources for o in found] if sources else found

    def source(self) -> str | None:
        """The place after "from".

        Raises:
            Misfit: There are several.
        """
        sources = self._sources()
        if len(sources) > 1:
            raise Misfit(f"{_listed(sources)} are several places")
        return sources[0] if sources else None

    def _sources(self) -> list[str]:
        """The places after "from": the mugs from the table *and the bar* are those of both."""
        source = self.take("from")
        if source and source.phrase.said in _GROUND and not source.phrase.exact:
            return []  # pick it up off the floor
        return [to_place(p, self.scope, objects=True) for p in source.phrases] if source else []

    def loose_place(self) -> str | None:
        """A place that is not attached to a noun: "at the desk, find ..."."""
        at = self.take("at")
        return to_place(at.phrase, self.scope) if at else None

    def persons(self) -> list[Person]:
        """The bare noun phrases as people."""
        bare = self.take("")
        return [to_person(p, self.scope) for p in bare.phrases] if bare else []

    def done(self) -> None:
        """All that was said has been understood.

        Raises:
            Misfit: It has not.
        """
        for complement in self.rest:
            if complement.phrases and complement.phrase.noun != "there":
                said = complement.phrase.said
                raise Misfit(f"I do not see what “{said}” has to do with “{self.clause.verb}”")
            if complement.measure and complement.measure.kind == "plain":
                raise Misfit(f"I do not know what {complement.measure.value:g} counts")
            if complement.measure:
                kind = {"length": "distance", "time": "duration"}.get(
                    complement.measure.kind, complement.measure.kind
                )
                if kind != "times":
                    raise Misfit(f"I do not know what a {kind} means for “{self.clause.verb}”")


def _listed(places: list[str]) -> str:
    return listing([f"the {place}" for place in places], "and")


def detach_place(phrase: NounPhrase) -> Locative | None:
    """Take the last place off a noun phrase: put [the cup] [on the table]."""
    return phrase.places.pop() if phrase.places else None


def need(value: object, question: str) -> None:
    """Ask, where something is missing.

    Raises:
        Unclear: It is.
    """
    if not value:
        raise Unclear(question)
