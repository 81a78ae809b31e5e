"""One job of one peer, in a process of its own: `worker.py MODULE FUNCTION PARAMETERS`, driven by lines on standard input.

The function prepares (untimed) and returns `work` and `check`. `go` runs `work` once and answers with its time; `check` answers
with the errors of the last result."""

import importlib
import json
import os
import resource
import sys
import time


def processor_time():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def main():
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what libraries print is no answer

    def answer(what):
        answers.write(json.dumps(what) + "\n")
        answers.flush()

    module, function, parameters = sys.argv[1:]
    work, check = getattr(importlib.import_module(module), function)(**json.loads(parameters))
    answer("ready")
    result = None
    for line in sys.stdin:
        if line.strip() == "go":
            result = None
            if hasattr(work, "again"):  # what has to be set up for every run
                work.again()
            cpu, wall = processor_time(), time.perf_counter()
            result = work()
            cpu, wall = processor_time() - cpu, time.perf_counter() - wall
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            answer({"cpu": cpu, "wall": wall, "mb": peak})
        else:
            answer(check(result))


if __name__ == "__main__":
    main()
