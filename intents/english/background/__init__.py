"""Background: what people say beside what they want, found by a tagger that learnt it from examples.

Reasons, asides, jokes, names for the robot, talk to others ("it's been beeping for ages", "legend",
"before somebody treads on it") come in endless wordings, so no list of them is ever whole. Here a
linear-chain conditional random field [Lafferty2001] looks at what each word, its neighbours and its
clause are, and says how likely it is that the word asks for nothing. The grammar stays what says
what is asked: it reads the sentence without its background only where it cannot read the whole.

[Lafferty2001] J. Lafferty, A. McCallum, F. Pereira: Conditional Random Fields, ICML 2001.
"""
