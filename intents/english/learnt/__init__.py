"""What is learnt from examples: people ask in endless wordings, so no list of rules is ever whole.

Linear-chain conditional random fields [Lafferty2001] look at what each word, its neighbours and its
clause are (:mod:`looks`). One says which words are background (:mod:`background`: reasons, asides,
names for the robot), so that the grammar can read the rest (:mod:`passing`). Where it cannot, two
more say what is asked for and what each name has to do with it (:mod:`roles`), and that is said
again in plain words (:mod:`rewording`, :mod:`several`), which the grammar reads. The last one says
which of these readings to trust (:mod:`trust`), and where a network says the sentence otherwise,
which of the two (:mod:`choice`). So nothing learnt makes a goal by itself, and what is in doubt is
asked about. The weights come from ``python -m training`` and ``python -m training.paraphrase``.

[Lafferty2001] J. Lafferty, A. McCallum, F. Pereira: Conditional Random Fields, ICML 2001.
"""
