"""What can be done and may hurt somebody, or burn: by what is handled, where to, and the words.

A heater goes into no basin, a towel into no oven, a hot iron onto no wig; nothing sharp is thrown,
or handed to a child. Nothing here is refused, for there may be a reason: it is asked about with
the danger named. What is merely risky in itself is read back (:mod:`intents.risks`).
"""

import re
from collections.abc import Callable, Iterable

from intents import goals as g
from intents.english.words.lexer import singular
from intents.english.words.lexicon import words
from intents.goals import Goal, each

_ELECTRIC = words(
    "hairdryer hairdrier dryer drier heater lamp laptop tablet phone smartphone charger toaster "
    "radio speaker lead cable socket straightener straighteners tongs clippers drill television tv "
    "monitor keyboard computer printer console mixer blender fan projector microphone amplifier "
    "battery powerbank router shaver hoover vacuum fire scanner multimeter oscilloscope iron"
)
"""What water makes dangerous, by the last word of its name or its first; no kettle: it is filled
at the sink."""
_NO_DEVICE = words("holder stand case bag box book card bracket screen engine toy")
"""A lamp *stand*, a phone *case*, a *toy* drill, a fire *engine* are none."""
_WET = words(
    "sink basin washbasin bath bathtub tub shower pool pond toilet aquarium bucket washer "
    "dishwasher puddle jacuzzi kettle fountain"
)
_WET_NAMES = ("washing machine", "fish tank", "water butt")
_HOT_PLACES = words(
    "oven stove cooker hob heater microwave toaster grill fireplace fire boiler furnace kiln "
    "hotplate broiler barbecue hairdryer kettle iron burner campfire bonfire lamp"
)
_HOT_ONTO = words("heater burner lamp bonfire campfire hotplate grill barbecue kiln")
"""On these things burn; what is put on an oven or a stove only if that is on."""
_COLD_PLACES = words("fridge freezer extinguisher exit door escape engine alarm station table")
"""What a hot place's name may end with, and then is none: "oven *table*", "fire *exit*"."""
_BURNS = words(
    "towel cloth paper newspaper book magazine letter card envelope blanket duvet coat jacket "
    "shirt scarf hat cap sock jumper hoodie dress gown wig cushion pillow curtain sheet apron "
    "teddy doll hairspray spray aerosol lighter matches matchbox battery rag robe cape surplice "
    "stole cardigan fleece scrubs tie flag napkin tissue notebook folder newsletter sermon form "
    "datasheet diary petrol fuel spirit thinner turpentine isopropanol alcohol balloon"
)
_HOT_TOOLS = words("iron tongs straightener straighteners wand gun hotplate")
_HOT_TOOL_NAMES = ("curling", "soldering", "heat", "glue", "hot", "steam", "clothes", "flat")
_SOFT = words(
    "sofa couch bed armchair cushion wig carpet rug chair beanbag cot pillow mattress duvet "
    "basket hammock settee crib blanket towel curtain bench pram pushchair lap"
)
_SHARP = words(
    "knife scissors blade razor axe hatchet cutter scalpel needle saw machete dagger chisel shears "
    "secateurs spear sword cleaver syringe dart harpoon gaff hook skewer"
)
_CHILDS_PLACES = words("cot crib highchair playpen pram pushchair cradle")
_POISON = words(
    "bleach weedkiller detergent cleaner pellet pellets petrol fuel paint polish acid dye ammonia "
    "antifreeze thinner turpentine liquid poison disinfectant sanitiser sanitizer chemical glue "
    "insecticide pesticide isopropanol varnish"
)
_NOT_FOR_CHILDREN = (
    _SHARP
    | _POISON
    | words(
        "lighter matches matchbox painkiller pill pills tablets medicine insulin syrup beer wine "
        "whisky sherry prosecco vodka gin drill gun kettle iron flare antibiotic tablets"
    )
)
_THROWN = re.compile(r"\b(?:throw|toss|chuck|lob|fling|hurl|sling|hoy|yeet|pitch|catch)\b")
_HEATED = re.compile(
    r"\b(?:hot|boiling|burning|scalding|sizzling|red[- ]hot|glowing|lit|aflame|on fire|steaming)\b"
    r"(?! (?:chocolate|water bottle|dog|sauce|cross|pot)\b)"
)
_NOT_HOT = re.compile(r"\b(?:not|no longer|isn['’]t|too|so|am|i['’]m|it['’]s) (?:too |so )?hot\b")
_IN_WATER = re.compile(
    r"\b(?:i['’]m|i am|he['’]s|she['’]s|is|are|am|we['’]re) (?:still |sitting |lying )?in "
    r"(?:the |a |my )?(?:bath|tub|bathtub|shower|pool|water)\b|\bbath ?water\b|"
    r"\b(?:in|into) (?:the |my |his |her |our )?(?:bath|tub|bathtub|shower|pool|pond)\b(?! towel)"
)
_HARMS = (
    r"(?:hit|hurt|harm|stab|kill|poison|choke|strangle|electrocute|drown|suffocate|smother|burn|"
    r"trip|attack|fight|threaten|scare|shoot|whack|beat|punch|blind|injure|scald|cut)"
)
_FOR_HARM = re.compile(
    rf"\b(?:so (?:that )?(?:i|he|she|they|we|it|you) (?:can|will|could|may)|in order to|wants? to|"
    rf"going to|gonna|(?<!not )to|and then|he['’]ll|she['’]ll|i['’]ll|will)\s+{_HARMS}\s+"
    r"(?:him|her|them|me|myself|himself|herself|us|you|somebody|someone|everybody|people|my "
    r"(?:brother|sister|wife|husband|boss)|the (?:boy|girl|cat|dog|man|woman|child|kid|baby)|"
    r"(?-i:[A-Z])\w+)",
    re.IGNORECASE,
)
_HARM_COMES = re.compile(
    r"\bso (?:that )?(?:\w+ ){1,3}(?:trips?|falls?|slips?|burns?|gets? (?:hurt|burnt|shocked)|"
    r"chokes?|drowns?|dies?)\b(?! asleep)|\b(?:be|get) (?:done|it over) (?:with )?(?:the )?"
    r"(?:quick|easy|fast)(?: way)?\b|\b(?:end (?:it all|my life)|want to die|kill myself)\b"
)
_NOBODY_THERE = re.compile(
    r"\b(?:all night|overnight|till morning|until morning|while (?:i|we|everyone|everybody) "
    r"(?:am|are|is)? ?(?:out|away|asleep|sleep)|while (?:i|we)['’](?:m|re) (?:out|away|asleep)|"
    r"and go (?:out|to bed)|nobody (?:will|is|watches))\b"
)
_DRUNK = re.compile(r"\b(?:to drink|drinks? (?:it|some|that)|to eat|eats? it|swallow|thirsty)\b")
_CHILD = re.compile(
    r"\b(?:child|children|kid|kids|toddler|baby|infant|little (?:boy|girl|one|lad|lass)|"
    r"schoolboy|schoolgirl)\b|\b(?:who|he|she|who['’]s|he['’]s|she['’]s|is)\s+(?:is |only |just |"
    r"aged )*(?:one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|[1-9]|1[0-2])\b"
    r"(?!\s*(?:o['’]clock|minutes?|metres?|meters?|of|in|am|pm|floors?|:))"
)
_IS_ON = re.compile(
    r"\b(?:turn|switch|put|leave) (?:\w+ ){1,4}on\b(?! (?:the|a|an|my|your|his|her|it|top)\b)|"
    r"\b(?:it['’]?s|is|still) (?:on|lit|hot|going)\b|\blit\b"
)
_INSIDE = "in "
_WATER, _FIRE = "water and electricity", "it may burn"


_FUMES = re.compile(
    r"\b(?:oxygen|gas (?:leak|smell|bottle|cylinder|canister)|smell(?:s)? (?:of )?gas|leaking gas|"
    r"petrol|fumes|fuel|flammable|thinners?)\b"
)
_LIGHTS = words("lighter match matches matchbox candle flare cigarette firelighter")
_MAINS = re.compile(
    r"\b(?:plug ?hole|(?:wall |power |electric(?:al)? )?(?:socket|outlet)s?|mains)\b"
)


def peril(text: str, goals: Iterable[Goal]) -> str:
    """What is dangerous about goals, in words; empty if nothing is.

    Args:
        text: What was said: what for, how, and in what state things are, no goal says.
        goals: What it was read as.
    """
    every = list(each(tuple(goals)))
    handled = [goal for goal in every if isinstance(goal, g.Place | g.Bring | g.Give | g.Pick)]
    said = text.lower()
    if handled and (_FOR_HARM.search(text) or _HARM_COMES.search(said)):
        return "somebody may be hurt"
    for goal in handled:
        thing, where = _thing(goal), _where(goal)
        for sense in _SENSES:
            danger = sense(said, thing, where)
            if danger:
                return danger
    heats = (x for x in every if isinstance(x, g.Switch) and x.on and _words(x.what) & _HOT_PLACES)
    return _FIRE if any(heats) and _NOBODY_THERE.search(said) else ""


def _electric(said: str, thing: str, where: str) -> str:
    devices = _ends(thing) & _ELECTRIC and not _words(thing) & _NO_DEVICE
    name = where.removeprefix(_INSIDE)
    wet = _ends(name) & _WET or name in _WET_NAMES or _IN_WATER.search(said)
    return _WATER if devices and wet else ""


def _burning(said: str, thing: str, where: str) -> str:
    """A towel in the oven, or on the heater; a telephone in the oven."""
    inside, name = where.startswith(_INSIDE), where.removeprefix(_INSIDE)
    burns = _words(thing) & _BURNS or (inside and _words(thing) & _ELECTRIC and "stove" not in name)
    burns = burns and not _words(thing) & words("tin glass metal")
    hot = _words(name) & (_HOT_PLACES if inside or _IS_ON.search(said) else _HOT_ONTO)
    return _FIRE if burns and hot and not _words(name) & _COLD_PLACES else ""


def _hot(said: str, thing: str, where: str) -> str:
    tool = _ends(thing) & _HOT_TOOLS and any(one in thing for one in _HOT_TOOL_NAMES)
    heated = _HEATED.search(said) and not _NOT_HOT.search(said)
    heated = heated and not _HEATED.search(thing)
    soft = _words(where) & (_SOFT | _BURNS)
    return _FIRE if (tool or heated) and soft else ""


def _sharp(said: str, thing: str, where: str) -> str:
    if not _words(thing) & _SHARP:
        return ""
    if _THROWN.search(said):
        return "it is sharp, and I throw nothing"
    return "it is sharp" if _ends(where) & _CHILDS_PLACES else ""


def _mains(said: str, thing: str, where: str) -> str:
    """A screwdriver in the socket; a lighter where there is gas."""
    if where and _MAINS.search(said) and not _words(thing) & words("plug charger lead cable"):
        return "there is electricity in it"
    fumes = _FUMES.search(said) and not _FUMES.search(thing)
    return _FIRE if fumes and _words(thing) & _LIGHTS else ""


def _swallowed(said: str, thing: str, _: str) -> str:
    poison = _words(thing) & _POISON
    return "nobody should swallow it" if poison and _DRUNK.search(said) else ""


def _for_a_child(said: str, thing: str, where: str) -> str:
    given = not where and _words(thing) & _NOT_FOR_CHILDREN
    return "it is nothing for a child" if given and _CHILD.search(said) else ""


_SENSES: tuple[Callable[[str, str, str], str], ...] = (
    _electric, _mains, _burning, _hot, _sharp, _swallowed, _for_a_child,
)  # fmt: skip


def _thing(goal: g.Place | g.Bring | g.Give | g.Pick) -> str:
    """What is handled, in lower case."""
    return (goal.object.name or goal.object.category or "").lower()


def _where(goal: Goal) -> str:
    """Where it is put, in lower case, as "in" or not; empty if it is handed to somebody."""
    match goal:
        case g.Place():
            return f"{_INSIDE}{goal.in_}".lower() if goal.in_ else (goal.on or "").lower()
        case g.Bring(to=str(place)):
            return place.lower()
        case _:
            return ""


def _words(name: str) -> set[str]:
    return {one for word in re.split(r"[\s-]+", name) for one in (word, singular(word)) if one}


def _ends(name: str) -> set[str]:
    """The last word of a name, and the first: "heater", "radio alarm"."""
    said = name.split()
    return _words(" ".join(said[-1:])) | _words(" ".join(said[:1]))
