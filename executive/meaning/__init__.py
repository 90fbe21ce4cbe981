"""What a sentence means here: words and goals to a task that is checked against this world."""
