"""Where things lie: all that is made or fetched is under `target/peers`."""

import os

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
CACHE = os.path.join(ROOT, "target", "peers")


def inputs(name):
    return os.path.join(CACHE, "inputs", name)
