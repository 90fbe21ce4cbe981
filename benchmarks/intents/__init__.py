"""How well sentences are understood: `python -m benchmarks.intents --sets FOLDER`."""
