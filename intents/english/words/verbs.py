"""Verbs, of one or more words, and what sense each has before its complements are known."""

from intents.english.words.lexer import singular
from intents.english.words.lexicon import Phrase

SPELLINGS: dict[str, str] = {
    "go": (
        "go,go over,go on over,move,move over,navigate,walk,walk over,drive,come,"
        "keep going,go on,carry on,"
        "come closer,come nearer,get closer,get closer to,get nearer,get nearer to,move closer,"
        "come over,enter,head,head over,proceed,travel,get to,get over,return,visit,"
        "reach,approach,advance,run,hurry,make your way,find your way,find way,"
        "find the way,start at,begin at,start out at,"
        "take yourself,get yourself,go out,step,roll,journey,arrive,"
        "arrive at,be at,get back,go back,come back,position yourself,pass by,"
        "mosey over,mosey,toddle over,saunter over,amble over,trot over,scurry over,carry yourself,"
        "pop over,pop,nip over,nip,nip down,pop down,head down,nip round,pop round,nip up,"
        "hop over,dash,zip,trot,march,off you go,make for,head for,"
        "come straight back,go straight back,come right back,go right back,"
        "move yourself,start walking,start moving,start going,wander,stroll,cruise,"
        "retreat,swing by,stop by,back up,back off,back away,reverse,"
        "shift,get along to,take yourself off to,get yourself off to,trundle over,"
        "leg it,leg it over,peg it,skip over,pootle over,potter over,shoot over,nip across,sprint,"
        "dart,dart over,scoot over,race,race over,haul yourself,drag yourself,plant yourself,"
        "translate,sidestep,side step,strafe,shuffle,scoot"
    ),
    "leave": "leave,exit,go out of,get out of,get out,depart,depart from",
    "turn": (
        "turn,rotate,spin,turn around,turn yourself,face,pivot,turn round,spin around,yaw,"
        "turn to face,turn and face,swivel,swing,swing round,swing around,swivel round,"
        "swivel around,whirl round,whirl around,wheel round,wheel around"
    ),
    "find": (
        "find,locate,look for,search,search for,spot,pinpoint,seek,detect,discover,"
        "hunt for,hunt around for,find out where,have a look for,"
        "have a look around for,take a look for,"
        "look out for,keep an eye out for,keep a lookout for,scan,check,comb through,"
        "search out,seek out,look around for,go find,track down,"
        "recognize,find me,try to find,hunt,scan for,check for,find for me,trace,look up,"
        "single out,look,look around,look in,show me,show us"
    ),
    "pick": (
        "pick,pick up,nab,grab,grasp,collect,catch,lift,hold,obtain,get hold of,"
        "round up,grab hold of,take hold of,pick out,gather,seize,lift up,raise,acquire,grip,"
        "snatch,clutch,scoop up,withdraw,yoink,hoist up,swipe,get out,retake,"
        "extract,remove,pull,pull out,procure,choose,"
        "select,take away"
    ),
    "take": (
        "take,get,take up,go get,go take,retrieve,fetch,go fetch,go and fetch,"
        "go and get,take out,bring up,grab,collect,snatch,pick,pick up,procure,obtain,acquire,"
        "grab hold of,go pick up,go and pick up,go and grab,go grab"
    ),
    "put": (
        "put,place,whack,plonk,shove,park,"
        "set,lay,deposit,store,position,insert,hang,stow,put back,put away,stick,stack,"
        "rest,plop,throw,toss,plant,restock,relocate,shift,return,sit,leave,move,drop,collect,"
        "gather,round up,pop,load,stick,tuck,slide,dump,stash,tidy,tidy away,chuck,shove,"
        "keep,lob,fling,hurl,heave,cram,squash,slap,perch,prop,nestle,lodge,ditch,dunk,drape,"
        "pitch,hoist,prop up,whang,lump,evacuate,air,return,"
        "stand up,heap,hoy,"
        "clear away,lock away,pack,file,file away,put aside,sling,toss away,bung,drop off"
    ),
    "swap": "swap,exchange,swap round,swap around,swap over,interchange,trade",
    "clear": "clear,rid,relieve,strip,clear off,clear up,clear out,clear away,empty,empty out",
    "drop": (
        "drop,put down,set down,release,let go of,let go,drop off,leave behind,"
        "throw away,dispose of,dispose,discard,throw out,get rid of,dump,trash,bin,recycle,"
        "place down,leave,lower"
    ),
    "bring": (
        "bring,tote,lug,cart,ferry,"
        "run,run over,run on over,deliver,carry,transport,transfer,bring over,bring back,"
        "bring along,"
        "return with,come back with,convey,haul,supply,send,drag,bring out,move,get,"
        "pull,schlep,hump,heft,whisk,nip,zip,dash,shuttle,wheel,dispatch,hoof,trundle,"
        "relay,smuggle,sneak,pass along,fire over,fire,distribute,shift,hand deliver,arrange,"
        "nab,yoink,bring round,take round,drop round,fetch over,walk,jog,bear,proffer,courier,remit"
    ),
    "inform": (
        "i need,i want,i would like,give me,give us,give,provide,provide me with,show me,share,"
        "get me"
    ),
    "give": (
        "give,chuck,toss,sling,lob,bung,hand,hand over,pass,serve,offer,give over,pass over,"
        "present,provide,"
        "pass on,hand out,distribute,share,hand in,lend,feed,supply,furnish,equip,provision,issue,"
        "furnish me with,furnish us with"
    ),
    "want": (
        "hook me up with,i would murder,i could fair go,i could go,i would not mind,i could eat,"
        "i could drink,me wants,"
        "fix me up with,sort me out with,set me up with,i want,i need,i would like,"
        "i would love,can i have,could i have,may i have,"
        "might i have,might i get,"
        "can i get,could i get,may i get,i will have,i will take,i would like to have,"
        "i want to have,i am looking for,we need,we want,we would like,i require,"
        "can we have,could we have,i could use,i could do with,we could do with,i fancy,we fancy,"
        "i could murder,i would kill for,i am after,i am wanting,i am needing,"
        "i am going to need,i am going to want,i have to have,i have got to have,i will need,"
        "i shall need,i must have,we will need,we are going to need,"
        "might i trouble you for,might i bother you for,could i trouble you for,"
        "can i trouble you for,may i trouble you for,"
        "could i bother you for,i would appreciate,let me have,i feel like,"
        "i am in need of,i have need of,we have need of,i stand in need of,"
        "do you have,have you got,i like,i crave,me want,me need"
    ),
    "follow": (
        "follow,go after,come after,go behind,come behind,go along with,go with,come with,"
        "tail,chase,track,follow after,follow along,follow behind,walk behind,walk after,"
        "trail,walk along with,come along with,tag along with,"
        "move along with,stay close to,stick with,stick to,walk with,keep up with,pursue,shadow,"
        "stay with,move behind"
    ),
    "guide": (
        "show,guide,escort,lead,accompany,conduct,usher,navigate,direct,show the way,"
        "help,show around,take along,bring along with,steer,walk home,see,take,bring,"
        "walk,move,get,return with,come back with,bring back,get back with"
    ),
    "meet": (
        "meet,get to know,get acquainted with,meet up with,meet with,become acquainted with,"
        "make the acquaintance of,encounter,acquaint yourself with,contact,find and meet,"
        "see to,join"
    ),
    "collect": "get,fetch,pick up,collect,pick,go get,retrieve,go fetch",
    "greet": (
        "greet,say hello to,say hi to,say hello,say hi,say good morning to,"
        "say good evening to,salute,welcome,introduce yourself to,introduce yourself,"
        "present yourself to,present yourself,give a greeting to,wave hello to,say hey to,"
        "say good morning,hello to,introduce,say greetings to,"
        "give your regards to,self introduce to"
    ),
    "say": (
        "say,speak,utter,announce,state,declare,pronounce,recite,express,sing,relay,"
        "joke,crack a joke,chat,mention,talk about,give out,speak about,convey that,repeat after me"
    ),
    "tell": (
        "tell,inform,let,notify,advise,update,remind,report,explain,let me know,"
        "relay to,share with,explain to,ascertain,establish,make out,convey,convey to,"
        "brief,identify,name,find out,check,determine,"
        "figure out,do you know,can i know,i want to know,i would like to know,"
        "i need to know,work out,tell about,look and tell,specify,list,speak to,"
        "speak with,talk to,talk with,wish,bid,do you happen to know,would you know,any idea,"
        "do you have any idea,have you any idea,respond with,recount,communicate,communicate to,"
        "revert with,revert to me with,revert back with,get back to me with,come back to me with,"
        "indicate,learn,verify,let know,say to,state to,i wonder,report to,disclose,"
        "reveal,detail,point out"
    ),
    "describe": "describe,give a description of,give me a description of,tell me about,tell about",
    "answer": (
        "answer,respond,respond to,reply,reply to,answer to,give an answer to,"
        "give an answer,answer back,provide an answer to,field,ask,ask for,get asked,"
        "help with,give a response to,resolve,give the answer to,give the answer,"
        "give them the answer to,provide the answer to,respond to the"
    ),
    "count": "count,count up,give me the number of,tell me the number of,enumerate",
    "look": (
        "look,look at,inspect,examine,check,watch,observe,have a look at,take a look at,"
        "have a gander at,take a gander at,have a butchers at,have a peek at,take a peek at,"
        "have a squint at,have a peep at,cast an eye over,"
        "check on,check out,look over,look into,glance at,stare at,gaze at,control,"
        "monitor,view,check up on,turn your head to,turn your head towards,turn your head,"
        "peek at,focus on,keep an eye on,see,scan"
    ),
    "open": "open,open up,unlock,unclose,uncover",
    "close": "close,shut,close up,lock,cover",
    "switch": (
        "switch,turn,power,activate,deactivate,switch on,switch off,turn on,turn off,"
        "power on,power off,put,shut,power up,start up,shut off,shut down,put on,put off,disable,"
        "enable,light,turn down,light up,power down,start,kill,extinguish,disconnect"
    ),
    "stand": (
        "stand,stand up,get up,stand still,stand straight,stand upright,rise,"
        "return to standing,return to a standing position,get back on your feet,come back up,"
        "get back up,stand back up,come up,get up again,rise up,"
        "remain standing,straighten up,stay standing,keep standing,get on your feet,balance"
    ),
    "squat": (
        "squat,crouch,squat down,crouch down,kneel,kneel down,bend your knees,duck,"
        "duck down,do a squat,do squats,get down low,get low,crouch low,hunker down,"
        "go down on your knees,take a squat,"
        "bend your legs,get down"
    ),
    "lean": "shift your weight,lean your body,tilt your body,bend your body,tilt your torso,"
    "lean,lean over,tilt,bend,bend over,incline",
    "sit": "sit,sit down,take a seat,have a seat,be seated",
    "balance": (
        "balance,keep your balance,hold your balance,hold balance,keep balance,balance on,"
        "balance yourself,keep balancing"
    ),
    "lift_leg": (
        "stick your,keep your,lift the,raise the,hold up the,take your,"
        "lift your,raise your,lift one,raise one,lift a,lift up your,raise up your,"
        "hold up your,put up your,hold your,stretch out your,extend your,put your,"
        "lower your,move your,put one,lift up one,raise up one"
    ),
    "gesture": (
        "wave,nod,point,bow,clap,dance,shrug,point at,point to,wave at,wave to,bow to,"
        "nod at,nod to,shake your head,shake head,nod your head,nod head,give a thumbs up,"
        "thumbs up,show a thumbs up,give me a thumbs up,clap your hands,take a bow,"
        "give a wave,give me a wave,wave your hand,wave your arm,wave your right hand,"
        "wave your left hand,wave hello,wave goodbye,shake hands with,shake hands,high five,"
        "give me a high five,give a high five,cross your arms,shrug your shoulders,"
        "do a dance,do a bow,wave your arms,wave both hands,curtsy,show thumbs up,"
        "point towards,point out,handshake,make a bow,bow down,raise your hand,raise your arm,"
        "raise your left hand,raise your right hand,raise your left arm,raise your right arm,"
        "raise both arms,raise both hands,raise your arms,raise your hands,shake my hand,"
        "put both your hands up,put both hands up,put your hands up,put your arms up,hands up,"
        "lift both your arms,lift both of your arms,raise both of your arms,lift both arms,"
        "raise both your arms,raise both your hands,put both arms up,put both your arms up,"
        "hold up both arms,lift your arms,hold your hands up,put up your hands,"
        "shake his hand,shake her hand,shake my right hand,high five me"
    ),
    "wait": (
        "wait,hold on,stay,stay here,stay there,wait here,wait there,hang on,remain,"
        "stay put,do nothing,stay where you are,hold still,remain here,stay like that,"
        "stay like this,hold that pose,"
        "hold that position,do not do anything,do not do a thing,rest for,idle,"
        "hang around,wait around,stand by,"
        "keep still,wait up,sleep for,stay still,hold your position,"
        "hold position"
    ),
    "stop": (
        "stop,halt,freeze,stop moving,stop it,stop that,stop now,emergency stop,"
        "emergency,stop there,abort everything,do not move,stop right there,stop walking,"
        "stop everything,stop what you are doing,e stop,estop,full stop"
    ),
    "pause": (
        "pause,pause the mission,pause the task,take a break,interrupt,hold the mission,"
        "suspend,suspend the task,suspend the mission,hold off,pause right there,"
        "pause it,pause that,put the task on hold,put it on hold,put the mission on hold,"
        "put everything on hold,put that on hold,interrupt the mission,interrupt the task,"
        "interrupt what you are doing,pause what you are doing,pause everything,take five"
    ),
    "resume": (
        "resume,continue,carry on,keep going,proceed with the task,go ahead,unpause,"
        "continue the task,resume the task,resume the mission,continue the mission,"
        "go on with the task,continue with the task,continue with what you were doing,"
        "resume what you were doing,continue what you were doing,go on with it,keep on,"
        "go on with what you were doing,"
        "carry on with what you were doing,go on with your task,go on with the job,"
        "go on with your job,back to work,"
        "get back to work,get on with it,get on with your task,carry on with your task,"
        "proceed,pick up where you left off,pick up where you stopped,start again,restart,"
        "you may continue,"
        "get going again,go on now,go on"
    ),
    "cancel": (
        "cancel,abort,leave off,skip it,skip that,skip this,forget this,cancel that,cancel it,"
        "never mind,nevermind,forget it,forget that,"
        "forget about it,forget about that,give up,abandon,abort the mission,"
        "cancel the mission,cancel the task,abort the task,abandon the mission,"
        "abandon the task,cancel everything,undo that,abort that,abort it,call it off,"
        "forget about the task,forget about the mission,abandon what you are doing,"
        "abandon it,abandon that,"
        "scrap that,scrap it,scrap the task,scrap,drop the task,drop that task,drop it all,quit,"
        "quit it,quit the task,quit the mission,call off the mission,call off the task,"
        "call it a day,forget the task,"
        "forget everything,give it up,cancel this"
    ),
    "report": (
        "report your,report status,give me a status report,give a status report,"
        "status report,give me your status,status,report on your,report in,"
        "tell me your status,say your status,give me a report,give a report,"
        "report your status,report what you see,report on yourself,self check,"
        "do a self check,report your health,health check,battery level,status update,"
        "give me a status update,describe what you see,tell me about your status,"
        "describe your surroundings,report your position,report your location,"
        "report where you are,report what you are holding,report,report health,"
        "give me an update,give an update,give us an update,update me,what is new,"
        "report battery,report position,report location,report holding"
    ),
    "repeat": (
        "repeat,do it again,do that again,repeat that,repeat it,once more,one more time,"
        "again,repeat this,repeat the following,do this again,do the same again,"
        "do the whole thing,do all of that,do all that,do all of it,do this,do so,"
        "do the following,do it once more,do that once more,same again,do it,do that,loop"
    ),
}  # fmt: skip
"""Sense to spellings; a spelling may have several senses, the frames tell them apart.

What things are put, brought and thrown with is from the classes 9.1 to 9.4, 11.1, 11.4, 11.5 and
17.1 of [Levin1993] (English Verb Classes and Alternations), and from what people say at home.
"""

SENSES: dict[Phrase, tuple[str, ...]] = {}
for _sense, _text in SPELLINGS.items():
    for _spelling in _text.split(","):
        _phrase = tuple(_spelling.split())
        if _sense not in SENSES.get(_phrase, ()):
            SENSES[_phrase] = (*SENSES.get(_phrase, ()), _sense)
LONGEST = max(map(len, SENSES))
FIRST_WORDS = frozenset(phrase[0] for phrase in SENSES)
_BASES = frozenset(phrase[0] for phrase in SENSES) - {"i", "we", "can", "could", "may", "do"}


_PARTICIPLES = {
    "lit": "light",
    "brought": "bring", "taken": "take", "given": "give", "put": "put", "set": "set",
    "found": "find", "shown": "show", "led": "lead", "held": "hold", "thrown": "throw",
    "gotten": "get", "sent": "send", "got": "get", "shut": "shut", "left": "leave", "hung": "hang",
    "laid": "lay", "told": "tell", "met": "meet", "kept": "keep", "withdrawn": "withdraw",
    "driven": "drive", "slid": "slide", "stuck": "stick", "flung": "fling", "slung": "sling",
}  # fmt: skip


def participle_base(word: str) -> str | None:
    """The bare form of a past participle, or of what is meant as one: "brought", "moved"."""
    if word in _PARTICIPLES:
        return _PARTICIPLES[word]
    stem = word.removesuffix("ed")
    undoubled = stem[:-1] if len(stem) > 2 and stem[-1] == stem[-2] else stem
    forms = (word, stem, stem + "e", undoubled, word.removesuffix("ied") + "y")
    for form in forms if word.endswith("ed") else (word,):
        if form in FIRST_WORDS:
            return form
    return None


def base_form(word: str) -> str:
    """The bare form of a verb: "taking" and "takes" are "take"."""
    if word in FIRST_WORDS:
        return word
    if word.endswith("ing") and len(word) > 4:
        stem = word[:-3]
        undoubled = stem[:-1] if len(stem) > 2 and stem[-1] == stem[-2] else stem
        for form in (stem, stem + "e", undoubled):
            if form in _BASES:
                return form
    one = singular(word)
    for form in (one, word[:-2] if word.endswith("es") else one):
        if form in _BASES:
            return form
    return word


def verbs_at(words: list[str], start: int) -> list[tuple[str, int]]:
    """The senses of the verbs that begin at a word and where they end, longest first."""
    first = base_form(words[start]) if start < len(words) else ""
    if first not in FIRST_WORDS:
        return []
    return [
        (sense, end)
        for end in range(min(len(words), start + LONGEST), start, -1)
        for sense in SENSES.get((first, *words[start + 1 : end]), ())
    ]
