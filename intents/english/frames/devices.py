"""Opening, closing and switching."""

from intents.english.frames.slots import Slots
from intents.english.phrases.complements import Clause, Complement
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope
from intents.english.trouble import Misfit, NotUnderstood, Unclear, listing
from intents.english.words.lexer import singular
from intents.english.words.lexicon import words
from intents.goals import Bring, Close, ForEach, Goal, Open, Place, Switch
from intents.numbers import plural

_OPENABLE = words(
    "door drawer fridge refrigerator freezer cabinet cupboard window hand gripper box bottle jar "
    "lid curtain blind gate microwave oven dishwasher closet wardrobe tap bag suitcase case "
    "shutter "
    "hands fingers locker container envelope can book machine valve faucet"
)
_SWITCHABLE = words(
    "light lamp tv television machine fan heater heating oven stove computer pc laptop "
    "cleaner "
    "vacuum kettle microwave dishwasher socket plug screen monitor projector hob boiler washer "
    "dryer toaster device chandelier"
)
_ONLY_SWITCHED = words("light lamp tv television telly fan heater radio stereo speaker projector")
_WINDOWS = words("skylight fanlight daylight")
"""These are opened and closed, unlike a floodlight."""
_APPLIANCES = _SWITCHABLE | words("radio stereo speaker printer blender mixer console")
"""What is a device where a world has it; not all of them are in every home."""


def _what(said: Complement, scope: Scope, generic: frozenset[str], act: str) -> list[str]:
    """The names of what is meant: of the vocabulary, or something any home may have."""
    names: list[str] = []
    for phrase in said.phrases:
        if phrase.noun == "pronoun":
            names.append(_spoken_of(phrase, scope, generic, act))
            continue
        name = phrase.name("object", "place", "room")
        head = singular(phrase.said.split()[-1]) if phrase.said else ""
        last = scope.last
        if phrase.said in ("door", "lid", "drawer") and isinstance(last, Place) and last.in_:
            names.append(last.in_)  # put the milk in the fridge and shut the door
            continue
        if phrase.count == "all" and act != "switch":
            names += _every(phrase, head, act)
        elif name and (phrase.exact or _is_only(phrase, head, generic)):
            names.append(name)
        elif head in generic:
            room = next((p.of.name("room") for p in phrase.places if p.of.name("room")), "")
            words_said = phrase.said.split()
            whole = " ".join([*words_said[:-1], head]) if head else phrase.said
            whole = f"{phrase.level} {whole}".strip()
            whole = f"{room} {whole}" if room and room not in whole else whole
            names.append(whole if phrase.noun != "body" else head)
        else:
            raise NotUnderstood(f"I cannot {act} “{phrase.said}”")
    return names


def _every(phrase: NounPhrase, head: str, act: str) -> list[str]:
    """Every door: all that end with that, or are of that name.

    Raises:
        Unclear: None is known by name.
    """
    known = phrase.all_names("object", "place", "room")
    every = [name for name in known if singular(name.split()[-1].lower()) == head]
    if not every:
        raise Unclear(f"Which {plural(head or phrase.said)} shall I {act}? I know none by name.")
    return every


def _spoken_of(phrase: NounPhrase, scope: Scope, generic: frozenset[str], act: str) -> str:
    """What "it" is: of what was spoken of last, that which is opened, closed or switched.

    Raises:
        Unclear: Nothing is, or two things may be meant.
    """
    thing, last = scope.object.name if scope.object else None, scope.last
    filled = last.in_ if act != "switch" and isinstance(last, Place) else None
    apart = (thing,) if phrase.said in ("them", "they") else (filled, thing, scope.place)
    known = [name for name in (scope.device, *apart) if name]
    fits = next((name for name in known if singular(name.split()[-1].lower()) in generic), filled)
    moved = isinstance(last, Place | Bring | ForEach) and scope.device is None
    if fits is None and moved and len(known) > 1:
        either = tuple(dict.fromkeys(known))
        raise Unclear(f"What shall I {act}, the {listing(either)}?", either, phrase.said)
    if not known:
        raise Unclear(f"What shall I {act}?")
    return fits or known[0]


def _is_only(phrase: NounPhrase, head: str, generic: frozenset[str]) -> bool:
    """Whether there is one device of that name: "the lamp" is the desk lamp."""
    names = phrase.all_names("object", "place", "room")
    return len(names) == 1 and names[0].split()[-1] == head and head in generic


def _is_appliance(phrase: NounPhrase) -> bool:
    """Whether what is named is of a kind that is switched; "it" may be."""
    named = phrase.name("object", "place") or phrase.said
    heads = {singular(one.split()[-1].lower()) for one in (named, phrase.said) if one}
    return phrase.noun == "pronoun" or not heads.isdisjoint(_APPLIANCES)


_LOUD = words("tv television telly radio music stereo speaker heater heating thermostat")
"""What is turned down without being turned off."""


def device_names(said: Complement, scope: Scope, act: str) -> list[str]:
    """What is to be opened, closed or switched.

    Raises:
        ReadingError: That cannot be done with it.
    """
    return _what(said, scope, _SWITCHABLE if act == "switch" else _OPENABLE, act)


def is_device(goal: Goal) -> bool:
    """Whether what is switched is of a kind that is switched."""
    return isinstance(goal, Switch) and singular(goal.what.split()[-1]) in _APPLIANCES


def open_(clause: Clause, scope: Scope) -> list[Goal]:
    """Open the fridge; open your hand."""
    names = _opened(clause, scope, "open")
    return [Switch(what=w, on=True) if _only_switched(w) else Open(what=w) for w in names]


def close(clause: Clause, scope: Scope) -> list[Goal]:
    """Close the drawer."""
    names = _opened(clause, scope, "close")
    return [Switch(what=w, on=False) if _only_switched(w) else Close(what=w) for w in names]


def _only_switched(name: str) -> bool:
    """Close *the radio*; open *the lamp*: what has no lid or door is switched, as learners say."""
    head = singular(name.rsplit(maxsplit=1)[-1].lower())
    return head in _ONLY_SWITCHED or (head.endswith("light") and head not in _WINDOWS)


def _opened(clause: Clause, scope: Scope, act: str) -> list[str]:
    slots = Slots(clause, scope)
    if clause.particles() & {"on", "off"}:
        raise Misfit("that is to switch something")
    said = slots.take("")
    if said is None:
        raise Unclear(f"What shall I {act}?")
    slots.take_person("for")
    slots.rest = [c for c in slots.rest if not (c.how == "behind" and c.phrases)]
    slots.done()
    return _what(said, scope, _OPENABLE, act)


def switch(clause: Clause, scope: Scope) -> list[Goal]:
    """Turn on the lamp; switch the washing machine off."""
    slots = Slots(clause, scope)
    said = slots.take("", "at")
    particles = clause.particles() | set(clause.verb.split())
    on = bool(particles & {"on", "up", "activate", "enable", "start", "light"})
    off = bool(particles & {"off", "down", "out", "deactivate", "disable", "kill", "extinguish"})
    if said is not None and said.role == "at":
        on, off = said.how == "on", False
    if clause.verb == "turn" and "up" in particles:
        raise Misfit("I can switch it on or off, not up")
    loud = said is not None and bool(_LOUD.intersection(said.phrase.said.split()))
    if loud and "down" in particles and clause.verb.startswith("turn"):
        raise NotUnderstood("I can switch it on or off, not down")
    if on == off:
        raise Misfit("on or off?")
    if said is not None and "down" in particles and not _is_appliance(said.phrase):
        raise NotUnderstood(f"I cannot turn down “{said.phrase.said}”")
    if (
        clause.verb in ("light", "put", "put on", "put off")
        and said
        and not _is_appliance(said.phrase)
    ):
        raise NotUnderstood(f"I cannot switch “{said.phrase.said}”")
    if said is None and not particles & {"on", "off"}:
        raise Misfit("switch what?")
    if said is None:
        raise Unclear(f"What shall I switch {'on' if on else 'off'}?")
    slots.direction("up", "down")
    slots.take_person("for")
    slots.done()
    return [Switch(what=w, on=on) for w in _what(said, scope, _SWITCHABLE, "switch")]
