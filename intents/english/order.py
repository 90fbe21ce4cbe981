"""What can be said, in the order in which it is tried: the first reading that succeeds counts.

A reading that fails with an error leaves the clause to those after it; if none succeeds, the error
of the greatest weight is told, of equal ones the first. So the order has three reasons, and where
none is given beside a row, the rows around it exclude one another by their first words and it could
as well stand elsewhere:

- *What is special stands before what is general.* Nine in ten clauses are a verb with its
  complements, which reads almost anything; a construction that uses the same verb in another way
  ("take five seconds") has to be asked first.
- *What is said stands before what is left out.* Only a clause that makes no sense by itself is
  completed by what was said before it.
- *What asks for something stands before what only tells something*, so that no command is passed
  over as a remark.

`tests/unit/intents/test_order_of_readings.py` holds a sentence for each pair that would be read
otherwise the other way round. A new reading is a function in :mod:`intents.english.readings` and a
row here.
"""

from intents.english import afterthoughts, exclusions
from intents.english.corrections import correction, switched_over
from intents.english.ending_early import ended_early
from intents.english.reading import Rules
from intents.english.readings import (
    arms_down,
    asides,
    belonging,
    beneficiaries,
    conditionals,
    ellipsis,
    ends,
    fronted,
    guiding,
    jottings,
    light_verbs,
    movements,
    needs,
    questions,
    remarks,
    repetition,
    telegrams,
    time_clauses,
    trying,
    unknown_verbs,
    verb,
    without_verb,
)

RULES = Rules(
    readings=(
        # Set wordings, matched from the first word of the clause to its last.
        questions.about_robot,
        questions.posture_noted,
        # "Put your hands down" is to put nothing down, and "take your arm down" would raise it.
        arms_down.arms_down,
        # Clauses that hold clauses: what they hold is read with the whole list again. A condition
        # stands before "when you see Ada, nod", where the one would look at her and the other
        # first has to find her.
        conditionals.conditional,
        repetition.for_each,
        repetition.for_each_room,
        repetition.so_many_times,
        repetition.again,
        time_clauses.one_before_the_other,
        time_clauses.not_until,
        # What an order is good for, before it is an order itself.
        remarks.aimed_at,
        # Statements with a wish behind them, or a place to be noted: before a need or
        # a verb is seen in "I put my comb on the bench, go and get it".
        needs.lost,
        needs.looked_for,
        remarks.left_somewhere,
        # "You will find it there" is to look for it only where nothing more is asked.
        remarks.found_there,
        # Before a need of its own: "Ada needs it" tells for whom what was asked for is.
        beneficiaries.meant_for,
        needs.needed,
        needs.required,
        needs.will_do,
        remarks.feeling,
        # Constructions, whose verb is not the act: all of them before the verb with its own
        # complements. "Give a nod" would hand something over, "I need the lamp on the desk" would
        # bring it, "take five seconds" is "take five" and "wait until I call" would end at "wait".
        light_verbs.light_verb,
        ends.resultative,
        needs.aired,
        guiding.helped_there,
        guiding.shown_where,
        guiding.made_to_follow,
        guiding.goes_oneself,
        guiding.way_asked,
        needs.wanted_there,
        movements.out_of_the_way,
        time_clauses.until_told,
        time_clauses.arrived,
        time_clauses.in_a_while,
        # "Patrol between a and b" goes to and fro, and asks how often.
        movements.to_and_fro,
        movements.patrol,
        verb.tidied_by,
        # The robot cannot tidy by itself, and knows where "away" is only from what was said.
        belonging.room_tidied,
        belonging.home_told,
        belonging.put_home,
        trying.tried,
        questions.went_to_see,
        questions.whether,
        questions.seen,
        questions.which_room,
        questions.inside,
        questions.any_left,
        without_verb.fist,
        without_verb.head,
        without_verb.lights,
        without_verb.moved,
        without_verb.switched,
        questions.question,
        movements.pose,
        needs.has_a_question,
        # "All toys go into the box": before the toys are a fronted thing and "go" is to walk there.
        ends.thing_first,
        verb.verb,
        # What goes on from what was said before. After "and" a gap is likelier than a fronted
        # phrase: "find Emil at the sofa and Ada in the hall. Greet her" finds both.
        ellipsis.served,
        ellipsis.likewise,
        ellipsis.counted_out,
        ellipsis.also_for,
        ellipsis.follow_up,
        ellipsis.gapped_after_and,
        fronted.out_of,
        fronted.fronted,
        fronted.in_pieces,
        # What only tells something, and commands of nouns alone. A gap without "and" before it is
        # as doubtful as a telegram, which is a whole sentence.
        remarks.statement,
        jottings.jotted,
        jottings.juxtaposed,
        telegrams.telegram,
        ellipsis.gapped,
        remarks.told_of,
        # A word that no reading knows as anything is taken for a verb last of all, and asked about.
        unknown_verbs.moved_somehow,
        # Asides are tried when nothing can be asked for: a command with a subject ("the cup goes on
        # the table") is read above.
        asides.released,
        asides.warned,
        asides.forbidden,
        asides.told,
        # Asks back, so nothing may come after it that could still be read.
        without_verb.only_named,
    ),
    afterthoughts=(
        # "No, off" names nothing that a correction could put in a thing's place.
        switched_over,
        # Anything can be taken back, what is a condition or "after ..." as well.
        correction,
        afterthoughts.left_undone,
        exclusions.kept_out,
        exclusions.excluded,
        ended_early,
        afterthoughts.not_now,
        afterthoughts.from_there,
        afterthoughts.so_many,
        afterthoughts.so_long,
        afterthoughts.on_condition,
        afterthoughts.before_or_after,
        afterthoughts.in_time,
        afterthoughts.later,
        afterthoughts.so_often,
        afterthoughts.who_asks,
    ),
)
