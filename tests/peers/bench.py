"""Runs every case, slopegen and peer in turn, and prints the table. Imports nothing large: the peak of memory of a child begins
with that of its parent."""

import argparse
import importlib.metadata
import json
import os
import resource
import select
import statistics
import subprocess
import sys
import time

import cases
import paths
import table

# Processor seconds beyond which a peer runs three times, or once.
SLOW, VERY_SLOW = 2.0, 8.0
PATIENCE = 600  # wall seconds for one answer of a peer
SLOPEGEN = os.environ.get("SLOPEGEN_DEV") or os.path.join(
    os.environ.get("CARGO_TARGET_DIR", os.path.join(paths.ROOT, "target")), "release", "slopegen"
)


class Skipped(Exception):
    """Why a row has no figures."""


class Worker:
    """One job of one peer in a process of its own, see worker.py."""

    def __init__(self, job, parameters):
        module, function = job.split(":")
        self.errors = open(os.path.join(paths.CACHE, "worker.log"), "w+")
        command = [sys.executable, os.path.join(paths.HERE, "worker.py"), module, function, json.dumps(parameters)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.answer()

    def answer(self):
        if not select.select([self.process.stdout], [], [], PATIENCE)[0]:
            raise Skipped(f"no answer within {PATIENCE} s")
        line = self.process.stdout.readline()
        if not line:
            self.errors.seek(0)
            said = [line for line in self.errors.read().splitlines() if line.strip()]
            raise Skipped(said[-1][:120] if said else f"ended with {self.process.wait()}")
        return json.loads(line)

    def ask(self, what):
        self.process.stdin.write(what + "\n")
        self.process.stdin.flush()
        return self.answer()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.errors.close()


def run_program(command):
    """A whole process: processor time, wall time, peak memory."""
    with open(os.path.join(paths.CACHE, "program.log"), "w+") as log:
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            log.seek(0)
            raise Skipped(f"exit code {process.returncode}: " + " ".join(log.read().split())[:200])
    # A child begins with the peak of its parent, below which nothing can be told.
    floor = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return {
        "cpu": used.ru_utime + used.ru_stime,
        "wall": wall,
        "mb": used.ru_maxrss / 1024,
        "below": used.ru_maxrss <= 1.02 * floor,
    }


def middle(runs):
    return {key: statistics.median(run[key] for run in runs) for key in ("cpu", "wall")} | {
        "mb": max(run["mb"] for run in runs),
        "below": any(run.get("below") for run in runs),
        "runs": len(runs),
    }


def prepare(case):
    """Writes the inputs that are not there yet."""
    os.makedirs(paths.inputs(""), exist_ok=True)
    for name, (kind, parameters) in case.inputs.items():
        path = paths.inputs(name)
        if not paths.fresh(path):
            code = "import json, sys, shapes; shapes.write(sys.argv[1], sys.argv[2], **json.loads(sys.argv[3]))"
            command = [sys.executable, "-c", code, path + ".part." + path.split(".")[-1], kind, json.dumps(parameters)]
            subprocess.run(command, cwd=paths.HERE, check=True)
            os.rename(command[3], path)


def row_of(case, label, said, version="", readme=False):
    row = {"case": case.name, "title": case.title, "tool": label, "version": version, "said": said}
    return row | {"readme": case.readme and readme}


def measure_peer(case, peer, command, ours, most):
    row = row_of(case, peer.label, peer.said, readme=peer.readme)
    try:
        if peer.package:
            try:
                row["version"] = importlib.metadata.version(peer.package)
            except importlib.metadata.PackageNotFoundError:
                raise Skipped(f"{peer.package} could not be installed") from None
        if isinstance(peer.program, str):
            raise Skipped(peer.program)
        worker = None if peer.program else Worker(peer.job, peer.parameters)
        try:
            once = (lambda: worker.ask("go")) if worker else (lambda: run_program([*peer.program, peer.parameters["path"]]))
            beside, runs = [], []
            repeats = most
            while len(runs) < repeats:
                beside.append(run_program(command))
                runs.append(once())
                if len(runs) == 1:
                    repeats = min(most, 1 if runs[0]["cpu"] > VERY_SLOW else 3 if runs[0]["cpu"] > SLOW else most)
            ours.extend(beside)
            row |= middle(runs) | {"ratio": middle(runs)["cpu"] / middle(beside)["cpu"]}
            if worker:
                found = worker.ask("check")
                row["said"] = "; ".join(filter(None, [row["said"], found.pop("said", "")]))
                row |= found
        finally:
            if worker:
                worker.__exit__()
    except (Skipped, BrokenPipeError) as why:
        row["skipped"] = str(why)
        print(f"   SKIPPED {peer.label}: {why}", file=sys.stderr)
    return row


def measure(case, repeats):
    print(f"== {case.name}", file=sys.stderr)
    prepare(case)
    out = os.path.join(paths.CACHE, "out" + case.suffix)
    words = case.command.split()
    command = [SLOPEGEN, *(paths.inputs(w[3:]) if w.startswith("IN:") else w.replace("OUT", out) for w in words)]
    ours = row_of(case, "slopegen", case.said, readme=True)
    ours["command"] = f"slopegen {case.command.replace('IN:', '').replace('OUT', 'out' + case.suffix)}"
    runs, rows = [], []
    for peer in case.peers:
        print(f"   {peer.label}", file=sys.stderr)
        try:
            rows.append(measure_peer(case, peer, command, runs, repeats))
        except Skipped as why:
            ours["skipped"] = str(why)
            print(f"   SLOPEGEN FAILED: {why}", file=sys.stderr)
            break
    while len(runs) < min(3, repeats) and "skipped" not in ours:
        try:
            runs.append(run_program(command))
        except Skipped as why:
            ours["skipped"] = str(why)
    if runs:
        ours |= middle(runs) | {"ratio": 1.0}
        if case.check:
            job, parameters = case.check
            try:
                with Worker(job, {"path": out} | parameters) as worker:
                    worker.ask("go")
                    ours |= worker.ask("check")
            except Skipped as why:
                ours["skipped"] = f"the output could not be checked: {why}"
                print(f"   {ours['skipped']}", file=sys.stderr)
    return [ours, *rows]


def main():
    options = argparse.ArgumentParser(prog="tests/peers/run", description="slopegen beside other tools: accuracy and time.")
    options.add_argument("--quick", action="store_true", help="small sizes only, less than two minutes")
    options.add_argument("--only", metavar="NAME", action="append", help="the case NAME, or those NAME begins; can be repeated")
    options.add_argument(
        "--repeats", metavar="N", type=int, default=5, help="runs of each, of which the median counts; default 5"
    )
    options.add_argument("--list", action="store_true", help="the names of the cases")
    options.add_argument(
        "--docs", action="store_true", help="write the tables of README.md and docs/peers.md from the last full run"
    )
    chosen = options.parse_args()
    if chosen.docs:
        return table.write_docs()
    tobj = os.path.join(paths.CACHE, "tobj", "release", "read_with_tobj")
    listed = cases.all_cases([tobj] if os.path.exists(tobj) else "the program could not be built")
    if chosen.only:
        listed = [c for c in listed if any(c.name == name or c.name.startswith(name + "-") for name in chosen.only)]
    if chosen.quick:
        listed = [c for c in listed if c.quick]
    if chosen.list:
        return print("\n".join(case.name for case in listed))
    path = os.path.join(paths.CACHE, "part.json")
    begun, load = time.time(), os.getloadavg()[0]
    result = {"machine": table.machine(), "repeats": chosen.repeats, "rows": []}
    for case in listed:
        result["rows"] += measure(case, max(chosen.repeats, 1))
        result |= {"load": [load, os.getloadavg()[0]], "seconds": time.time() - begun}
        with open(path, "w") as file:
            json.dump(result, file, indent=1)
    if not (chosen.quick or chosen.only):
        os.rename(path, paths.FULL)
        path = paths.FULL
    print(table.whole(result))
    print(f"\nfigures in {os.path.relpath(path)}", file=sys.stderr)
    return 1 if any("skipped" in row for row in result["rows"] if row["tool"] == "slopegen") else 0


if __name__ == "__main__":
    sys.exit(main())
