"""Things in a picture with depth, by two small networks of our own: where, what, how large.

`inputs` -> the finder -> `instances` -> `crops` -> the namer -> `eyes`; `votes` adds up pictures.
"""
