"""The closed classes of English words that the grammar knows. Data only."""

from typing import Literal, TypeVar

from intents.goals import How, Superlative

Phrase = tuple[str, ...]
T = TypeVar("T")


LISTED: set[str] = set()
"""Every word of every list that is made by the functions below: what the grammar knows."""


def words(text: str) -> frozenset[str]:
    """The words of a text."""
    listed = frozenset(text.split())
    LISTED.update(listed)
    return listed


def unlisted(text: str) -> frozenset[str]:
    """The words of a text that the grammar does not get to know by that.

    For what says nothing in one place ("*sweet*, bring it") and something in another.
    """
    return frozenset(text.split())


def phrases(text: str) -> frozenset[Phrase]:
    """The phrases of a text, which stand between commas."""
    listed = frozenset(tuple(phrase.split()) for phrase in text.split(","))
    LISTED.update(word for phrase in listed for word in phrase)
    return listed


def _meanings(table: dict[T, str]) -> dict[Phrase, T]:
    """From meaning to its spellings, turned round."""
    return {phrase: meaning for meaning, text in table.items() for phrase in phrases(text)}


DETERMINERS = words(
    "the a an my your our his her their its this that these those some any another either"
)
ALL = words("all every each both")

COLORS = {
    w: w
    for w in words(
        "red green blue yellow orange black white gray brown pink purple violet turquoise silver "
        "golden beige cyan magenta transparent"
    )
} | {
    "grey": "gray",
    "gold": "golden",
    "crimson": "red",
    "scarlet": "red",
    "navy": "blue",
}

SIZES = {
    "big": "big", "large": "big", "huge": "big", "bigger": "big", "larger": "big",
    "giant": "big", "enormous": "big", "massive": "big", "gigantic": "big",
    "wee": "small", "small": "small", "little": "small", "tiny": "small", "smaller": "small",
    "mini": "small",
    "miniature": "small", "weighty": "heavy", "slim": "thin", "slender": "thin",
    "skinny": "thin", "narrow": "thin",
    "tall": "tall", "short": "short", "heavy": "heavy", "light": "light", "medium": "medium",
    "thin": "thin", "thick": "thick", "long": "long", "wide": "wide",
}  # fmt: skip

SUPERLATIVES: dict[tuple[str, ...], Superlative] = _meanings(
    {
        "largest": "largest,biggest,most large,most big,greatest,most massive,hugest,most huge,"
        "bulkiest,most voluminous",
        "smallest": "smallest,most small,most little,most tiny,tiniest,littlest,least big,"
        "most miniature,most minuscule,teeniest,least large,most compact",
        "heaviest": "heaviest,most heavy,weightiest,most weighty",
        "lightest": "lightest,least heavy,most light,flimsiest,most lightweight,least weighty",
        "thinnest": "thinnest,slimmest,narrowest,skinniest,finest,most thin,"
        "most slender,slenderest,least thick,most narrow",
        "thickest": "thickest,widest,fattest,broadest,most thick,least thin",
        "tallest": "tallest,longest",
        "shortest": "shortest",
        "leftmost": "leftmost,left most,most left,furthest left,farthest left,far left,"
        "furthest to the left,farthest to the left,most to the left,far to the left",
        "rightmost": "rightmost,right most,most right,furthest right,farthest right,far right,"
        "furthest to the right,farthest to the right,most to the right,far to the right",
        "nearest": "nearest,closest",
        "farthest": "farthest,furthest,most distant",
        "highest": "highest,topmost,uppermost",
        "lowest": "lowest,bottommost",
        "oldest": "oldest,eldest",
        "youngest": "youngest",
    }
)

COMPARATIVES: dict[str, Superlative] = {
    "bigger": "largest", "larger": "largest", "smaller": "smallest", "heavier": "heaviest",
    "lighter": "lightest", "thinner": "thinnest", "thicker": "thickest", "taller": "tallest",
    "shorter": "shortest", "longer": "tallest", "nearer": "nearest", "closer": "nearest",
    "higher": "highest", "lower": "lowest", "older": "oldest", "younger": "youngest",
}  # fmt: skip
"""Of two, the bigger one is the largest."""
GENDERS: dict[str, Literal["male", "female"]] = {
    "man": "male", "boy": "male", "guy": "male", "gentleman": "male", "male": "male",
    "men": "male", "boys": "male", "guys": "male", "gentlemen": "male", "males": "male",
    "lad": "male", "dude": "male", "fella": "male", "fellow": "male", "bloke": "male",
    "chap": "male", "gent": "male", "lads": "male", "blokes": "male", "lass": "female",
    "lassie": "female", "gal": "female", "senora": "female", "woman": "female", "girl": "female",
    "lady": "female", "female": "female", "women": "female", "girls": "female", "ladies": "female",
    "females": "female",
}  # fmt: skip
PERSON_NOUNS = words(
    "person people peoples peeps persons someone somebody anyone anybody everyone "
    "everybody individual "
    "individuals human humans guest guests visitor visitors child children kid kids elder elders "
    "adult adults customer customers friend friends folk folks colleague colleagues stranger "
    "strangers passenger passengers patient patients resident residents"
)
PUTTING = words("put place leave set lay stow store stand drop dump stash stick shove")
"""Behind one of these and a thing it is told where the thing is to go."""
EVERYONE = words("everyone everybody")
OPERATOR_WORDS = words("me us myself operator i ourselves")
OBJECT_NOUNS = words(
    "object objects thing things item items article articles something anything stuff everything "
    "product products"
)
ONES = words("one ones")
CONTAINERS = words(
    "can bottle box pack packet bag carton jar tin glass cup bowl plate piece slice bar tube "
    "package container drop sup splash dash mouthful pile bunch stack pair bit roll pot set"
)
"""Nouns that measure out something else: "a bottle of water", "a coke can"."""
PLACE_NOUNS = words("place spot location position area room")
PRONOUNS = words("it them they he she him her this that these those")
BODY_NOUNS = words(
    "leg legs foot feet arm arms hand hands head knee knees body gripper grippers finger fingers "
    "mouth eyes"
)
EMPTY_ADJECTIVES = words(
    "nice good fresh clean dirty empty full new old same other certain single whole entire "
    "favorite favourite plastic wooden metal glass paper beautiful lovely cold hot warm cool "
    "delicious particular exact desired specific required corresponding main respective nearby "
    "available remaining"
)
POSTURES: dict[tuple[str, ...], Literal["sitting", "standing", "lying"]] = _meanings(
    {
        "sitting": "sitting down,sitting,seated,sits,sit",
        "standing": "standing up,standing,stands,stood,upright",
        "lying": "resting,lying down,laying down,lying,laying,lies,sleeping,asleep,reclining",
    }
)
CLOTHES = words(
    "shirt tshirt blouse sweater pullover jacket coat hoodie hat cap dress skirt pants trousers "
    "jeans shorts shoe boot scarf vest suit tie glove sock cardigan jumper top polo uniform "
    "glasses"
)

LOCATIVES: dict[tuple[str, ...], How | None] = _meanings(
    {
        "on": "on,on or in,on and in,in or on,in and on,on or at,on top of,upon,atop,atop of",
        "in": "in,right in,out in,down in,inside,inside of,within",
        None: "at,right at,just at,around,up at,over at,over in,over on,over by,up on,in at",
        "near": "near,next to,close to,by,beside,besides,alongside,nearby,near to,"
        "at the side of,"
        "in the vicinity of,against",
        "under": "under,underneath,below,beneath,from under,from underneath,"
        "from below,from beneath,at the bottom of",
        "above": "above,over",
        "behind": "behind,from behind,at the back of,in back of",
        "in_front": "in front of,before,opposite,opposite of,across from",
        "left": "left of,left to,to the left of,at the left of,on the left of,"
        "at the left side of,on the left side of,to the left side of,left from",
        "right": "right of,right to,to the right of,at the right of,on the right of,"
        "at the right side of,on the right side of,to the right side of,right from",
        "between": "between,in between",
    }
)
LOCATIVES.update(
    {
        (stress, *phrase): how
        for phrase, how in LOCATIVES.items()
        for stress in ("right", "just", "directly", "immediately", "close", "closely", "straight")
        if how in ("near", "under", "behind", "above", "in_front", "between")
    }
)
LOCATIVES.update({("somewhere", *phrase): how for phrase, how in LOCATIVES.items()})
"""Prepositions that say where something is; None says no more than "at"."""
GOALWARDS = phrases(
    "to,into,onto,towards,toward,in to,on to,over to,back to,up to,down to,all the way to,until,"
    "back into,back onto,back in,back on,over into,"
    "round to,through to,across to,along to,on over to,out to,over into,down into,up into"
) | {
    ("until", subject, *arrived.split())
    for subjects, how in (
        ("he she", "reaches,gets to,arrives at,comes to,is in,is at,is by,is near,is next to"),
        ("you they", "reach,get to,arrive at,come to,are in,are at,are by,are near,are next to"),
    )
    for subject in subjects.split()
    for arrived in how.split(",")
}
SOURCEWARDS = phrases(
    "from,out of,off,off of,from inside,from off,out from,from on,from in,from out of,from within,"
    "from the top of,from on top of,away from"
)
OTHER_PREPOSITIONS = phrases("for,with,of,about,through,along,past,after,regarding,via,without")

CONNECTORS = phrases(
    "and then,and after that,and afterwards,and also,and finally,and next,then,and,after that,"
    "afterwards,after which,finally,also,next,plus,but,so,lastly,secondly,thirdly,firstly,first,"
    "first of all,second,third,once you are done,when you are done,when done,"
    "once you have done that,when you have it,once you have it,as well as,subsequently,after this,"
    "in the end,thereafter,later,once done,when finished,once there,when there,when you get there,"
    "once you get there,once you are there,when you arrive,while,where you will,where you can,"
    "where you should,when you are there,in order to,so that you can,or"
)
FILLERS = phrases(
    "please,kindly,thank you very much,thank you,thanks,many thanks,um,uh,uhm,er,erm,hmm,hm,"
    "carefully,gently,quickly,slowly,immediately,right now,right away,at once,straight away,"
    "as soon as possible,asap,if you can,if possible,if you please,if you could,if you do not mind,"
    "if you would,possibly,perhaps,dear robot,mister robot,mr robot,robot,hey robot,robot listen,"
    "listen robot,kind sir,would you be so kind,would you kindly,would you be so kind as to,"
    "for a moment please,safely,my friend,when you can,whenever you can,when you get a chance,"
    "when you have time,my dear,basically,actually,kinda,sort of,now,for now,one after the other,"
    "one after another,one by one,one at a time,in turn,by name,do it slowly,do it quickly,"
    "do it carefully,do so slowly,do so quickly,do so carefully,one more thing,real quick,for real,"
    "if it is no trouble,if it is not too much trouble,maybe,fast,mate,buddy,pal,bro,pretty,"
    "with sugar on top,with a cherry on top,i was thinking,i was wondering,i think,i guess,"
    "if you have understood,if you have understood me,if you understood,if you understood me,"
    "if you understood that,if you understand that,if you heard me,if you heard that,"
    "if you have heard me,if you get me,if you got that,if you get what i mean,if you follow me,"
    "if you understand,if you understand me,if you hear me,if you can hear me,if you are ready,"
    "if you have time,if you have a minute,when you have a minute,while you are at it,"
    "if it is not too much bother,if it is not too much to ask,if that is okay,"
    "if that is all right,if it is okay,if you like,if you want,if you wish,whenever you are ready,"
    "when you are ready,whenever you like,wherever she goes,wherever he goes,wherever they go,"
    "at the moment,at this moment,at present,for the moment,properly,neatly,nicely,tidily,"
    "high and low,far and wide,by any chance,perchance,by some chance,by some miracle,"
    "by a miracle,by some stroke of luck,"
    "with any luck,with a bit of luck,at your earliest convenience,at your convenience,"
    "at your leisure,in your own time,in your own good time,for the record,for the love of god,"
    "for the love of mike,for the avoidance of doubt,"
    "mind you,on your way back,on the way back,on your way past,"
    "on your way,wherever i go,everywhere she goes,everywhere he goes,everywhere i go,"
    "see if you can,"
    "see whether you can,go see if you can,check if you can,while you are up,while you are there,"
    "while you are here,while you are out,while you are passing,after all,"
    "on your way out,on your way there,"
    "now that i think of it,now that i think about it,"
    "as fast as you can,as quick as you can,as quickly as you can,"
    "forthwith,this second,this instant,at the double,on the double,stat,pronto,sharpish,urgently,"
    "quick quick,quick smart,double quick,in a jiffy,without delay,"
    "as fast as possible,as quickly as possible,quick as you can,"
    "and nobody else,and no one else,and to nobody else,and to no one else,and not to anybody else,"
    "and not to anyone else,and no other person,and to no other person,and nowhere else,"
    "and nothing else"
) | {(",", "like", ",")}
"""Words that can be dropped wherever they stand."""
_OPENINGS = phrases(
    "would you ever,will you ever,could you ever,can you ever,"
    "can somebody,can someone,could somebody,could someone,can anyone,could anyone,would someone,"
    "would somebody,can you,could you,would you,will you,can you please,would you mind,do you mind,"
    "would you be able to,are you able to,is it possible for you to,is it possible to,"
    "would it be possible to,would it be possible for you to,i want you to,i would like you to,"
    "i need you to,i would love you to,i would love for you to,i would like for you to,"
    "i would appreciate it if you could,i would appreciate it if you,i want to,you should,"
    "you must,you have to,you need to,you can,you could,you may,you are to,you will,"
    "you are supposed to,i ask you to,i am asking you to,i command you to,i order you to,"
    "your task is to,your job is to,your mission is to,your goal is to,go ahead and,"
    "go on ahead and,go right ahead and,"
    "would you be a dear and,be a dear and,would you be so good as to,be so good as to,"
    "be a good robot and,would you be so kind and,would you be kind enough to,be kind enough to,"
    "be so kind as to,be so kind and,do me a favor and,give me a hand and,"
    "lend me a hand and,give us a hand and,help me,why do not you,why not,"
    "do me a favour and,would you like to,do you think you can,do you think you could,"
    "let us,hey,hi,hello,okay,alright,all right,well,now,just,try to,"
    "hi there,hello there,hey there,good morning,good evening,good afternoon,good day,start to,"
    "begin to,make sure to,make sure you,be sure to,remember to,do not forget to,you,to,"
    "listen up,look here,excuse me,pardon me,forgive me,do forgive me,i beg your pardon,sorry,"
    "oh,yes,no,yeah,so,ready,help me to,help me and,may you,"
    "might you,shall you,attempt to,i wish you to,i wish for you to,your next task is to,"
    "the task is to,it is time to,time to,i said,it would be nice if you could,"
    "it would be great if you could,could i ask you to,may i ask you to,can i ask you to,please,"
    "proceed to,directly,there,with your left hand,with your right hand,using your left hand,"
    "using your right hand,use your left hand to,use your right hand to,use your left arm to,"
    "use your right arm to,use your hand to,use your hands to,use both hands to,yo,listen,"
    "right then,would it be okay if you,would it be all right if you,"
    "it would be great if you,it would be nice if you,it would be lovely if you,"
    "it would be good if you,i would be grateful if you,i would be glad if you,"
    "i would be happy if you,i would appreciate it if you would,i would like it if you,"
    "i would love it if you,i would be grateful if you could,i would be grateful if you would,"
    "i would be glad if you could,evening,morning,hiya,howdy,greetings,nice to meet you,"
    "pleased to meet you,nice to see you,i want that you,i would like that you,fancy,how about,"
    "what about,try and,i wonder if you could,i wonder if you can,if you could,"
    "what i want is for you to,what i need is for you to,i want to see you,let us see you,"
    "let me see you,i would like to see you,i would love to see you,mind,i would be grateful,"
    "i would be glad,i would be happy,it would be great,it would be nice,it would be lovely,"
    "i would appreciate it,i do not suppose you could,i suppose you could,i reckon you could,"
    "i reckon you ought to,i reckon you should,you ought to,you might want to,could not you,"
    "can not you,would not you,make yourself useful and,you know what,tell you what,"
    "i tell you what,i need that you,"
    "i need you,i want you,would it be asking too much for you to,would it be asking too much for,"
    "would it be too much to ask for,would it be too much to ask for you to,"
    "would it be asking too much to,"
    "i do hope i am not disturbing,i hope i am not disturbing,i do hope i am not disturbing you,"
    "i hope i am not disturbing you,i do hope i am not being a nuisance,"
    "i hope i am not being a nuisance,good evening to you,good morning to you,"
    "good afternoon to you,good day to you,will you not,pray,i pray you,do one thing,"
    "one thing you do,go on and,i beg you to,i beg of you to,i must ask you to,"
    "i have to ask you to,i shall ask you to,i am going to ask you to,please to,do,"
    "i would have you,you do one thing,it is possible to,is possible to,is possible,is it possible,"
    "it is possible that you,it is possible for you to,you are going to want to,you will want to,"
    "want to,be good enough to,be decent enough to,you are requested to,you are asked to,"
    "you are instructed to,you are ordered to,you are invited to,you are told to,"
    "away and,away with you and,och,ach,aye,ooh,gosh,blimey,crikey,golly,wow,righto,rightio,"
    "you want to,be so very kind as to,be so very good as to,be so nice as to,be so good and,"
    "i wish that you would,i want for you to,you shall,might i prevail upon you to"
)
_ANNOUNCED = phrases(
    "look,right,your next job,your job,your task,your next task,your mission,next job,next task,"
    "new job,task,mission,the task,the plan,plan,order,command,quick,urgent,as fast as you can,"
    "as quick as you can,as quickly as you can,as soon as you can,quick as you can,hurry,"
    "hurry up,quick quick,chop chop"
)
OPENERS = _OPENINGS | {(*phrase, ",") for phrase in _ANNOUNCED}
"""Words that can be dropped at the beginning of a clause."""

LIGHT_VERBS = phrases(
    "give,do,make,take,have,perform,show,go into,go down into,get into,get down into,hold,stay in,"
    "go for,do me,give it,execute,have yourself,lower yourself into,drop into,sink into,extend,"
    "show me,show us,let me see,let us see"
)
"""Verbs that say nothing but that an act is done: "do a squat", "give a wave"."""

PATROLS = phrases(
    "patrol,go on patrol,do your rounds,make your rounds,make the rounds,do the rounds,"
    "go the rounds,make a round,do a round,do a tour,make a tour"
)
"""How a patrol begins."""
EVERY_ROOM = phrases(
    "every room,each room,all rooms,all the rooms,all of the rooms,every one of the rooms,"
    "each of the rooms,every single room,each and every room"
)
"""All the rooms of the home, one after the other; not those that have "room" in their names."""
AUXILIARIES = words(
    "is are was were be been am do does did has have had can could will would should shall may "
    "might must not"
)
LEAVING = words("left put dropped forgot forgotten placed keeps keep hid threw stored")
"""What somebody does with a thing that is somewhere since."""
WH = words("what where who how which when why whose whom whether if unless")
CONJUNCTIONS = words("and or then but so because else otherwise than as while until")
OTHER_WORDS = words("to for at on in with of by from and or me the a an one is are")
"""A noun follows these."""
DIRECTIONS = words(
    "left right forward forwards backward backwards back ahead straight around up down away "
    "clockwise counterclockwise anticlockwise here there off together again sideways out"
)
_PREPOSITIONS = frozenset(
    p[0] for table in (LOCATIVES, GOALWARDS, SOURCEWARDS, OTHER_PREPOSITIONS) for p in table
)
ADVERBS = words("still already currently again yet anymore")
"""Of time; they say nothing in a question."""
FUNCTION_WORDS = (
    DETERMINERS | ALL | PRONOUNS | AUXILIARIES | WH | CONJUNCTIONS | DIRECTIONS | _PREPOSITIONS
    | words("me us i you we they myself yourself 's let there here please nor neither")
) - words("nearby against before opposite")  # fmt: skip
"""Words that never begin or continue the nouns of a noun phrase."""

LEVELS = {
    "upper": ("upper", "top", "highest", "uppermost"), "top": ("top", "upper", "highest"),
    "lower": ("lower", "bottom", "lowest"), "bottom": ("bottom", "lower", "lowest"),
    "middle": ("middle", "center", "centre"), "center": ("center", "middle", "centre"),
    "highest": ("upper", "top"), "lowest": ("lower", "bottom"), "topmost": ("upper", "top"),
    "uppermost": ("upper", "top"), "left": ("left",), "right": ("right",),
    "first": ("first",), "second": ("second",), "third": ("third",), "far": ("far",),
    "close": ("close", "near"), "front": ("front",), "rear": ("rear", "back"),
}  # fmt: skip
"""Adjectives that tell parts of furniture apart, with what a world may call them."""
BOARDS = words("board shelf level tier compartment rack row")
"""What a piece of furniture has one above the other."""

ELSE = phrases("else,otherwise,or else,if not,if not so,in the other case,if that fails")
IN_ALL = phrases("over,in a row,in total,altogether,in all,each")
"""What may follow "three times" and adds nothing."""
