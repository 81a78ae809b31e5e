"""Where things lie: all that is made or fetched is under `target/peers`."""

import os

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
CACHE = os.path.join(ROOT, "target", "peers")
FULL = os.path.join(CACHE, "peers.json")  # the figures of the last full run


def inputs(name):
    return os.path.join(CACHE, "inputs", name)


def fresh(path):
    """Whether a file made from the shapes is there, and made by these shapes."""
    return os.path.exists(path) and os.path.getmtime(path) > os.path.getmtime(os.path.join(HERE, "shapes.py"))
