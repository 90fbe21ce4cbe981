"""What the robot can tell of itself: its state, and small talk."""

from intents.english import lexicon
from intents.english.text import Text
from intents.goals import Goal, Report, ReportTopic, Say

_ABOUT_ROBOT: dict[ReportTopic, str] = {
    "holding": "what are you holding,what do you hold,what do you have in your hand,"
    "what is in your hand,what have you got,what are you carrying,what do you have in your hands,"
    "what are you holding in your hand,what you are holding,what do you carry,"
    "what did you pick up,what is in your gripper,do you have anything in your hand,"
    "are you holding anything,are you holding something,what you have in your hand,"
    "what have you picked up",
    "seeing": "what do you see,what can you see,what are you looking at,what are you seeing,"
    "what is in front of you,what you see,what you can see,what is around you,"
    "what objects do you see,what are you able to see,what objects can you see",
    "location": "where are you,where you are,what is your position,what is your location,"
    "where are you right now,where are you now,your position,your location",
    "status": "what are you doing,what is your status,what are you up to,how is it going,"
    "how far are you,are you done,are you finished,are you ready,what is the status,"
    "what you are doing,what is going on,your status,what are you working on,"
    "what is your current task,are you busy,what are you doing right now,what are you doing now",
    "health": "how are you,how are you doing,are you okay,are you alright,are you all right,"
    "how do you feel,what is your battery level,what is the battery level,battery,"
    "how much battery do you have,is everything okay,is anything wrong,are you healthy,"
    "how is your battery,how is your health,your health,how hot are your motors,"
    "are your motors hot",
    "why": "why did you stop,why did you fail,what went wrong,what happened,why are you stopping,"
    "why did you do that,why did it fail,why have you stopped,why are you not moving,"
    "why did you not do it,why is that,why,why not,why did you drop it,why did you fall,"
    "why did you stop moving,why are you waiting,what is wrong,what is the problem,what was that",
    "capabilities": "who are you,what are you,what can you do,what are you able to do,"
    "what you can do,how can you help,how can you help me,what are your skills,"
    "what do you know how to do,what commands do you know,what can i say,what can i ask you,help,"
    "what can i tell you to do,what do you understand",
}
_TOPICS: dict[lexicon.Phrase, ReportTopic] = {
    phrase: topic for topic, text in _ABOUT_ROBOT.items() for phrase in lexicon.phrases(text)
}
_SMALL_TALK = lexicon.words(
    "what which is it the a an of today tomorrow day time date week month year current now this "
    "joke something funny about yourself your team teams 's name country affiliation leader are "
    "you who me in right be to tell"
)
_SMALL_TALK_HEADS = lexicon.words("time day date joke yourself name affiliation country something")


def about_robot(text: Text, at: int) -> tuple[list[Goal], int] | None:
    """What are you holding? How are you? What can you do?"""
    found = text.lookup(_TOPICS, at)
    if found is None or not (found[1] >= len(text) or not text.word(found[1])[0].isalnum()):
        return None
    goals: list[Goal] = [Report(topic=found[0])]
    return goals, found[1]


def small_talk(text: Text, at: int, end: int) -> Say | None:
    """The time, a joke, something about itself: what the robot can tell without looking."""
    words = text.words[at:end]
    known = bool(words) and all(w in _SMALL_TALK for w in words)
    if known and any(w in _SMALL_TALK_HEADS for w in words):
        return Say(what=text.raw(at, end))
    return None
